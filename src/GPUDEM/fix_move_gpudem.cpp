// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_move_gpudem.h"

#include "domain.h"
#include "lattice.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

FixMoveGpudem::FixMoveGpudem(LAMMPS *lmp, int narg, char **arg) : FixMove(lmp, narg, arg), word(arg[2])
{
  parse(narg, arg);  // the base class checked the syntax; its results are private
}

void FixMoveGpudem::parse(int narg, char **arg)
{
  const auto number = [&](int k) { return utils::numeric(FLERR, arg[k], false, lmp); };
  motion.groupMask = static_cast<unsigned>(groupbit);
  motion.stepOrigin = update->ntimestep;
  bool scaled = true;
  for (int k = 4; k + 1 < narg; ++k)
    if (strcmp(arg[k], "units") == 0) scaled = strcmp(arg[k + 1], "lattice") == 0;
  const gpudem::Array3 scale =
      scaled ? gpudem::Array3{domain->lattice->xlattice, domain->lattice->ylattice, domain->lattice->zlattice}
             : gpudem::Array3{1.0, 1.0, 1.0};
  const double twoPi = 2.0 * std::acos(-1.0);
  if (strcmp(arg[3], "linear") == 0 || strcmp(arg[3], "wiggle") == 0) {
    motion.kind = gpudem::IntegratorKind::Prescribed;
    motion.wiggle = strcmp(arg[3], "wiggle") == 0;
    for (int d = 0; d < 3; ++d) {
      motion.prescribed[d] = strcmp(arg[4 + d], "NULL") != 0;
      if (motion.prescribed[d]) motion.vector[d] = number(4 + d) * scale[d];
    }
    if (motion.wiggle) motion.angularFrequency = twoPi / number(7);
  } else if (strcmp(arg[3], "rotate") == 0) {
    motion.kind = gpudem::IntegratorKind::Rotate;
    double length2 = 0.0;
    for (int d = 0; d < 3; ++d) {
      motion.point[d] = number(4 + d) * scale[d];
      motion.axis[d] = number(7 + d);
      length2 += motion.axis[d] * motion.axis[d];
    }
    for (double &a : motion.axis) a /= std::sqrt(length2);
    motion.angularFrequency = twoPi / number(10);
  } else {
    variable = true;
  }
}

void FixMoveGpudem::initial_integrate(int vflag)
{
  if (!onDevice) FixMove::initial_integrate(vflag);
}

void FixMoveGpudem::final_integrate()
{
  if (!onDevice) FixMove::final_integrate();
}

void FixMoveGpudem::restart(char *buffer)
{
  FixMove::restart(buffer);
  double origin;
  memcpy(&origin, buffer, sizeof origin);
  motion.stepOrigin = static_cast<std::int64_t>(origin);
}

ResidentVerdict FixMoveGpudem::resident()
{
  if (variable) return ResidentVerdict::no("style 'variable' runs on the host");
  return {};
}

void FixMoveGpudem::describe(gpudem::SceneSpec &scene)
{
  scene.integrators.push_back(motion);
}
