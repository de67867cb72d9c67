// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file VerletGpudem: reneighbouring, on the device alone or through LAMMPS' own exchange.

#include "verlet_gpudem.h"

#include "fix_balance_slice.h"
#include "fix_neigh_history_gpudem.h"
#include "resident.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "irregular.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace LAMMPS_NS;

/// A fix scheduled this step, or a restart is written: LAMMPS reneighbours then, whatever has moved.
bool VerletGpudem::reneighborAsked(bigint step) const
{
  bool asked = false;
  for (Fix *fix : plan.scheduled) {
    if (fix->next_reneighbor != step) continue;
    auto *slice = dynamic_cast<FixBalanceSlice *>(fix);
    asked = !(slice && slice->isEvenByCount()) || asked;
  }
  return asked || (output->restart_flag && output->next_restart == step);
}

/// Let LAMMPS fit a shrink-wrapped box to the extent of the grains, without the grains.
void VerletGpudem::shrinkWrap(const gpudem::Extent &extent)
{
  if (atom->nlocal == 0) {
    domain->reset_box();
    return;
  }
  double kept[2][3];
  const int nlocal = atom->nlocal;
  for (int k = 0; k < 2; ++k)
    for (int d = 0; d < 3; ++d) kept[k][d] = atom->x[k][d];
  for (int d = 0; d < 3; ++d) {
    atom->x[0][d] = extent.lo[d];
    atom->x[1][d] = extent.hi[d];
  }
  atom->nlocal = 2;
  domain->reset_box();
  atom->nlocal = nlocal;
  for (int k = 0; k < 2; ++k)
    for (int d = 0; d < 3; ++d) atom->x[k][d] = kept[k][d];
}

/// Must LAMMPS decide about a grain that left the box, or one far from its rank's sub-domain? The same on all ranks.
bool VerletGpudem::mustHandOn(const gpudem::Extent &extent) const
{
  int must = 0;
  const bool several = comm->nprocs > 1;
  const double limit = several ? state.strayLimit(plan) : 0.0;
  for (int d = 0; d < 3 && atom->nlocal > 0; ++d) {
    if (!domain->periodicity[d] && (extent.lo[d] < domain->boxlo[d] || extent.hi[d] >= domain->boxhi[d])) must = 1;
    if (several && (domain->sublo[d] - extent.lo[d] > limit || extent.hi[d] - domain->subhi[d] > limit)) must = 1;
  }
  if (several) MPI_Allreduce(MPI_IN_PLACE, &must, 1, MPI_INT, MPI_MAX, world);
  return must != 0;
}

/// LAMMPS' exchange reaches ranks that touch. Grains farther away than the thinnest sub-domain is wide go first.
void VerletGpudem::handOnFarGrains()
{
  if (comm->nprocs == 1) return;
  double farthest = 0.0;
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < domain->dimension; ++d) {
      const double width = domain->subhi[d] - domain->sublo[d];
      double away = atom->x[i][d] - 0.5 * (domain->subhi[d] + domain->sublo[d]);
      if (domain->periodicity[d]) away -= domain->prd[d] * std::floor(away / domain->prd[d] + 0.5);
      farthest = std::max(farthest, std::fabs(away) - 0.5 * width);
    }
  int skips = farthest > 0.9 * state.noteSubDomains();
  MPI_Allreduce(MPI_IN_PLACE, &skips, 1, MPI_INT, MPI_MAX, world);
  if (!skips) return;
  if (!irregular) irregular = std::make_unique<Irregular>(lmp);
  irregular->migrate_atoms(1);
}

/// Rebuild rows on the device; through the host if a grain left the box, or its rank, and LAMMPS must decide about it.
void VerletGpudem::rebuildRows()
{
  if (plan.hostRebuilds) {
    rebuildThroughHost();
    return;
  }
  if (comm->nprocs > 1 || (domain->nonperiodic && atom->nlocal > 0)) {
    const gpudem::Extent extent = state.engine().extent(state.box());
    if (domain->nonperiodic == 2) shrinkWrap(extent);
    if (mustHandOn(extent)) {
      rebuildThroughHost();
      return;
    }
  }
  state.rebuild();
  state.deviceMoved(gpudem::fieldPosition | gpudem::fieldImage);
  rebuildInterval = std::max<int>(1, static_cast<int>(update->ntimestep - lastRebuild));
  lastRebuild = update->ntimestep;
  ++neighbor->ncalls;
  rowsDue = false;
}

/// LAMMPS' own reneighbouring with all its hooks: insertion, deletion, lost atoms.
void VerletGpudem::rebuildThroughHost()
{
  ++handOvers;
  state.deviceMoved();
  state.contactsMoved();
  state.downloadAll(plan);
  modify->pre_exchange();
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  handOnFarGrains();
  comm->exchange();
  if (atom->map_style != Atom::MAP_NONE || plan.hostRebuilds || plan.hostGhosts) comm->borders();
  modify->pre_neighbor();
  if (plan.hostRebuilds) modify->post_neighbor();
  state.uploadAll(plan, FixNeighHistoryGpudem::Source::Device);
  state.rebuild();
  rebuildInterval = std::max<int>(4, static_cast<int>(update->ntimestep - lastRebuild));
  lastRebuild = update->ntimestep;
  ++neighbor->ncalls;
  rowsDue = false;
}

/// Ghosts of the present positions. Without an exchange before it, borders() would add to the ghosts it finds.
void VerletGpudem::renewGhosts()
{
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  comm->borders();
}

/// Ghosts and stock neighbour lists, contact history included, for host styles that read them at this step.
void VerletGpudem::buildHostLists()
{
  state.toHost(gpudem::fieldDynamic);
  state.downloadContacts(plan);
  domain->pbc();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  renewGhosts();
  neighbor->build(1);
  --neighbor->ncalls;
  if (plan.history) plan.history->fillHostLists();
  hostListsBuilt = true;
}

/// Per-atom virial and energy from the stock pair style, with the velocities its forces saw.
void VerletGpudem::evaluatePairOnHost()
{
  const std::size_t n = 3 * static_cast<std::size_t>(atom->nlocal);
  const auto copy = [n](double **a) { return std::vector<double>(a[0], a[0] + n); };
  const std::vector<double> f = copy(atom->f), torque = copy(atom->torque), v = copy(atom->v), w = copy(atom->omega);
  if (!update->setupflag) state.engine().downloadHalfStepVelocities(state.host());
  renewGhosts();
  force_clear();
  const int setup = update->setupflag;
  update->setupflag = 1;  // springs must not advance
  force->pair->compute(eflag, vflag);
  update->setupflag = setup;
  std::copy(f.begin(), f.end(), atom->f[0]);
  std::copy(torque.begin(), torque.end(), atom->torque[0]);
  std::copy(v.begin(), v.end(), atom->v[0]);
  std::copy(w.begin(), w.end(), atom->omega[0]);
}
