// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "compute_erotate_sphere_gpudem.h"

#include "force.h"
#include "update.h"
#include "verlet_gpudem.h"

using namespace LAMMPS_NS;

double ComputeERotateSphereGpudem::compute_scalar()
{
  VerletGpudem *device = VerletGpudem::active(lmp);
  if (!device) return ComputeERotateSphere::compute_scalar();
  invoked_scalar = update->ntimestep;
  constexpr double inertia = 0.4;  // of a sphere, as in the stock compute
  scalar = 0.5 * force->mvv2e * inertia * device->kineticSums(static_cast<unsigned>(groupbit)).rotational;
  return scalar;
}
