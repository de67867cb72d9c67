// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_setforce_gpudem.h"

#include "formula.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

using namespace LAMMPS_NS;

FixSetForceGpudem::FixSetForceGpudem(LAMMPS *lmp, int narg, char **arg) : FixSetForce(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixSetForceGpudem::post_force(int vflag)
{
  if (!onDevice) FixSetForce::post_force(vflag);
}

ResidentVerdict FixSetForceGpudem::resident()
{
  if (idregion) return ResidentVerdict::no("keyword 'region' is a host feature");
  for (const char *name : {xstr, ystr, zstr})
    if (name && !isHostFree(lmp, name, FormulaScope::StepOnly))
      return ResidentVerdict::no(std::string("variable ") + name + " depends on more than the step");
  return {};
}

void FixSetForceGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::SetForce;
  t.groupMask = static_cast<unsigned>(groupbit);
  t.value = value();
  t.prescribed = {xstyle != 0, ystyle != 0, zstyle != 0};
  t.record = true;
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}

bool FixSetForceGpudem::varies() const
{
  return xstr || ystr || zstr;
}

gpudem::Array3 FixSetForceGpudem::value()
{
  if (varies()) {
    modify->clearstep_compute();
    if (xstr) xvalue = input->variable->compute_equal(xvar);
    if (ystr) yvalue = input->variable->compute_equal(yvar);
    if (zstr) zvalue = input->variable->compute_equal(zvar);
    modify->addstep_compute(update->ntimestep + 1);
  }
  return {xstyle ? xvalue : 0.0, ystyle ? yvalue : 0.0, zstyle ? zvalue : 0.0};
}

void FixSetForceGpudem::setForceBefore(const gpudem::Array3 &force)
{
  for (int d = 0; d < 3; ++d) foriginal[d] = force[d];
  force_flag = 0;
}
