// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_gravity_gpudem.h"

#include "atom.h"
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
  if (onDevice) return;
  FixGravity::post_force(vflag);
  sumIsStale = false;
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
  sumIsStale = true;
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

/// The stock class sums while it adds the force; after a run on the device the host's arrays give the same.
double FixGravityGpudem::hostPotential() const
{
  double own = 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    own -= atom->rmass[i] * (xacc * x[0] + yacc * x[1] + zacc * x[2]);
  }
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixGravityGpudem::compute_scalar()
{
  VerletGpudem *device = onDevice ? VerletGpudem::active(lmp) : nullptr;
  if (device) return -device->kineticSums(static_cast<unsigned>(groupbit), {xacc, yacc, zacc}).gravity;
  return sumIsStale ? hostPotential() : FixGravity::compute_scalar();
}
