// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_viscous_gpudem.h"

#include "atom.h"

using namespace LAMMPS_NS;

FixViscousGpudem::FixViscousGpudem(LAMMPS *lmp, int narg, char **arg) : FixViscous(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixViscousGpudem::post_force(int vflag)
{
  if (!onDevice) FixViscous::post_force(vflag);
}

ResidentVerdict FixViscousGpudem::resident()
{
  return {};
}

void FixViscousGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::Viscous;
  t.groupMask = static_cast<unsigned>(groupbit);
  t.dragPerType.assign(gamma, gamma + atom->ntypes + 1);
  t.dragPerType[0] = 0.0;
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}
