// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "verlet_gpudem.h"

#include "resident.h"
#include "resident_wall.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "irregular.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "timer.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

VerletGpudem::VerletGpudem(LAMMPS *lmp, int narg, char **arg) : Verlet(lmp, narg, arg), state(lmp)
{
}

VerletGpudem::~VerletGpudem() = default;

VerletGpudem *VerletGpudem::active(LAMMPS *lmp)
{
  auto *self = dynamic_cast<VerletGpudem *>(lmp->update->integrate);
  return self && self->onDevice ? self : nullptr;
}

/// With several ranks the others may not know of it.
void VerletGpudem::fail(const gpudem::Error &e) const
{
  if (comm->nprocs > 1) error->one(FLERR, "GPUDEM: {}", e.what());
  else error->all(FLERR, "GPUDEM: {}", e.what());
}

void VerletGpudem::init()
{
  leaveResident();
  Verlet::init();
}

void VerletGpudem::run(int n)
{
  if (!plan.possible) {
    Verlet::run(n);
    return;
  }
  try {
    runResident(n);
  } catch (const gpudem::Error &e) {
    fail(e);
  }
}

void VerletGpudem::cleanup()
{
  if (onDevice) {
    try {
      printGhosts();
      printMemory();
      state.downloadAll(plan);
    } catch (const gpudem::Error &e) {
      fail(e);
    }
    if (!hostListsBuilt)
      for (int k = 0; k < neighbor->nlist; ++k) neighbor->lists[k]->inum = 0;
    leaveResident();
  }
  Verlet::cleanup();
}

void VerletGpudem::runResident(int n)
{
  if (!onDevice) {  // "run N pre no": no setup went before; the host's arrays are the state
    enterResident();
    state.noteSubDomains();
    state.uploadAll(plan, FixNeighHistoryGpudem::Source::Elsewhere);
    state.rebuild();
    rowsDue = false;
    lastRebuild = update->ntimestep;
  }
  const bigint first = update->ntimestep, last = first + n;
  int checked = 0;
  while (update->ntimestep < last) {
    const int done = static_cast<int>(update->ntimestep - first);
    for (; checked <= done; ++checked)
      if (timer->check_timeout(checked)) {
        update->nsteps = done;
        return;
      }
    const bigint event = nextEvent(last);
    advanceTo(event);
    eventStep(event);
    endOfStep(event);
    if (event == output->next) writeOutput(event);
  }
}

/// First step after now at which the host must act.
bigint VerletGpudem::nextEvent(bigint last) const
{
  const bigint now = update->ntimestep;
  if (plan.everyStep()) return now + 1;
  bigint event = std::min(last, std::max(output->next, now + 1));
  for (const Fix *fix : plan.scheduled)
    if (fix->next_reneighbor > now) event = std::min(event, fix->next_reneighbor);
  for (const int period : plan.endOfStep) event = std::min(event, (now / period + 1) * period);
  for (const Fix *fix : plan.groups) event = std::min(event, (now / fix->nevery + 1) * fix->nevery);
  for (const ResidentWall *wall : plan.walls)
    for (const int period : wall->periods()) event = std::min(event, (now / period + 1) * period);
  return event;
}

gpudem::StepInputs VerletGpudem::inputs(bigint step)
{
  gpudem::StepInputs in;
  in.step = step;
  const auto moves = [](const ResidentWall *wall) { return wall->moves(); };
  const auto bodyMoves = [](const ResidentWall *wall) { return wall->bodyMoves(); };
  const bool moving = std::any_of(plan.walls.begin(), plan.walls.end(), moves);
  const bool bodies = std::any_of(plan.walls.begin(), plan.walls.end(), bodyMoves);
  if (plan.varying.empty() && !moving && !bodies) return in;
  const bigint now = update->ntimestep;
  update->ntimestep = step;  // the variables read it
  if (!plan.varying.empty()) {
    in.termValue.resize(plan.scene.terms.size());
    for (std::size_t k = 0; k < in.termValue.size(); ++k) in.termValue[k] = plan.scene.terms[k].value;
    for (ResidentFix *fix : plan.varying) in.termValue[fix->term] = fix->value();
  }
  if (moving) in.wallMotion.resize(plan.scene.walls.size());
  for (ResidentWall *wall : plan.walls)
    if (wall->moves()) in.wallMotion[wall->wallIndex()] = wall->motion();
  if (bodies) in.bodyMotion.resize(plan.scene.walls.size());
  for (ResidentWall *wall : plan.walls)
    if (wall->bodyMoves()) in.bodyMotion[wall->wallIndex()] = wall->bodyMotion();
  update->ntimestep = now;
  return in;
}

/// Book the time since the last stamp, and what of it went by in messages of the engines as communication.
void VerletGpudem::stamp(Timer::ttype what)
{
  timer->stamp(what);
  if (!state.ranks() || !timer->has_normal()) return;
  const double waited = state.ranks()->takeSeconds();
  timer->set_wall(what, timer->get_wall(what) - waited);
  timer->set_wall(Timer::COMM, timer->get_wall(Timer::COMM) + waited);
}

/// From the completed step update->ntimestep to mid step before the force of \p event.
void VerletGpudem::advanceTo(bigint event)
{
  gpudem::Engine &engine = state.engine();
  timer->stamp();
  if (state.toDevice()) rebuildRows();
  bigint step = update->ntimestep + 1;
  engine.beginStep(inputs(step));
  while (step < event) {
    if (rowsDue) {
      update->ntimestep = step;
      stamp(Timer::PAIR);
      rebuildRows();
      stamp(Timer::NEIGH);
    }
    const bigint expected = rebuildInterval - (step - lastRebuild);
    const int batch = static_cast<int>(std::min<bigint>(event - step, std::clamp<bigint>(expected, 4, 64)));
    for (int k = 0; k < batch; ++k) engine.queueStep(inputs(step + k));
    const gpudem::Progress progress = engine.flush();
    step += progress.executed;
    rowsDue = progress.needsRebuild;
  }
  const gpudem::Progress progress = engine.flush();
  rowsDue = rowsDue || progress.needsRebuild;
  state.deviceMoved();
  state.contactsMoved();
  update->ntimestep = event;
  stamp(Timer::PAIR);
}

/// Host call points, force and second half kick of one event step.
void VerletGpudem::eventStep(bigint step)
{
  ev_set(step);
  timer->stamp();
  const bool regroup =
      std::any_of(plan.groups.begin(), plan.groups.end(), [&](const Fix *fix) { return step % fix->nevery == 0; });
  if (plan.hostIntegrates || regroup) {
    state.hostSection([&] {
      if (plan.hostIntegrates) modify->initial_integrate(vflag);
      if (plan.hostIntegrates && modify->n_post_integrate) modify->post_integrate();
      else
        for (Fix *fix : plan.groups) fix->post_integrate();
    });
    rowsDue = state.toDevice() || rowsDue;
    timer->stamp(Timer::MODIFY);
  }
  // lists on the host need every grain in its sub-domain, and once grains have forces they cannot be handed on
  const bool lists = comm->nprocs > 1 && readsLists(step);
  if (reneighborAsked(step) || lists || (rowsDue && plan.hostRebuilds)) rebuildThroughHost();
  else if (rowsDue) rebuildRows();
  stamp(Timer::NEIGH);

  gpudem::Recording record;
  record.virial = vflag % 4 != 0;
  const gpudem::StepInputs in = inputs(step);
  if (plan.hostForces || plan.hostIntegrates) completeWithHost(in, record);
  else completeOnDevice(in, record);
  publish(record);
  stamp(Timer::PAIR);
}

void VerletGpudem::completeOnDevice(const gpudem::StepInputs &in, const gpudem::Recording &record)
{
  state.engine().completeStep(in, record);
  state.deviceMoved();
  state.contactsMoved();
}

void VerletGpudem::completeWithHost(const gpudem::StepInputs &in, const gpudem::Recording &record)
{
  if (modify->n_pre_force && plan.hostForces) {
    state.hostSection([&] { modify->pre_force(vflag); });
    if (state.toDevice()) state.rebuild();
  }
  state.engine().forceStep(in, record);
  state.deviceMoved();
  state.contactsMoved();
  if (plan.hostForces) {
    state.hostSection([&] {
      if (modify->n_pre_reverse) modify->pre_reverse(eflag, vflag);
      if (modify->n_post_force) modify->post_force(vflag);
    });
    rowsDue = state.toDevice() || rowsDue;
  }
  state.engine().finishStep(in);
  state.deviceMoved(gpudem::fieldVelocity | gpudem::fieldSpin);
  if (plan.hostIntegrates) {
    state.hostSection([&] { modify->final_integrate(); });
    rowsDue = state.toDevice() || rowsDue;
  }
}

/// Results of the event that other styles read through their usual members.
void VerletGpudem::publish(const gpudem::Recording &record)
{
  sumsStep = -1;
  const gpudem::Observables &seen = state.engine().observables();
  if (record.virial || eflag) {
    plan.pair->setVirial(seen.virial);
    std::copy(seen.virial.begin(), seen.virial.end(), force->pair->virial);  // of a hybrid that wraps the pair style
  }
  for (ResidentWall *wall : plan.walls) wall->setSums(seen.wall[wall->wallIndex()]);
  for (ResidentFix *fix : plan.fixes)
    if (fix->term >= 0) fix->setForceBefore(seen.termForce[fix->term]);
}

bool VerletGpudem::endOfStepDue(bigint step) const
{
  return std::any_of(plan.endOfStep.begin(), plan.endOfStep.end(), [&](int period) { return step % period == 0; });
}

/// Will a host style read neighbour lists at this event?
bool VerletGpudem::readsLists(bigint step) const
{
  return plan.hostLists && (endOfStepDue(step) || step == output->next);
}

void VerletGpudem::endOfStep(bigint step)
{
  if (!endOfStepDue(step)) return;
  timer->stamp();
  if (plan.hostLists) {
    buildHostLists();
    if (vflag / 4 || eflag / 2) evaluatePairOnHost();
  }
  state.downloadWallContacts(plan);
  state.hostSection([&] { modify->end_of_step(); });
  rowsDue = state.toDevice() || rowsDue;
  timer->stamp(Timer::MODIFY);
}

void VerletGpudem::writeOutput(bigint step)
{
  timer->stamp();
  const bool particles = output->next_dump_any == step || output->next_restart == step;
  if (particles || !plan.thermoOnDevice || plan.hostLists) {
    state.toHost(gpudem::fieldDynamic);
    state.downloadWallContacts(plan);
    if (output->next_restart == step) state.downloadWallSprings(plan);
    if (plan.hostLists) {
      buildHostLists();
      if (vflag / 4 || eflag / 2) evaluatePairOnHost();
    }
  }
  output->write(step);
  timer->stamp(Timer::OUTPUT);
}

gpudem::KineticSums VerletGpudem::sumOverRanks(gpudem::KineticSums own) const
{
  if (comm->nprocs == 1) return own;
  double values[9], all[9];
  std::copy(own.momentumFlux.begin(), own.momentumFlux.end(), values);
  values[6] = own.rotational;
  values[7] = own.gravity;
  values[8] = static_cast<double>(own.count);
  MPI_Allreduce(values, all, 9, MPI_DOUBLE, MPI_SUM, world);
  std::copy_n(all, 6, own.momentumFlux.begin());
  own.rotational = all[6];
  own.gravity = all[7];
  own.count = static_cast<std::int64_t>(all[8]);
  return own;
}

const gpudem::KineticSums &VerletGpudem::kineticSums(unsigned groupMask, const gpudem::Array3 &gravity)
{
  if (sumsStep != update->ntimestep) sums.clear();
  sumsStep = update->ntimestep;
  const auto key = std::make_pair(groupMask, gravity);
  auto found = sums.find(key);
  if (found == sums.end())
    found = sums.emplace(key, sumOverRanks(state.engine().kineticSums(groupMask, gravity))).first;
  return found->second;
}
