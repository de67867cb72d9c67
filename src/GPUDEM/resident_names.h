// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Style names in restart files: they must be stock names, or stock LAMMPS could not read them.
#ifndef LMP_GPUDEM_RESIDENT_NAMES_H
#define LMP_GPUDEM_RESIDENT_NAMES_H

#include "force.h"
#include "lammps.h"
#include "utils.h"

#include <string>

namespace LAMMPS_NS {

/// Drop "/gpudem" from the name of the pair style \p pair if the suffix put it there.
inline void giveBackStockName(LAMMPS *lmp, class Pair *pair)
{
  const std::string style = lmp->force->pair_style, suffix = "/gpudem";
  if (!lmp->suffix_enable || lmp->force->pair != pair || style.size() <= suffix.size() ||
      style.compare(style.size() - suffix.size(), suffix.size(), suffix) != 0)
    return;
  delete[] lmp->force->pair_style;
  lmp->force->pair_style = utils::strdup(style.substr(0, style.size() - suffix.size()));
}

}  // namespace LAMMPS_NS
#endif
