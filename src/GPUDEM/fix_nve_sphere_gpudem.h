// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_NVE_SPHERE_GPUDEM_H
#define LMP_FIX_NVE_SPHERE_GPUDEM_H

#include "fix_nve_sphere.h"
#include "resident.h"

namespace LAMMPS_NS {

/// fix nve/sphere/gpudem
class FixNVESphereGpudem : public FixNVESphere, public ResidentFix {
 public:
  FixNVESphereGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;

 private:
  std::string word;  ///< style as the script spells it
};

}  // namespace LAMMPS_NS
#endif
