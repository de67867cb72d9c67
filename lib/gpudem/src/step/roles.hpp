// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Which groups of LAMMPS a scene asks about while it steps.
#pragma once

#include "base/annotate.hpp"
#include "gpudem/scene.h"

#include <cstdint>

namespace gpudem {

/// Each distinct group mask of a scene is a role: one bit of Motion::word, from the lowest. In mixed precision up to
/// eight roles leave room for eight more bits of each coordinate; with more the coordinates have 32 bits only.
struct Roles {
  int count = 0;
  std::uint32_t group[1 + 2 * maxTerms + maxIntegrators] = {};

  /// Bit of the role, 0 for a mask without groups.
  std::uint32_t of(std::uint32_t groupMask) const
  {
    for (int r = 0; r < count; ++r)
      if (group[r] == groupMask) return 1u << r;
    return 0;
  }
  /// Bits of the word that hold lower bits of the position, moved down to one coordinate.
  std::uint32_t fineMask() const { return count <= 8 ? 0xffu : 0u; }

  void add(std::uint32_t groupMask)
  {
    if (groupMask && !of(groupMask)) group[count++] = groupMask;
  }
};

inline Roles rolesOf(const SceneSpec &scene)
{
  Roles roles;
  roles.add(scene.frozenMask);
  for (const WallSpec &wall : scene.walls) roles.add(wall.groupMask);
  for (const ForceTerm &term : scene.terms) roles.add(term.groupMask);
  for (const IntegratorSpec &integrator : scene.integrators) roles.add(integrator.groupMask);
  return roles;
}

}  // namespace gpudem
