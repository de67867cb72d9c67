// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_GRAVITY_GPUDEM_H
#define LMP_FIX_GRAVITY_GPUDEM_H

#include "fix_gravity.h"
#include "resident.h"

namespace LAMMPS_NS {

/// fix gravity/gpudem
class FixGravityGpudem : public FixGravity, public ResidentFix {
 public:
  FixGravityGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void post_force(int vflag) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;
  bool varies() const override;
  gpudem::Array3 value() override;
  double compute_scalar() override;

 private:
  double hostPotential() const;

  std::string word;         ///< style as the script spells it
  bool sumIsStale = false;  ///< the device acted since the stock class last summed its scalar
};

}  // namespace LAMMPS_NS
#endif
