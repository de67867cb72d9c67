// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "density_check.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "lammps.h"

#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

namespace {
constexpr double pi = 3.14159265358979323846, tolerance = 0.01;
}

void DensityCheck::expect(int type, const std::string &name, double density)
{
  forget(type);
  if (density > 0.0) expected_[type] = {name, density};
}

void DensityCheck::operator()(LAMMPS *lmp)
{
  const Atom *atom = lmp->atom;
  if (expected_.empty() || !atom->rmass || !atom->radius) return;
  // by type: density over the expected, less 1, of the grain that differs most
  std::vector<double> worst(static_cast<std::size_t>(atom->ntypes) + 1, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    const auto found = expected_.find(atom->type[i]);
    if (found == expected_.end() || !(atom->radius[i] > 0.0)) continue;
    const double r = atom->radius[i], sphere = atom->rmass[i] / (4.0 / 3.0 * pi * r * r * r);
    double off = sphere / found->second.second - 1.0;
    if (lmp->domain->dimension == 2) {  // discs may be meant
      const double disc = atom->rmass[i] / (pi * r * r) / found->second.second - 1.0;
      if (std::abs(disc) < std::abs(off)) off = disc;
    }
    double &w = worst[static_cast<std::size_t>(atom->type[i])];
    if (std::abs(off) > std::abs(w)) w = off;
  }
  std::vector<double> most(worst.size()), least(worst.size());
  MPI_Allreduce(worst.data(), most.data(), static_cast<int>(worst.size()), MPI_DOUBLE, MPI_MAX, lmp->world);
  MPI_Allreduce(worst.data(), least.data(), static_cast<int>(worst.size()), MPI_DOUBLE, MPI_MIN, lmp->world);
  for (int t = 1; t <= atom->ntypes; ++t) {
    const auto k = static_cast<std::size_t>(t);
    const double off = most[k] > -least[k] ? most[k] : least[k];
    const auto found = expected_.find(t);
    if (found == expected_.end() || std::abs(off) <= tolerance) continue;
    if (lmp->comm->me == 0)
      lmp->error->warning(FLERR, "Grains of type {} have a density of {:g}, but their material {} has {:g}", t,
                          found->second.second * (1.0 + off), found->second.first, found->second.second);
    expected_.erase(found);
  }
}
