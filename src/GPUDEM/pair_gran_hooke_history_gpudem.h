// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_PAIR_GRAN_HOOKE_HISTORY_GPUDEM_H
#define LMP_PAIR_GRAN_HOOKE_HISTORY_GPUDEM_H

#include "pair_gran_hooke_history.h"
#include "resident_pair_gran.h"

namespace LAMMPS_NS {

/// pair_style gran/hooke/history/gpudem
class PairGranHookeHistoryGpudem : public PairGranResident<PairGranHookeHistory, gpudem::NormalModel::Hooke, true> {
 public:
  using PairGranResident::PairGranResident;
};

}  // namespace LAMMPS_NS
#endif
