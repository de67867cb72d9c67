// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_wall_gran_gpudem.h"

#include "atom.h"
#include "error.h"
#include "gpudem/engine.h"
#include "memory.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

namespace {
// LAMMPS' own numbering in fix_wall_gran.cpp, where it is local to the file
constexpr int zCylinder = 3, regionWall = 4;
constexpr double absentWall = 1.0e20;
}  // namespace

FixWallGranGpudem::FixWallGranGpudem(LAMMPS *lmp, int narg, char **arg)
    : WallArguments(lmp, narg, arg), FixWallGran(lmp, WallArguments::count(), WallArguments::words()), word(arg[2])
{
  forceTerm = true;
  if (!model) return;
  damping = normal_coeffs[1];
  gpudem::WallSpec spec;
  spec.model = model;
  const int kept = gpudem::wallHistorySize(spec);
  if (wallstyle == regionWall || kept == size_history) return;
  size_history = kept;  // a sub-model that LAMMPS does not have
  memory->destroy(history_one);
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; ++i) std::fill_n(history_one[i], size_history, 0.0);
}

void FixWallGranGpudem::init()
{
  if (model) normal_coeffs[1] = damping;  // the stock style would apply its fit of damping tsuji again at every run
  FixWallGran::init();
}

void FixWallGranGpudem::post_force(int vflag)
{
  if (onDevice) return;
  if (!stockKnows)
    error->all(FLERR,
               "Fix wall/gran: a sub-model that LAMMPS does not have is in use, but this run is not resident (the log "
               "says why); only the resident loop evaluates it");
  FixWallGran::post_force(vflag);
}

ResidentVerdict FixWallGranGpudem::resident()
{
  if (wallstyle == regionWall) return ResidentVerdict::no("wall style 'region' runs on the host");
  if (fix_rigid) return ResidentVerdict::no("rigid bodies run on the host");
  return {};
}

void FixWallGranGpudem::describeLaw(gpudem::ContactLaw &law) const
{
  law.normal = pairstyle == HERTZ_HISTORY ? gpudem::NormalModel::Hertz : gpudem::NormalModel::Hooke;
  law.tangential = pairstyle == HOOKE ? gpudem::TangentialModel::Viscous : gpudem::TangentialModel::Spring;
  law.normalStiffness = kn;
  law.tangentialStiffness = kt;
  law.normalDamping = gamman;
  law.tangentialDamping = gammat;
  law.friction = xmu;
  law.limitDamping = limit_damping != 0;
}

void FixWallGranGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::WallSpec w;
  w.model = model;
  if (!model) describeLaw(w.law);
  w.shape = wallstyle == zCylinder ? gpudem::WallShape::Cylinder : gpudem::WallShape::Plane;
  w.axis = wallstyle == zCylinder ? 2 : wallstyle;
  w.lo = lo <= -absentWall ? -std::numeric_limits<double>::infinity() : lo;
  w.hi = hi >= absentWall ? std::numeric_limits<double>::infinity() : hi;
  w.radius = wallstyle == zCylinder ? cylradius : 0.0;
  w.groupMask = static_cast<unsigned>(groupbit);
  w.wiggle = wiggle != 0;
  w.shear = wshear != 0;
  w.motionAxis = wiggle || wshear ? axis : 0;
  if (wiggle) {
    w.amplitude = amplitude;
    w.angularFrequency = omega;
  }
  if (wshear) w.shearSpeed = vshear;
  w.stepOrigin = time_origin;
  w.recordContacts = peratom_flag != 0;
  wall = static_cast<int>(scene.walls.size());
  scene.walls.push_back(w);

  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::Wall;
  t.groupMask = w.groupMask;
  t.wall = wall;
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}

void FixWallGranGpudem::exportHistory(std::vector<double> &history) const
{
  const int nlocal = atom->nlocal, n = numbers();
  history.assign(static_cast<std::size_t>(n) * nlocal, 0.0);
  for (int i = 0; i < nlocal; ++i) std::copy_n(history_one[i], n, history.begin() + static_cast<std::size_t>(n) * i);
}

void FixWallGranGpudem::importHistory(const std::vector<double> &history)
{
  const int nlocal = atom->nlocal, n = numbers();
  for (int i = 0; i < nlocal; ++i) std::copy_n(history.begin() + static_cast<std::size_t>(n) * i, n, history_one[i]);
}

void FixWallGranGpudem::importContacts(const std::vector<double> &columns)
{
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; ++i) std::copy_n(columns.begin() + 8 * static_cast<std::size_t>(i), 8, array_atom[i]);
}
