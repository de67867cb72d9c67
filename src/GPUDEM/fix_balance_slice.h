// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_BALANCE_SLICE_H
#define LMP_FIX_BALANCE_SLICE_H

#include "fix.h"
#include "slice_balancer.h"

namespace LAMMPS_NS {

/// fix ID group balance/slice Nfreq thresh keyword ...
class FixBalanceSlice : public Fix {
 public:
  FixBalanceSlice(class LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  /// The check of this step, if it needs no particle. \return true if it is done and nothing is to be moved
  bool isEvenByCount();
  /// Do weights read the neighbour list?
  bool needsNeighbors() const { return balancer.needsNeighbors(); }
  bool weighsByVariable() const { return balancer.weighsByVariable(); }
  double compute_scalar() override { return after.imbalance; }
  double compute_vector(int i) override;
  double memory_usage() override { return balancer.memoryUsage(); }

 private:
  void check(bool listIsCurrent);

  SliceBalancer balancer;
  SliceBalancer::Load before, after;  ///< of the last check
  int rounds = 0;                     ///< of the last balancing
  bigint moved = 0;                   ///< grains that changed rank in the last balancing
  bigint lastCheck = -1;              ///< time step
};

}  // namespace LAMMPS_NS
#endif
