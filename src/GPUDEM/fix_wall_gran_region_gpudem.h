// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_WALL_GRAN_REGION_GPUDEM_H
#define LMP_FIX_WALL_GRAN_REGION_GPUDEM_H

#include "fix_wall_gran_region.h"
#include "region_parts.h"
#include "resident_wall_gran.h"

namespace LAMMPS_NS {

/// fix wall/gran/region/gpudem
class FixWallGranRegionGpudem : public ResidentWallGran<FixWallGranRegion> {
 public:
  FixWallGranRegionGpudem(class LAMMPS *lmp, int narg, char **arg);
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;

  bool isRegion() const override { return true; }
  int numbers() const override { return use_history && size_history ? most() * (1 + size_history) : 0; }
  void exportHistory(std::vector<double> &history) override;
  void importHistory(const std::vector<double> &history) override;
  bool moves() const override { return region.moves(); }
  std::vector<gpudem::PartMotion> motion() override { return partMotions(lmp, region.regions); }

 private:
  /// Contacts that one grain may have on the device.
  int most() const;

  RegionParts region;  ///< as the present run found it
};

}  // namespace LAMMPS_NS
#endif
