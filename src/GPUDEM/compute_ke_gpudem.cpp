// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "compute_ke_gpudem.h"

#include "force.h"
#include "update.h"
#include "verlet_gpudem.h"

using namespace LAMMPS_NS;

double ComputeKEGpudem::compute_scalar()
{
  VerletGpudem *device = VerletGpudem::active(lmp);
  if (!device) return ComputeKE::compute_scalar();
  invoked_scalar = update->ntimestep;
  const auto &flux = device->kineticSums(static_cast<unsigned>(groupbit)).momentumFlux;
  scalar = 0.5 * force->mvv2e * (flux[0] + flux[1] + flux[2]);
  return scalar;
}
