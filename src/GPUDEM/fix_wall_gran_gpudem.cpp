// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_wall_gran_gpudem.h"

#include "atom.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

namespace {
// LAMMPS' own numbering in fix_wall_gran.cpp, where it is local to the file
constexpr int zCylinder = 3, regionWall = 4;
constexpr double absentWall = 1.0e20;
}  // namespace

FixWallGranGpudem::FixWallGranGpudem(LAMMPS *lmp, int narg, char **arg) : FixWallGran(lmp, narg, arg), word(arg[2])
{
  forceTerm = true;
}

void FixWallGranGpudem::post_force(int vflag)
{
  if (!onDevice) FixWallGran::post_force(vflag);
}

ResidentVerdict FixWallGranGpudem::resident()
{
  if (pairstyle == GRANULAR) return ResidentVerdict::no("interaction style 'granular' runs on the host");
  if (wallstyle == regionWall) return ResidentVerdict::no("wall style 'region' runs on the host");
  if (fix_rigid) return ResidentVerdict::no("rigid bodies run on the host");
  return {};
}

void FixWallGranGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::WallSpec w;
  w.law.normal = pairstyle == HERTZ_HISTORY ? gpudem::NormalModel::Hertz : gpudem::NormalModel::Hooke;
  w.law.tangential = pairstyle == HOOKE ? gpudem::TangentialModel::Viscous : gpudem::TangentialModel::Spring;
  w.law.normalStiffness = kn;
  w.law.tangentialStiffness = kt;
  w.law.normalDamping = gamman;
  w.law.tangentialDamping = gammat;
  w.law.friction = xmu;
  w.law.limitDamping = limit_damping != 0;
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

void FixWallGranGpudem::exportSprings(std::vector<double> &spring) const
{
  const int nlocal = atom->nlocal;
  spring.assign(3 * static_cast<std::size_t>(nlocal), 0.0);
  for (int i = 0; i < nlocal; ++i) std::copy_n(history_one[i], 3, spring.begin() + 3 * static_cast<std::size_t>(i));
}

void FixWallGranGpudem::importSprings(const std::vector<double> &spring)
{
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; ++i) std::copy_n(spring.begin() + 3 * static_cast<std::size_t>(i), 3, history_one[i]);
}

void FixWallGranGpudem::importContacts(const std::vector<double> &columns)
{
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; ++i) std::copy_n(columns.begin() + 8 * static_cast<std::size_t>(i), 8, array_atom[i]);
}
