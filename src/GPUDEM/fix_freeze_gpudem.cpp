// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_freeze_gpudem.h"

using namespace LAMMPS_NS;

FixFreezeGpudem::FixFreezeGpudem(LAMMPS *lmp, int narg, char **arg) : FixFreeze(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixFreezeGpudem::post_force(int vflag)
{
  if (!onDevice) FixFreeze::post_force(vflag);
}

ResidentVerdict FixFreezeGpudem::resident()
{
  return {};
}

void FixFreezeGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::Freeze;
  t.groupMask = static_cast<unsigned>(groupbit);
  t.record = true;
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}

void FixFreezeGpudem::setForceBefore(const gpudem::Array3 &force)
{
  for (int d = 0; d < 3; ++d) foriginal[d] = force[d];
  force_flag = 0;
}
