// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_FREEZE_GPUDEM_H
#define LMP_FIX_FREEZE_GPUDEM_H

#include "fix_freeze.h"
#include "resident.h"

namespace LAMMPS_NS {

/// fix freeze/gpudem
class FixFreezeGpudem : public FixFreeze, public ResidentFix {
 public:
  FixFreezeGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void post_force(int vflag) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;
  void setForceBefore(const gpudem::Array3 &force) override;

 private:
  std::string word;  ///< style as the script spells it
};

}  // namespace LAMMPS_NS
#endif
