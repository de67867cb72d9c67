// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_COMPUTE_TEMP_GPUDEM_H
#define LMP_COMPUTE_TEMP_GPUDEM_H

#include "compute_temp.h"
#include "resident.h"

namespace LAMMPS_NS {

/// compute temp/gpudem
class ComputeTempGpudem : public ComputeTemp, public ResidentCompute {
 public:
  using ComputeTemp::ComputeTemp;
  double compute_scalar() override;
  void compute_vector() override;
};

}  // namespace LAMMPS_NS
#endif
