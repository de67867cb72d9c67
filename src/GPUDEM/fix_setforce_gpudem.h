// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_SETFORCE_GPUDEM_H
#define LMP_FIX_SETFORCE_GPUDEM_H

#include "fix_setforce.h"
#include "resident.h"

namespace LAMMPS_NS {

/// fix setforce/gpudem
class FixSetForceGpudem : public FixSetForce, public ResidentFix {
 public:
  FixSetForceGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void post_force(int vflag) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;
  bool varies() const override;
  gpudem::Array3 value() override;
  void setForceBefore(const gpudem::Array3 &force) override;

 private:
  std::string word;  ///< style as the script spells it
};

}  // namespace LAMMPS_NS
#endif
