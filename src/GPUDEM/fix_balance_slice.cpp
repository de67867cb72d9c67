// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_balance_slice.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "kspace.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixBalanceSlice::FixBalanceSlice(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), balancer(lmp, "Fix balance/slice")
{
  if (narg < 5)
    error->all(FLERR,
               "Fix balance/slice needs Nfreq and a threshold: fix ID group balance/slice Nfreq thresh keyword ...");
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery < 0)
    error->all(FLERR, "Fix balance/slice: Nfreq {} must be a number of steps, or 0 for the start of runs only", arg[3]);
  balancer.readArguments(narg - 4, arg + 4);
  if (balancer.weighsByVariable() && nevery == 0)
    error->all(FLERR, "Fix balance/slice: weight var needs Nfreq above 0, since a variable is known during a run only");

  box_change = BOX_CHANGE_DOMAIN;
  pre_exchange_migrate = 1;
  scalar_flag = 1;
  extscalar = 0;
  vector_flag = 1;
  size_vector = 4;
  extvector = 0;
  global_freq = 1;
  if (nevery) force_reneighbor = 1;
  next_reneighbor = -1;
}

int FixBalanceSlice::setmask()
{
  return PRE_EXCHANGE;
}

void FixBalanceSlice::init()
{
  balancer.init(true);
}

void FixBalanceSlice::setup_pre_exchange()
{
  check(false);
}

void FixBalanceSlice::pre_exchange()
{
  if (!nevery || update->ntimestep < next_reneighbor) return;
  check(true);
}

bool FixBalanceSlice::isEvenByCount()
{
  if (!balancer.countsOnly() || update->ntimestep == lastCheck) return false;
  balancer.weigh(false);
  const SliceBalancer::Load now = balancer.load();
  if (now.imbalance > balancer.threshold()) return false;
  lastCheck = update->ntimestep;
  before = after = now;
  next_reneighbor = (update->ntimestep / nevery) * nevery + nevery;
  return true;
}

void FixBalanceSlice::check(bool listIsCurrent)
{
  // twice in one step would give the measured time a second meaning
  if (update->ntimestep == lastCheck) return;
  lastCheck = update->ntimestep;

  // sub-domains divide the box as it is now, and particles must be in it before they are handed on
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  if (domain->triclinic) domain->lamda2x(atom->nlocal);

  const bool variables = listIsCurrent && balancer.weighsByVariable();
  if (variables) modify->clearstep_compute();
  balancer.weigh(listIsCurrent);
  if (variables) modify->addstep_compute(update->ntimestep + nevery);

  before = after = balancer.load();
  if (before.imbalance > balancer.threshold()) {
    const SliceBalancer::Outcome outcome = balancer.balance();
    after = outcome.load;
    rounds = outcome.rounds;
    moved = outcome.moved;
    if (force->kspace) force->kspace->setup_grid();
  }
  if (nevery) next_reneighbor = (update->ntimestep / nevery) * nevery + nevery;
}

double FixBalanceSlice::compute_vector(int i)
{
  if (i == 0) return after.most;
  if (i == 1) return rounds;
  if (i == 2) return before.imbalance;
  return static_cast<double>(moved);
}
