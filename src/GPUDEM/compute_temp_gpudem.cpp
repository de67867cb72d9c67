// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "compute_temp_gpudem.h"

#include "error.h"
#include "force.h"
#include "update.h"
#include "verlet_gpudem.h"

using namespace LAMMPS_NS;

double ComputeTempGpudem::compute_scalar()
{
  VerletGpudem *device = VerletGpudem::active(lmp);
  if (!device) return ComputeTemp::compute_scalar();
  invoked_scalar = update->ntimestep;
  const auto &flux = device->kineticSums(static_cast<unsigned>(groupbit)).momentumFlux;
  if (dynamic) dof_compute();
  if (dof < 0.0 && natoms_temp > 0.0) error->all(FLERR, "Temperature compute degrees of freedom < 0");
  scalar = tfactor * (flux[0] + flux[1] + flux[2]);
  return scalar;
}

void ComputeTempGpudem::compute_vector()
{
  VerletGpudem *device = VerletGpudem::active(lmp);
  if (!device) {
    ComputeTemp::compute_vector();
    return;
  }
  invoked_vector = update->ntimestep;
  const auto &flux = device->kineticSums(static_cast<unsigned>(groupbit)).momentumFlux;
  for (int k = 0; k < 6; ++k) vector[k] = force->mvv2e * flux[k];
}
