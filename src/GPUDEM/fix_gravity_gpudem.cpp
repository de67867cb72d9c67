// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_gravity_gpudem.h"

#include "formula.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "variable.h"
#include "verlet_gpudem.h"

using namespace LAMMPS_NS;

FixGravityGpudem::FixGravityGpudem(LAMMPS *lmp, int narg, char **arg) : FixGravity(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixGravityGpudem::post_force(int vflag)
{
  if (!onDevice) FixGravity::post_force(vflag);
}

ResidentVerdict FixGravityGpudem::resident()
{
  for (const char *name : {mstr, vstr, pstr, tstr, xstr, ystr, zstr})
    if (name && !isHostFree(lmp, name, FormulaScope::StepOnly))
      return ResidentVerdict::no(std::string("variable ") + name + " depends on more than the step");
  return {};
}

void FixGravityGpudem::describe(gpudem::SceneSpec &scene)
{
  if (disable) return;
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::Gravity;
  t.groupMask = static_cast<unsigned>(groupbit);
  t.value = value();
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}

bool FixGravityGpudem::varies() const
{
  return mstr || vstr || pstr || tstr || xstr || ystr || zstr;
}

gpudem::Array3 FixGravityGpudem::value()
{
  if (varies()) {
    modify->clearstep_compute();
    Variable *v = input->variable;
    if (mstr) magnitude = v->compute_equal(mvar);
    if (vstr) vert = v->compute_equal(vvar);
    if (pstr) phi = v->compute_equal(pvar);
    if (tstr) theta = v->compute_equal(tvar);
    if (xstr) xdir = v->compute_equal(xvar);
    if (ystr) ydir = v->compute_equal(yvar);
    if (zstr) zdir = v->compute_equal(zvar);
    modify->addstep_compute(update->ntimestep + 1);
    set_acceleration();
  }
  return {xacc, yacc, zacc};
}

double FixGravityGpudem::compute_scalar()
{
  VerletGpudem *device = onDevice ? VerletGpudem::active(lmp) : nullptr;
  if (!device) return FixGravity::compute_scalar();
  return -device->kineticSums(static_cast<unsigned>(groupbit), {xacc, yacc, zacc}).gravity;
}
