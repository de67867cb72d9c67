// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_COMPUTE_KE_GPUDEM_H
#define LMP_COMPUTE_KE_GPUDEM_H

#include "compute_ke.h"
#include "resident.h"

namespace LAMMPS_NS {

/// compute ke/gpudem
class ComputeKEGpudem : public ComputeKE, public ResidentCompute {
 public:
  using ComputeKE::ComputeKE;
  double compute_scalar() override;
};

}  // namespace LAMMPS_NS
#endif
