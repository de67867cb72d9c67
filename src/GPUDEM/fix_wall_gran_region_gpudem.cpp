// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_wall_gran_region_gpudem.h"

#include "lammps_compat.h"

#include "atom.h"
#include "error.h"
#include "memory.h"

#include <algorithm>

using namespace LAMMPS_NS;

FixWallGranRegionGpudem::FixWallGranRegionGpudem(LAMMPS *lmp, int narg, char **arg)
    : ResidentWallGran<FixWallGranRegion>(lmp, narg, arg)
{
  if (!keepsOtherNumbers()) return;
  memory->destroy(GpudemCompat::regionWallHistory(this));
  grow_arrays(atom->nmax);
}

int FixWallGranRegionGpudem::most() const
{
  const int stock = GpudemCompat::regionWall(const_cast<FixWallGranRegionGpudem *>(this)).most;
  return std::min(stock, gpudem::maxRegionContacts);
}

ResidentVerdict FixWallGranRegionGpudem::resident()
{
  if (fix_rigid) return ResidentVerdict::no("rigid bodies run on the host");
  region = regionParts(lmp, GpudemCompat::regionWall(this).region);
  return region.obstacle.empty() ? ResidentVerdict{} : ResidentVerdict::no(region.obstacle);
}

void FixWallGranRegionGpudem::describe(gpudem::SceneSpec &scene)
{
  gpudem::WallSpec w;
  describeCommon(w);
  w.shape = gpudem::WallShape::Region;
  w.region = region.parts;
  w.mostContacts = most();
  append(scene, w);
}

void FixWallGranRegionGpudem::exportHistory(std::vector<double> &history)
{
  const GpudemCompat::RegionWall stock = GpudemCompat::regionWall(this);
  double ***kept = GpudemCompat::regionWallHistory(this);
  history.assign(static_cast<std::size_t>(numbers()) * atom->nlocal, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (stock.contacts[i] > most())
      error->one(FLERR, "Fix {}: atom {} touches {} faces of the region, the device takes {}", word, atom->tag[i],
                 stock.contacts[i], most());
    auto to = history.begin() + static_cast<std::ptrdiff_t>(numbers()) * i;
    for (int c = 0; c < stock.contacts[i]; ++c, to += 1 + size_history) {
      *to = stock.face[i][c] + 1;
      std::copy_n(kept[i][c], size_history, to + 1);
    }
  }
}

void FixWallGranRegionGpudem::importHistory(const std::vector<double> &history)
{
  const GpudemCompat::RegionWall stock = GpudemCompat::regionWall(this);
  double ***kept = GpudemCompat::regionWallHistory(this);
  auto from = history.begin();
  for (int i = 0; i < atom->nlocal; ++i) {
    int &n = stock.contacts[i];
    n = 0;
    for (int slot = 0; slot < most(); ++slot, from += 1 + size_history) {
      if (*from == 0.0) continue;
      stock.face[i][n] = static_cast<int>(*from) - 1;
      std::copy_n(from + 1, size_history, kept[i][n]);
      ++n;
    }
  }
}
