// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_BALANCE_SLICE_H
#define LMP_BALANCE_SLICE_H

#include "command.h"

namespace LAMMPS_NS {

/// balance/slice thresh keyword ...: once, now.
class BalanceSlice : public Command {
 public:
  explicit BalanceSlice(class LAMMPS *lmp) : Command(lmp) {}
  void command(int narg, char **arg) override;
};

}  // namespace LAMMPS_NS
#endif
