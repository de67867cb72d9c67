// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "balance_slice.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"
#include "slice_balancer.h"

using namespace LAMMPS_NS;

void BalanceSlice::command(int narg, char **arg)
{
  if (!domain->box_exist)
    error->all(FLERR, "Balance/slice before there is a box: put it after read_data, read_restart or create_box");
  if (narg < 1) error->all(FLERR, "Balance/slice needs a threshold: balance/slice thresh keyword ...");
  SliceBalancer balancer(lmp, "Balance/slice");
  balancer.readArguments(narg, arg);

  MPI_Barrier(world);
  const double start = MPI_Wtime();
  lmp->init();
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (balancer.needsNeighbors()) neighbor->setup_bins();
  comm->exchange();
  if (balancer.needsNeighbors()) comm->borders();
  if (domain->triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  if (balancer.needsNeighbors()) neighbor->build(1);
  else if (atom->map_style != Atom::MAP_NONE) atom->map_set();

  balancer.init(false);
  balancer.weigh(true);
  const SliceBalancer::Load before = balancer.load();
  if (before.imbalance <= balancer.threshold()) {
    if (comm->me == 0)
      utils::logmesg(lmp, "Balance/slice: imbalance {:.8} is not above {}, sub-domains stay\n", before.imbalance,
                     balancer.threshold());
    return;
  }
  const SliceBalancer::Outcome outcome = balancer.balance();

  bigint count = atom->nlocal, total = 0;
  MPI_Allreduce(&count, &total, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total != atom->natoms)
    error->all(FLERR, "Balance/slice lost atoms: there were {}, now there are {}", atom->natoms, total);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "Balance/slice: {}, {:.3f} seconds\n"
                   "{}"
                   "  histograms summed = {}, cuts moved = {}, atoms moved = {}\n"
                   "  initial/final maximal load/proc = {:.8} {:.8}\n"
                   "  initial/final imbalance factor  = {:.8} {:.8}\n",
                   balancer.shape(), MPI_Wtime() - start, balancer.info(), outcome.rounds, outcome.cuts, outcome.moved,
                   before.most, outcome.load.most, before.imbalance, outcome.load.imbalance);
}
