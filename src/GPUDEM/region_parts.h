// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file LAMMPS' regions as parts of a region wall.
#ifndef LMP_GPUDEM_REGION_PARTS_H
#define LMP_GPUDEM_REGION_PARTS_H

#include "gpudem/engine.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
class Region;

/// A region, and which of LAMMPS' regions each part is.
struct RegionParts {
  std::vector<gpudem::RegionPart> parts;
  std::vector<Region *> regions;
  std::string obstacle;  ///< why the device cannot have it, empty if it can
  bool moves() const;
};
RegionParts regionParts(LAMMPS *lmp, Region *region);

/// Places and velocities at update->ntimestep. The regions are left as fix wall/gran/region leaves them at that step,
/// whichever step they were asked for before: a later run and a restart file take the velocities from there.
std::vector<gpudem::PartMotion> partMotions(LAMMPS *lmp, const std::vector<Region *> &regions);

}  // namespace LAMMPS_NS
#endif
