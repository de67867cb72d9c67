// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "resident_plan.h"

#include "fix_balance_slice.h"
#include "fix_move_gpudem.h"
#include "fix_neigh_history_gpudem.h"
#include "formula.h"
#include "gpudem_settings.h"
#include "gpudem/engine.h"
#include "lammps_compat.h"
#include "resident.h"
#include "resident_wall.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "output.h"
#include "pair_hybrid.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

/// The pair style that the device is to evaluate: the pair style itself, or the only sub-style of a hybrid that uses it
/// for all types. Null if there is none.
ResidentPair *residentPair(LAMMPS *lmp)
{
  auto *hybrid = dynamic_cast<PairHybrid *>(lmp->force->pair);
  return dynamic_cast<ResidentPair *>(hybrid ? GpudemCompat::soleSubStyle(hybrid, lmp->atom->ntypes)
                                             : lmp->force->pair);
}

/// fix balance and balance/slice move sub-domains, not faces of the box: on one rank they have nothing to do.
bool balances(const Fix *fix)
{
  return strcmp(fix->style, "balance") == 0 || strcmp(fix->style, "balance/slice") == 0;
}

/// Why a fix that balances cannot do so between events, empty if it can. Lists of neighbours live on the device.
std::string balanceObstacle(const Fix *fix)
{
  if (const auto *slice = dynamic_cast<const FixBalanceSlice *>(fix)) {
    if (!slice->needsNeighbors()) return "";
    return fmt::format("fix {} ({}) weighs particles by neighbours, whose lists the device would hold", fix->id,
                       fix->style);
  }
  if (!GpudemCompat::weighs(fix)) return "";
  return fmt::format("fix {} ({}) weighs particles, which is possible with fix balance/slice only", fix->id,
                     fix->style);
}

/// First obstacle to residency, empty if there is none.
std::string obstacle(LAMMPS *lmp)
{
  Force *force = lmp->force;
  if (lmp->domain->triclinic) return "the box is triclinic";
  if (!force->pair) return "there is no pair style";
  const ResidentPair *pair = residentPair(lmp);
  if (!pair) return fmt::format("pair style {} has no device version", force->pair_style);
  if (!pair->obstacle().empty()) return pair->obstacle();
  if (!force->pair->compute_flag) return "pair_modify compute no";
  if (strcmp(lmp->atom->atom_style, "sphere") != 0)
    return fmt::format("atom style {} is not sphere", lmp->atom->atom_style);
  if (lmp->atom->molecular != Atom::ATOMIC || force->bond || force->angle || force->dihedral || force->improper)
    return "there are bonds or molecules";
  if (force->kspace) return "there is a kspace style";
  if (lmp->neighbor->includegroup) return "neigh_modify include is set";
  if (lmp->neighbor->nex_mol) return "neigh_modify exclude molecule is set";
  if (lmp->neighbor->nex_group > gpudem::maxGroupExclusions) return "there are too many neigh_modify exclude group";
  for (int k = 0; k < lmp->modify->nfix; ++k) {
    const Fix *fix = lmp->modify->fix[k];
    if (fix->rigid_flag) return fmt::format("fix {} ({}) moves rigid bodies", fix->id, fix->style);
    if (balances(fix) && lmp->comm->nprocs > 1) {
      const std::string why = balanceObstacle(fix);
      if (!why.empty()) return why;
      continue;
    }
    if (fix->box_change && !balances(fix)) return fmt::format("fix {} ({}) changes the box", fix->id, fix->style);
  }
  return "";
}

void addExclusions(LAMMPS *lmp, gpudem::SceneSpec &scene)
{
  const Neighbor *n = lmp->neighbor;
  for (int k = 0; k < n->nex_type; ++k) scene.exclusions.types.emplace_back(n->ex1_type[k], n->ex2_type[k]);
  for (int k = 0; k < n->nex_group; ++k)
    scene.exclusions.groups.emplace_back(static_cast<unsigned>(n->ex1_bit[k]), static_cast<unsigned>(n->ex2_bit[k]));
}

/// Add one fix to the scene, or say why it stays on the host.
ResidentVerdict place(ResidentFix *candidate, ResidentPlan &plan, bool hostForceSeen)
{
  if (candidate->actsOnForce() && hostForceSeen)
    return ResidentVerdict::no("a fix before it in the script acts on forces on the host");
  if (candidate->actsOnForce() && plan.scene.terms.size() == gpudem::maxTerms)
    return ResidentVerdict::no(fmt::format("the device takes at most {} force terms", gpudem::maxTerms));
  if (!candidate->actsOnForce() && plan.scene.integrators.size() == gpudem::maxIntegrators)
    return ResidentVerdict::no(fmt::format("the device takes at most {} integrators", gpudem::maxIntegrators));
  auto *wall = dynamic_cast<ResidentWall *>(candidate);
  const auto isPlain = [](const ResidentWall *w) { return !w->isRegion(); };
  if (wall && isPlain(wall) && std::count_if(plan.walls.begin(), plan.walls.end(), isPlain) == gpudem::maxWalls)
    return ResidentVerdict::no(fmt::format("the device takes at most {} planes and cylinders", gpudem::maxWalls));
  const ResidentVerdict verdict = candidate->resident();
  if (!verdict.possible) return verdict;
  candidate->term = -1;
  candidate->describe(plan.scene);
  plan.fixes.push_back(candidate);
  if (wall) plan.walls.push_back(wall);
  if (auto *move = dynamic_cast<FixMoveGpudem *>(candidate)) plan.moves.push_back(move);
  if (candidate->term >= 0 && candidate->varies()) plan.varying.push_back(candidate);
  return {};
}

void classify(LAMMPS *lmp, ResidentPlan &plan)
{
  constexpr int integrates = INITIAL_INTEGRATE | POST_INTEGRATE | FINAL_INTEGRATE;
  constexpr int forces = PRE_FORCE | PRE_REVERSE | POST_FORCE;
  Modify *modify = lmp->modify;
  bool hostForceSeen = false;
  for (int k = 0; k < modify->nfix; ++k) {
    Fix *fix = modify->fix[k];
    const int mask = modify->fmask[k];
    if (auto *history = dynamic_cast<FixNeighHistoryGpudem *>(fix)) {
      plan.history = history;
      continue;
    }
    if (dynamic_cast<FixBalanceSlice *>(fix) && lmp->comm->nprocs > 1 && !fix->force_reneighbor) {
      plan.onHost.push_back(fmt::format("fix {} ({}) on the host at the start of runs", fix->id, fix->style));
      continue;
    }
    if (balances(fix) && lmp->comm->nprocs == 1) {
      plan.skipped.push_back(fmt::format("fix {} ({}), on one rank", fix->id, fix->style));
      continue;
    }
    if (strcmp(fix->style, "GROUP") == 0) {
      plan.groups.push_back(fix);
      plan.onHost.push_back(fmt::format("members of group {} on the host at every {} steps", fix->id + strlen("GROUP_"),
                                        std::max(1, fix->nevery)));
      continue;
    }
    std::string why;
    if (auto *candidate = dynamic_cast<ResidentFix *>(fix)) {
      candidate->onDevice = false;
      const ResidentVerdict verdict = place(candidate, plan, hostForceSeen);
      if (verdict.possible) continue;
      why = ": " + verdict.reason;
    }
    if (fix->force_reneighbor) plan.scheduled.push_back(fix);
    std::vector<std::string> when;
    if (mask & integrates) {
      plan.hostIntegrates = true;
      when.emplace_back("every step (integration)");
    }
    if (mask & forces) {
      plan.hostForces = hostForceSeen = true;
      when.emplace_back("every step (forces)");
    }
    // fix balance only finishes at pre_neighbor what it began at the step it asked for
    const bool balances = fix->box_change & Fix::BOX_CHANGE_DOMAIN;
    if (((mask & (PRE_NEIGHBOR | POST_NEIGHBOR)) && !balances) || ((mask & PRE_EXCHANGE) && !fix->force_reneighbor)) {
      plan.hostRebuilds = true;
      when.emplace_back("every reneighbouring");
    }
    if ((mask & PRE_EXCHANGE) && fix->force_reneighbor) when.emplace_back("the steps it asks for");
    if (mask & END_OF_STEP) {
      plan.endOfStep.push_back(std::max(1, fix->nevery));
      when.emplace_back(fix->nevery > 1 ? fmt::format("every {} steps", fix->nevery) : "every step");
    }
    if (when.empty()) continue;
    std::string line = fmt::format("fix {} ({}) on the host", fix->id, fix->style);
    for (std::size_t w = 0; w < when.size(); ++w) line += (w ? ", " : " at ") + when[w];
    plan.onHost.push_back(line + why);
  }
}

void checkThermo(LAMMPS *lmp, ResidentPlan &plan)
{
  const GpudemCompat::ThermoInputs in = GpudemCompat::thermoInputs(lmp->output->thermo);
  std::vector<std::string> readers;
  for (Compute *c : in.computes)
    if (!dynamic_cast<ResidentCompute *>(c) && strcmp(c->style, "pressure") != 0 && strcmp(c->style, "pe") != 0)
      readers.push_back(fmt::format("compute {} ({})", c->id, c->style));
  for (Fix *f : in.fixes)
    if (!dynamic_cast<ResidentFix *>(f) && !balances(f) && !utils::strmatch(f->style, "^ave/") &&
        !utils::strmatch(f->style, "^pour") && !utils::strmatch(f->style, "^check/timestep"))
      readers.push_back(fmt::format("fix {} ({})", f->id, f->style));
  for (const std::string &v : in.variables)
    if (!isHostFree(lmp, v, FormulaScope::Thermo)) readers.push_back("variable " + v);
  if (readers.empty()) return;
  std::sort(readers.begin(), readers.end());
  readers.erase(std::unique(readers.begin(), readers.end()), readers.end());
  plan.thermoOnDevice = false;
  plan.onHost.push_back(
      fmt::format("{} at thermodynamic output: particles are copied to the host each time", fmt::join(readers, ", ")));
}

/// Styles with messages of their own between ranks, or between a rank and its periodic images.
void checkGhosts(LAMMPS *lmp, ResidentPlan &plan)
{
  for (int k = 0; k < lmp->modify->nfix; ++k) {
    const Fix *fix = lmp->modify->fix[k];
    if (dynamic_cast<const ResidentFix *>(fix) || dynamic_cast<const FixNeighHistoryGpudem *>(fix)) continue;
    plan.hostGhosts = plan.hostGhosts || fix->comm_forward || fix->comm_reverse;
  }
  for (int k = 0; k < lmp->modify->ncompute; ++k) {
    const Compute *c = lmp->modify->compute[k];
    plan.hostGhosts = plan.hostGhosts || c->comm_forward || c->comm_reverse;
  }
}

void checkLists(LAMMPS *lmp, ResidentPlan &plan)
{
  for (int k = 0; k < lmp->neighbor->old_nrequest; ++k) {
    const NeighRequest *r = lmp->neighbor->old_requests[k];
    if (r->requestor == lmp->force->pair || r->requestor == dynamic_cast<Pair *>(plan.pair)) continue;
    plan.hostLists = true;
  }
  for (int k = 0; k < lmp->modify->ncompute; ++k) {
    const Compute *c = lmp->modify->compute[k];
    if (c->peatomflag || c->pressatomflag) plan.hostLists = true;
  }
  if (plan.hostLists)
    plan.onHost.push_back(
        "a compute or fix reads neighbours or per-atom virials: ghosts and lists are built on the "
        "host at the steps it acts");
}

void describeSkipped(LAMMPS *lmp, ResidentPlan &plan)
{
  const gpudem::SceneSpec &scene = plan.scene;
  if (scene.pairModels.empty() && scene.pair.tangential == gpudem::TangentialModel::None)
    plan.skipped.push_back("friction, torques");
  if (gpudem::pairHistoryLayout(scene).size == 0) plan.skipped.push_back("contact history");
  if (plan.walls.empty()) plan.skipped.push_back("walls");
  if (plan.scene.terms.empty()) plan.skipped.push_back("force terms");
  if (!plan.scene.exclusions.any()) plan.skipped.push_back("exclusions");
  if (!plan.hostLists) plan.skipped.push_back("ghosts and neighbour lists on the host");
  (void)lmp;
}

}  // namespace

ResidentPlan LAMMPS_NS::planResidentRun(LAMMPS *lmp)
{
  ResidentPlan plan;
  plan.reason = obstacle(lmp);
  if (!plan.reason.empty()) return plan;

  plan.pair = residentPair(lmp);
  gpudem::SceneSpec &scene = plan.scene;
  scene.types = lmp->atom->ntypes;
  plan.pair->describeLaws(scene);
  scene.frozenMask = plan.pair->frozenMask();
  scene.timestep = lmp->update->dt;
  scene.halfKick = 0.5 * lmp->update->dt * lmp->force->ftm2v;
  scene.skin = lmp->neighbor->skin;
  scene.largestRadius = plan.pair->largestRadius();
  const GpudemSettings &settings = gpudemSettings(lmp);
  scene.levels = settings.neighbor == "single" ? 1 : settings.levels;
  if (settings.neighbor == "multigrid") scene.levelRatio = 2.0;
  addExclusions(lmp, scene);
  classify(lmp, plan);
  if (gpudem::keepsContacts(scene) && !plan.history) {
    plan.reason = "the pair style's contact history is kept by a stock fix";
    return plan;
  }
  if (!(scene.largestRadius > 0.0)) {
    plan.reason = "there is no grain of finite size, and no insertion fix announces one";
    return plan;
  }
  const double reach = 2.0 * scene.largestRadius + scene.skin;
  for (int d = 0; d < lmp->domain->dimension; ++d)
    if (lmp->domain->periodicity[d] && lmp->domain->prd[d] < 2.0 * reach) {
      plan.reason = fmt::format("the periodic box is {:g} long in {}, less than twice the interaction range {:g}",
                                lmp->domain->prd[d], "xyz"[d], reach);
      return plan;
    }
  checkThermo(lmp, plan);
  checkGhosts(lmp, plan);
  checkLists(lmp, plan);
  for (int k = 0; plan.hostLists && lmp->comm->nprocs > 1 && k < lmp->modify->nfix; ++k) {
    const auto *slice = dynamic_cast<const FixBalanceSlice *>(lmp->modify->fix[k]);
    if (!slice || !slice->weighsByVariable()) continue;
    plan.reason = fmt::format(
        "fix {} ({}) weighs particles by a variable, and a style reads neighbour lists on the host, "
        "which are not there when it does",
        slice->id, slice->style);
    return plan;
  }
  describeSkipped(lmp, plan);
  plan.possible = true;
  return plan;
}
