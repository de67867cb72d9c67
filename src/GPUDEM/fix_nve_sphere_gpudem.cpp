// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_nve_sphere_gpudem.h"

using namespace LAMMPS_NS;

FixNVESphereGpudem::FixNVESphereGpudem(LAMMPS *lmp, int narg, char **arg) : FixNVESphere(lmp, narg, arg), word(arg[2])
{
}

void FixNVESphereGpudem::initial_integrate(int vflag)
{
  if (!onDevice) FixNVESphere::initial_integrate(vflag);
}

void FixNVESphereGpudem::final_integrate()
{
  if (!onDevice) FixNVESphere::final_integrate();
}

ResidentVerdict FixNVESphereGpudem::resident()
{
  if (extra) return ResidentVerdict::no("'update dipole' is a host feature");
  return {};
}

void FixNVESphereGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::IntegratorSpec it;
  it.kind = gpudem::IntegratorKind::NveSphere;
  it.groupMask = static_cast<unsigned>(groupbit);
  it.inertia = inertia;
  scene.integrators.push_back(it);
}
