// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_COMPUTE_EROTATE_SPHERE_GPUDEM_H
#define LMP_COMPUTE_EROTATE_SPHERE_GPUDEM_H

#include "compute_erotate_sphere.h"
#include "resident.h"

namespace LAMMPS_NS {

/// compute erotate/sphere/gpudem
class ComputeERotateSphereGpudem : public ComputeERotateSphere, public ResidentCompute {
 public:
  using ComputeERotateSphere::ComputeERotateSphere;
  double compute_scalar() override;
};

}  // namespace LAMMPS_NS
#endif
