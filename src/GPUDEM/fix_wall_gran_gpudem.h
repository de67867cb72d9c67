// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_WALL_GRAN_GPUDEM_H
#define LMP_FIX_WALL_GRAN_GPUDEM_H

#include "fix_wall_gran.h"
#include "resident_wall_gran.h"

namespace LAMMPS_NS {

/// fix wall/gran/gpudem
class FixWallGranGpudem : public ResidentWallGran<FixWallGran> {
 public:
  FixWallGranGpudem(class LAMMPS *lmp, int narg, char **arg);
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;

  int numbers() const override { return use_history ? size_history : 0; }
  void exportHistory(std::vector<double> &history) override;
  void importHistory(const std::vector<double> &history) override;
};

}  // namespace LAMMPS_NS
#endif
