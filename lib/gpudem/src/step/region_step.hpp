// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A region wall ahead of the contacts of a step: its loads wait in an array until the force terms take them in
/// the order of the script.
///
/// A launch of its own, because a tree of shapes with several contacts would take registers from every kernel of the
/// contacts.
#pragma once

#include "step/step_view.hpp"
#include "wall/region_wall.hpp"

namespace gpudem {

/// One region wall at one step.
template <class P>
struct RegionStep {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;

  std::uint32_t count, sequence;  ///< as in StepView
  Status *status;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *anchor, *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t flatRole;  ///< grains whose motion fix enforce2d has made flat before the wall acts
  Real dt;
  bool advance;
  WallView<Real> wall;
  int mostContacts;
  double pull;               ///< as in regionLoad
  const RegionShape *shape;  ///< [parts]
  int parts;
  PartState state[maxRegionParts];
  Vec3<Real> *load;  ///< [n] forces, [n] torques

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    letNextStart();
    act(i);
    waitForEarlier();  // who waits for this launch waits for those before it
  }

 private:
  GPUDEM_HD void act(std::uint32_t i) const
  {
    if (sequence > status->lastAllowed || !(anchor[i] & nearRegionBit)) return;
    Motion<Real> m = motion[i];
    RegionLoad<Real> l{};
    if (m.word & wall.role) {
      if (m.word & flatRole) m.vz = m.wx = m.wy = Real(0);
      const FixedPosition p = loadPosition(position, i, m.word);
      const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
      const int size = wall.historySize / mostContacts;
      Real *kept = wall.history ? wall.history + static_cast<std::size_t>(wall.historySize) * i : nullptr;
      l = regionLoad(wall, RegionView{shape, state, parts}, ContactSlots<Real>{kept, mostContacts, size}, i, count, x,
                     p.radius, pull, m, dt, advance);
      if (l.crowded) atomicLower(&status->crowded, i);
    }
    load[i] = l.force;
    load[count + i] = l.torque;
  }
};

/// Which grains a region wall may reach before the next rebuild. A wall that sweeps through space may reach all.
template <class P>
struct MarkNearRegion {
  using Real = typename P::Real;
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;

  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t role;
  bool sweeps;
  double margin;  ///< how far a grain may move until the next rebuild, and the gap across which the wall pulls (distance)
  const RegionShape *shape;
  int parts;
  Real *history;  ///< [n][historySize] or null
  int historySize;
  std::uint32_t *anchor;

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (isNear(i)) {
      anchor[i] |= nearRegionBit;
      return;
    }
    for (int d = 0; history && d < historySize; ++d) history[static_cast<std::size_t>(historySize) * i + d] = Real(0);
  }

 private:
  GPUDEM_HD bool isNear(std::uint32_t i) const
  {
    if (!(motion[i].word & role)) return false;
    if (sweeps) return true;
    const FixedPosition p = loadPosition(position, i);
    const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
    for (int k = 0; k < parts; ++k)
      if (isShape(shape[k]) && surfaceDistance(shape[k], x) <= p.radius + margin) return true;
    return false;
  }
};

}  // namespace gpudem
