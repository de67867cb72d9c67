// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_PAIR_GRAN_HOOKE_GPUDEM_H
#define LMP_PAIR_GRAN_HOOKE_GPUDEM_H

#include "pair_gran_hooke.h"
#include "resident_pair_gran.h"

namespace LAMMPS_NS {

/// pair_style gran/hooke/gpudem
class PairGranHookeGpudem : public PairGranResident<PairGranHooke, gpudem::NormalModel::Hooke, false> {
 public:
  using PairGranResident::PairGranResident;
};

}  // namespace LAMMPS_NS
#endif
