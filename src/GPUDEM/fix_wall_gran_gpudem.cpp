// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_wall_gran_gpudem.h"

#include "atom.h"
#include "memory.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

namespace {
// LAMMPS' own numbering in fix_wall_gran.cpp, where it is local to the file
constexpr int zCylinder = 3, regionWall = 4;
constexpr double absentWall = 1.0e20;
}  // namespace

FixWallGranGpudem::FixWallGranGpudem(LAMMPS *lmp, int narg, char **arg) : ResidentWallGran<FixWallGran>(lmp, narg, arg)
{
  if (wallstyle == regionWall || !keepsOtherNumbers()) return;
  memory->destroy(history_one);
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; ++i) std::fill_n(history_one[i], size_history, 0.0);
}

ResidentVerdict FixWallGranGpudem::resident()
{
  if (wallstyle == regionWall) return ResidentVerdict::no("wall style 'region' needs fix wall/gran/region");
  if (fix_rigid) return ResidentVerdict::no("rigid bodies run on the host");
  return {};
}

void FixWallGranGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::WallSpec w;
  describeCommon(w);
  w.shape = wallstyle == zCylinder ? gpudem::WallShape::Cylinder : gpudem::WallShape::Plane;
  w.axis = wallstyle == zCylinder ? 2 : wallstyle;
  w.lo = lo <= -absentWall ? -std::numeric_limits<double>::infinity() : lo;
  w.hi = hi >= absentWall ? std::numeric_limits<double>::infinity() : hi;
  w.radius = wallstyle == zCylinder ? cylradius : 0.0;
  w.wiggle = wiggle != 0;
  w.shear = wshear != 0;
  w.motionAxis = wiggle || wshear ? axis : 0;
  if (wiggle) {
    w.amplitude = amplitude;
    w.angularFrequency = omega;
  }
  if (wshear) w.shearSpeed = vshear;
  w.stepOrigin = time_origin;
  append(scene, w);
}

void FixWallGranGpudem::exportHistory(std::vector<double> &history)
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
