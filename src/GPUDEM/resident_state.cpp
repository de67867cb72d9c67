// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "resident_state.h"

#include "fix_move_gpudem.h"
#include "fix_neigh_history_gpudem.h"
#include "gpudem_settings.h"
#include "resident_wall.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

using namespace LAMMPS_NS;

static_assert(sizeof(tagint) == 4 && sizeof(imageint) == 4, "GPUDEM needs LAMMPS' default integer sizes (SMALLBIG)");

void ResidentState::prepareEngine()
{
  const GpudemSettings &settings = gpudemSettings(lmp);
  if (engine_ && settingsVersion_ == settings.version) return;
  if (comm->nprocs > 1 && !ranks_) ranks_ = std::make_unique<MpiRankExchange>(world);
  const int neighbours = ranks_ ? ranks_->ranksOnHost() : 1;
  gpudem::EngineOptions o;
  const int gpus = gpudem::gpuCount();
  if (settings.device == "gpu" && gpus == 0)
    error->all(FLERR, "Command gpudem device gpu: there is no usable GPU ({}); use 'gpudem device cpu'",
               gpudem::gpuProblem());
  o.device = settings.device == "gpu" || (settings.device == "auto" && gpus > 0) ? gpudem::DeviceKind::Gpu
                                                                                 : gpudem::DeviceKind::Cpu;
  o.precision = settings.precision == "double" ? gpudem::Precision::Double : gpudem::Precision::Mixed;
  o.threads = settings.threads > 0 ? settings.threads
                                   : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / neighbours);
  o.warps = settings.warps;
  if (ranks_ && gpus > 0) o.gpu = ranks_->rankOnHost() % gpus;
  engine_.reset();
  engine_ = gpudem::makeEngine(o);
  engine_->joinRanks(ranks_.get());
  onGpu_ = o.device == gpudem::DeviceKind::Gpu;
  settingsVersion_ = settings.version;
}

gpudem::HostParticles ResidentState::host() const
{
  gpudem::HostParticles h;
  h.count = static_cast<std::size_t>(atom->nlocal);
  h.position = atom->x[0];
  h.velocity = atom->v[0];
  h.spin = atom->omega[0];
  h.force = atom->f[0];
  h.torque = atom->torque[0];
  h.radius = atom->radius;
  h.mass = atom->rmass;
  h.mask = atom->mask;
  h.type = atom->type;
  h.tag = atom->tag;
  h.image = atom->image;
  return h;
}

gpudem::Box ResidentState::box() const
{
  gpudem::Box b;
  for (int d = 0; d < 3; ++d) {
    b.lo[d] = domain->boxlo[d];
    b.hi[d] = domain->boxhi[d];
    b.periodic[d] = domain->periodicity[d] != 0;
  }
  b.dimension = domain->dimension;
  return b;
}

void ResidentState::checkFinite(unsigned fields) const
{
  const struct {
    unsigned field;
    double *const *values;
    const char *name;
  } arrays[] = {{gpudem::fieldPosition, atom->x, "position"},
                {gpudem::fieldVelocity, atom->v, "velocity"},
                {gpudem::fieldSpin, atom->omega, "angular velocity"},
                {gpudem::fieldForce, atom->f, "force"},
                {gpudem::fieldTorque, atom->torque, "torque"}};
  for (const auto &array : arrays) {
    if (!(fields & array.field)) continue;
    for (int i = 0; i < atom->nlocal; ++i) {
      const double *a = array.values[i];
      if (!std::isfinite(a[0] + a[1] + a[2]))
        error->one(FLERR, "GPUDEM: atom {} at step {} has the {} {:g} {:g} {:g}, which is not finite", atom->tag[i],
                   update->ntimestep, array.name, a[0], a[1], a[2]);
    }
  }
}

void ResidentState::checkRadii()
{
  for (int i = 0; i < atom->nlocal; ++i)
    if (!(atom->radius[i] > 0.0) || !std::isfinite(atom->radius[i]))
      error->one(FLERR, "GPUDEM: atom {} at step {} has the radius {:g}; it must be a number above 0", atom->tag[i],
                 update->ntimestep, atom->radius[i]);
}

gpudem::Home ResidentState::home() const
{
  gpudem::Home h;
  for (int d = 0; d < 3; ++d) h.middle[d] = 0.5 * (domain->sublo[d] + domain->subhi[d]);
  h.commonMotion = !ranks_ || thinnest_ > 4.0 * neighbor->skin;
  return h;
}

double ResidentState::noteSubDomains()
{
  if (!ranks_) return 0.0;
  double width = domain->subhi[0] - domain->sublo[0];
  for (int d = 1; d < domain->dimension; ++d) width = std::min(width, domain->subhi[d] - domain->sublo[d]);
  MPI_Allreduce(&width, &thinnest_, 1, MPI_DOUBLE, MPI_MIN, world);
  return thinnest_;
}

double ResidentState::strayLimit(const ResidentPlan &plan) const
{
  // LAMMPS hands grains on to ranks that touch only, and before the next rebuild a grain may move by a few skins
  if (thinnest_ <= 4.0 * neighbor->skin) return 0.0;
  constexpr double share = 0.02;  // of the width: a few per cent more ghosts
  return std::min(std::max(plan.scene.largestRadius, share * thinnest_), 0.25 * thinnest_);
}

void ResidentState::rebuild()
{
  engine_->setHome(home());
  engine_->rebuild(box());
}

void ResidentState::uploadAll(const ResidentPlan &plan, FixNeighHistoryGpudem::Source source)
{
  checkFinite(gpudem::fieldKinetic);
  checkRadii();
  gpudem::SceneSpec scene = plan.scene;
  for (int i = 0; i < atom->nlocal; ++i) scene.largestRadius = std::max(scene.largestRadius, atom->radius[i]);
  if (ranks_) MPI_Allreduce(MPI_IN_PLACE, &scene.largestRadius, 1, MPI_DOUBLE, MPI_MAX, world);
  engine_->setScene(scene);
  engine_->setHome(home());
  gpudem::ContactHistory history;
  if (plan.history) plan.history->exportTo(history, source);
  engine_->upload(host(), box(), plan.history ? &history : nullptr);
  std::vector<double> values;
  for (ResidentWall *wall : plan.walls) {
    if (!wall->numbers()) continue;
    wall->exportHistory(values);
    engine_->uploadWallHistory(wall->wallIndex(), values.data());
  }
  if (!plan.moves.empty()) {
    values.assign(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
    for (FixMoveGpudem *move : plan.moves) {
      const double *origin = move->origins();
      for (int i = 0; i < atom->nlocal; ++i)
        if (atom->mask[i] & move->groupBit()) std::copy_n(origin + 3 * i, 3, values.begin() + 3 * i);
    }
    engine_->uploadOrigins(values.data());
  }
  hostStale_ = deviceStale_ = 0;
  contactsStale_ = false;
}

void ResidentState::downloadAll(const ResidentPlan &plan)
{
  toHost(gpudem::fieldDynamic);
  downloadContacts(plan);
  downloadWallSprings(plan);
  downloadWallContacts(plan);
}

void ResidentState::downloadContacts(const ResidentPlan &plan)
{
  if (!plan.history || !contactsStale_) return;
  gpudem::ContactHistory history;
  engine_->downloadHistory(history);
  plan.history->importFrom(history);
  contactsStale_ = false;
}

void ResidentState::downloadWallSprings(const ResidentPlan &plan)
{
  std::vector<double> values;
  for (ResidentWall *wall : plan.walls) {
    if (!wall->numbers()) continue;
    values.assign(static_cast<std::size_t>(wall->numbers()) * atom->nlocal, 0.0);
    engine_->downloadWallHistory(wall->wallIndex(), values.data());
    wall->importHistory(values);
  }
}

void ResidentState::downloadWallContacts(const ResidentPlan &plan)
{
  std::vector<double> values;
  for (ResidentWall *wall : plan.walls) {
    if (!wall->recordsContacts()) continue;
    values.assign(8 * static_cast<std::size_t>(atom->nlocal), 0.0);
    engine_->downloadWallContacts(wall->wallIndex(), values.data());
    wall->importContacts(values);
  }
}

void ResidentState::toHost(unsigned fields)
{
  fields &= hostStale_;
  if (!fields) return;
  engine_->downloadFields(host(), fields);
  hostStale_ &= ~fields;
}

bool ResidentState::toDevice()
{
  unsigned fields = deviceStale_;
  if (ranks_) MPI_Allreduce(MPI_IN_PLACE, &fields, 1, MPI_UNSIGNED, MPI_BOR, world);
  if (!fields) return false;
  checkFinite(fields);
  engine_->uploadFields(host(), fields);
  deviceStale_ = 0;
  return fields & (gpudem::fieldPosition | gpudem::fieldMask | gpudem::fieldShape);
}

void ResidentState::deviceMoved(unsigned fields)
{
  hostStale_ |= fields;
}

namespace {
/// FNV-1a over 64-bit words: enough to see that a host style wrote to an array.
std::uint64_t fingerprint(const void *data, std::size_t bytes)
{
  const auto *words = static_cast<const std::uint32_t *>(data);
  std::uint64_t h[4] = {0xcbf29ce484222325ull, 0x9ae16a3b2f90404full, 0xc2b2ae3d27d4eb4full, 0x165667b19e3779f9ull};
  const std::size_t n = bytes / 4;
  for (std::size_t k = 0; k < n; ++k) h[k & 3] = (h[k & 3] ^ words[k]) * 0x100000001b3ull;
  return h[0] ^ (h[1] * 3) ^ (h[2] * 5) ^ (h[3] * 7);
}
}  // namespace

ResidentState::Fingerprints ResidentState::fingerprints() const
{
  const gpudem::HostParticles h = host();
  const std::size_t vector = 24 * h.count;
  return {fingerprint(h.position, vector),
          fingerprint(h.velocity, vector),
          fingerprint(h.spin, vector),
          fingerprint(h.force, vector),
          fingerprint(h.torque, vector),
          fingerprint(h.image, 4 * h.count),
          fingerprint(h.mask, 4 * h.count) ^ fingerprint(h.type, 4 * h.count) * 3,
          fingerprint(h.radius, 8 * h.count) ^ fingerprint(h.mass, 8 * h.count) * 3};
}

void ResidentState::noteChanges(const Fingerprints &before)
{
  const Fingerprints now = fingerprints();
  for (unsigned k = 0; k < now.size(); ++k)
    if (now[k] != before[k]) deviceStale_ |= 1u << k;
}
