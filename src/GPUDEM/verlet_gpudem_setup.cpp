// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file VerletGpudem: deciding what is resident, saying so, and the setup of a run.

#include "verlet_gpudem.h"

#include "fix_neigh_history_gpudem.h"
#include "gpudem_settings.h"
#include "resident.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
/// "Hooke contacts, tangential springs", "hertz/material x tsuji x mindlin contacts", ...
std::string describeLaws(const gpudem::SceneSpec &scene)
{
  if (scene.pairModels.empty()) {
    const gpudem::ContactLaw &law = scene.pair;
    return fmt::format("{} contacts, {}", law.normal == gpudem::NormalModel::Hertz ? "Hertz" : "Hooke",
                       law.tangential == gpudem::TangentialModel::Spring    ? "tangential springs"
                       : law.tangential == gpudem::TangentialModel::Viscous ? "viscous friction"
                                                                            : "no friction");
  }
  std::vector<std::string> laws;
  for (const gpudem::ContactModel &model : scene.pairModels) {
    std::string law;
    for (int s = 0; s < gpudem::modelSlots; ++s) {
      const std::string &name = model.slot(static_cast<gpudem::ModelSlot>(s)).name;
      if (name != "none") law += (law.empty() ? "" : " x ") + name;
    }
    if (std::find(laws.begin(), laws.end(), law) == laws.end()) laws.push_back(law);
  }
  return fmt::format("{} contacts", fmt::join(laws, ", "));
}
}  // namespace

void VerletGpudem::enterResident()
{
  for (ResidentFix *fix : plan.fixes) fix->onDevice = true;
  if (plan.history) {
    plan.history->enterResident();
    plan.history->setSynchroniser(this);
  }
  onDevice = true;
  hostListsBuilt = false;
  sumsStep = -1;
}

void VerletGpudem::leaveResident()
{
  if (!onDevice) return;
  for (ResidentFix *fix : plan.fixes) fix->onDevice = false;
  if (plan.history) plan.history->setSynchroniser(nullptr);
  onDevice = false;
}

/// "  ranks     : 4, 4 on 2 GPUs: ranks of a GPU take turns, one rank for each is faster; ghosts by MPI through host memory"
std::string VerletGpudem::describeRanks() const
{
  const MpiRankExchange *ranks = state.ranks();
  if (!ranks) return "";
  const int gpus = plan.possible && state.onGpu() ? gpudem::gpuCount() : 0, here = ranks->ranksOnHost();
  std::string sharing;
  if (gpus > 0)
    sharing = here > gpus ? fmt::format(", {} on {} GPU{}: ranks of a GPU take turns, one rank for each is faster",
                                        here, gpus, gpus > 1 ? "s" : "")
                          : ", a GPU for each";
  return fmt::format("  ranks     : {}{}; ghosts by {}\n", ranks->ranks(), sharing, ranks->name());
}

/// "GPUDEM ranks: grains handed on at 3 of 40 rebuilds; ghosts of a rank at the end 190 to 214, partners at most 2"
void VerletGpudem::printGhosts()
{
  if (!state.ranks() || !gpudemSettings(lmp).verbose) return;
  const gpudem::NeighborReport report = state.engine().neighbors();
  double values[3] = {-static_cast<double>(report.ghosts), static_cast<double>(report.ghosts),
                      static_cast<double>(report.partners)};
  MPI_Allreduce(MPI_IN_PLACE, values, 3, MPI_DOUBLE, MPI_MAX, world);
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "GPUDEM ranks: grains handed on at {} of {} rebuilds; ghosts of a rank at the end {} to {}, "
                   "partners at most {}\n",
                   handOvers, neighbor->ncalls, -values[0], values[1], values[2]);
}

/// "GPUDEM memory: 412 bytes per grain on the device, 13.2 MB in all", arrays that other ranks have included
void VerletGpudem::printMemory()
{
  if (!gpudemSettings(lmp).verbose || atom->natoms == 0) return;
  double bytes = static_cast<double>(state.engine().memory().bytes), sum = 0.0, most = 0.0;
  MPI_Allreduce(&bytes, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&bytes, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  std::string line = fmt::format("GPUDEM memory: {:.0f} bytes per grain on the device, {:.3g} MB in all",
                                 sum / static_cast<double>(atom->natoms), 1e-6 * sum);
  if (comm->nprocs > 1) line += fmt::format(", at most {:.3g} MB of a rank", 1e-6 * most);
  if (line == printedMemory) return;
  printedMemory = line;
  if (comm->me == 0) utils::logmesg(lmp, line + "\n");
}

void VerletGpudem::printPlan()
{
  if (comm->me != 0 || !gpudemSettings(lmp).verbose) return;
  std::string block;
  if (!plan.possible) {
    block = fmt::format("GPUDEM: not resident, LAMMPS' own loop runs: {}\n", plan.reason);
  } else {
    block = fmt::format(
        "GPUDEM resident run\n  device    : {}\n  precision : {}, coordinates of {} bits\n  step      : {}; walls: {}, "
        "force terms: {}, integrators: {}\n",
        state.engine().deviceName(), state.engine().precision() == gpudem::Precision::Double ? "double" : "mixed",
        gpudem::coordinateBits(plan.scene, state.engine().precision()), describeLaws(plan.scene), plan.walls.size(),
        plan.scene.terms.size() - plan.walls.size(), plan.scene.integrators.size());
    block += describeRanks();
    std::string skipped;
    for (const std::string &s : plan.skipped) skipped += (skipped.empty() ? "" : "; ") + s;
    block += fmt::format("  skipped   : {}\n", skipped.empty() ? "nothing" : skipped);
    if (plan.onHost.empty()) block += "  on host   : nothing but output\n";
    for (const std::string &s : plan.onHost) block += fmt::format("  on host   : {}\n", s);
  }
  if (block == printed) return;
  printed = block;
  utils::logmesg(lmp, block);
}

/// The levels follow from the grains, which are known only after the upload.
void VerletGpudem::printLevels()
{
  if (comm->me != 0 || !gpudemSettings(lmp).verbose) return;
  const std::vector<double> radii = state.engine().neighbors().levelRadii;
  std::string line;
  for (const double radius : radii) line += fmt::format(" {:g}", radius);
  if (radii.size() > 1) line = fmt::format("  neighbours: multigrid of {} levels, radii up to{}\n", radii.size(), line);
  else if (gpudemSettings(lmp).neighbor == "multigrid") line = "  neighbours: all grains fit one level\n";
  else line.clear();
  if (line == printedLevels) return;
  printedLevels = line;
  utils::logmesg(lmp, line);
}

/// Tables are made when a surface is first used, or larger grains need a wider reach.
void VerletGpudem::printSurfaces()
{
  for (const gpudem::SurfaceReport &s : state.engine().takeSurfaceReports())
    if (comm->me == 0 && gpudemSettings(lmp).verbose)
      utils::logmesg(lmp, fmt::format("  surface   : {} triangles, search tables of {:.3g} MB made in {:.2g} s\n", s.triangles,
                                      1e-6 * static_cast<double>(s.bytes), s.seconds));
}

void VerletGpudem::setup(int flag)
{
  plan = planResidentRun(lmp);
  if (plan.possible) {
    try {
      state.prepareEngine();
    } catch (const gpudem::Error &e) {
      fail(e);
    }
  }
  printPlan();
  if (!plan.possible) {
    Verlet::setup(flag);
    return;
  }
  try {
    setupResident(flag);
  } catch (const gpudem::Error &e) {
    fail(e);
  }
}

void VerletGpudem::setup_minimal(int flag)
{
  // rerun and friends set positions from outside at every step: nothing can stay on the device
  plan = ResidentPlan();
  plan.reason = "the command sets up without running (rerun, ...)";
  printPlan();
  Verlet::setup_minimal(flag);
}

void VerletGpudem::setupResident(int flag)
{
  if (comm->me == 0 && screen) {
    fmt::print(screen, "Setting up resident Verlet run ...\n");
    if (flag) {
      fmt::print(screen, "  Unit style    : {}\n  Current step  : {}\n  Time step     : {}\n", update->unit_style,
                 update->ntimestep, update->dt);
      timer->print_timeout(screen);
    }
  }
  update->setupflag = 1;
  enterResident();

  atom->setup();
  modify->setup_pre_exchange();
  domain->pbc();
  domain->reset_box();
  comm->setup();
  if (neighbor->style) neighbor->setup_bins();
  handOnFarGrains();
  comm->exchange();
  if (atom->sortfreq > 0) atom->sort();
  if (atom->map_style != Atom::MAP_NONE || plan.hostLists || plan.hostGhosts) comm->borders();
  domain->image_check();
  domain->box_too_small_check();
  modify->setup_pre_neighbor();
  modify->setup_post_neighbor();
  neighbor->ncalls = neighbor->ndanger = 0;
  handOvers = 0;

  for (Fix *fix : plan.groups) fix->setup(0);  // before the force asks who belongs to them
  state.uploadAll(plan, FixNeighHistoryGpudem::Source::Elsewhere);
  state.rebuild();
  printLevels();
  printSurfaces();
  rowsDue = false;
  lastRebuild = update->ntimestep;

  force->setup();
  ev_set(update->ntimestep);
  if (modify->n_pre_force) state.hostSection([&] { modify->setup_pre_force(vflag); });
  if (state.toDevice()) state.rebuild();
  gpudem::Recording record;
  record.virial = vflag % 4 != 0;
  state.engine().evaluateForce(inputs(update->ntimestep), record);
  state.deviceMoved(gpudem::fieldForce | gpudem::fieldTorque | gpudem::fieldVelocity | gpudem::fieldSpin);
  publish(record);
  modify->setup_pre_reverse(eflag, vflag);
  if (plan.onHost.empty()) modify->setup(vflag);
  else state.hostSection([&] { modify->setup(vflag); });
  rowsDue = state.toDevice();

  if (output->ndump || !plan.thermoOnDevice) {
    state.toHost(gpudem::fieldDynamic);
    state.downloadWallContacts(plan);
  }
  if (plan.hostLists) {
    buildHostLists();
    if (vflag / 4 || eflag / 2) evaluatePairOnHost();
  }
  output->setup(flag);
  update->setupflag = 0;
}
