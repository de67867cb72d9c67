// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_enforce2d_gpudem.h"

using namespace LAMMPS_NS;

FixEnforce2DGpudem::FixEnforce2DGpudem(LAMMPS *lmp, int narg, char **arg) : FixEnforce2D(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixEnforce2DGpudem::post_force(int vflag)
{
  if (!onDevice) FixEnforce2D::post_force(vflag);
}

ResidentVerdict FixEnforce2DGpudem::resident()
{
  if (nfixlist) return ResidentVerdict::no("another fix (rigid) has a part to play in it");
  return {};
}

void FixEnforce2DGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::Enforce2d;
  t.groupMask = static_cast<unsigned>(groupbit);
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}
