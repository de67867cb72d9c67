// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_MOVE_GPUDEM_H
#define LMP_FIX_MOVE_GPUDEM_H

#include "fix_move.h"
#include "resident.h"

namespace LAMMPS_NS {

/// fix move/gpudem: linear, wiggle and rotate on the device, variable on the host.
class FixMoveGpudem : public FixMove, public ResidentFix {
 public:
  FixMoveGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  void restart(char *buffer) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;
  /// Original positions, [nlocal][3], zero outside the group.
  double *origins() { return array_atom ? array_atom[0] : nullptr; }
  int groupBit() const { return groupbit; }

 private:
  void parse(int narg, char **arg);

  std::string word;  ///< style as the script spells it
  gpudem::IntegratorSpec motion;
  bool variable = false;
};

}  // namespace LAMMPS_NS
#endif
