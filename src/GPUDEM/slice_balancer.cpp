// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "slice_balancer.h"

#include "atom.h"
#include "balance.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "gpudem/errors.h"
#include "irregular.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace LAMMPS_NS;

namespace {

/// A sub-domain as wide as the skin still hands a grain to a rank that touches it; a hair more, against round-off.
constexpr double skins = 1.001;

/// Other slabs, for which most particles change rank, must have a surface smaller by this factor.
constexpr double worthwhile = 0.8;

/// Positions of no particles.
constexpr double nowhere[3] = {0, 0, 0};

/// Positions as fractions of the box for as long as this lives, if the box is tilted.
class LamdaPositions {
 public:
  LamdaPositions(Domain *domain, const Atom *atom) : domain_(domain), atom_(atom)
  {
    if (domain_->triclinic) domain_->x2lamda(atom_->nlocal);
  }
  ~LamdaPositions()
  {
    if (domain_->triclinic) domain_->lamda2x(atom_->nlocal);  // as many as there are then
  }
  const double *origin() const { return domain_->triclinic ? domain_->boxlo_lamda : domain_->boxlo; }
  const double *length() const { return domain_->triclinic ? domain_->prd_lamda : domain_->prd; }

 private:
  Domain *domain_;
  const Atom *atom_;
};

/// Whether there is a grid, and all its parts can be as wide as they must (fractions of the box).
bool fits(const gpudem::SliceGrid &grid, const std::array<double, 3> &smallest)
{
  for (const gpudem::SliceLevel &level : grid.levels)
    for (int g = 0; g < level.groups(); ++g) {
      const int parts = level.groupStart[g + 1] - level.groupStart[g];
      if (parts > 1 && parts * smallest[level.axis] > 1.0) return false;
    }
  return !grid.levels.empty();
}

}  // namespace

SliceBalancer::SliceBalancer(LAMMPS *lmp, std::string who) : Pointers(lmp), who_(std::move(who))
{
}
SliceBalancer::~SliceBalancer() = default;

void SliceBalancer::fail(const std::string &what) const
{
  error->all(FLERR, "{}: {}", who_, what);
}

void SliceBalancer::init(bool fix)
{
  for (const SliceWeight &w : weights_) {
    if (w.imbalance) w.imbalance->init(fix);
    if (w.style != "store") continue;
    int isDouble = 0, columns = 0;
    if (atom->find_custom(w.name.c_str(), isDouble, columns) < 0 || !isDouble || columns)
      fail(
          fmt::format("weight store {}: there is no such vector; define it by fix property/atom d_{}", w.name, w.name));
  }
}

bool SliceBalancer::weighsByVariable() const
{
  return std::any_of(weights_.begin(), weights_.end(), [](const SliceWeight &w) { return w.style == "var"; });
}

bool SliceBalancer::needsNeighbors() const
{
  return std::any_of(weights_.begin(), weights_.end(),
                     [](const SliceWeight &w) { return w.style == "contact" || w.style == "neigh"; });
}

std::string SliceBalancer::info() const
{
  std::string text;
  for (const SliceWeight &w : weights_)
    if (w.imbalance) text += w.imbalance->info();
  return text;
}

void SliceBalancer::weigh(bool listIsCurrent)
{
  weight_.clear();
  if (weights_.empty()) return;
  const int nlocal = atom->nlocal;
  weight_.assign(std::max(nlocal, 1), 1.0);
  for (const SliceWeight &w : weights_) {
    if (auto *contacts = dynamic_cast<ContactWeight *>(w.imbalance.get())) contacts->setListIsCurrent(listIsCurrent);
    if (w.imbalance) w.imbalance->compute(weight_.data());
    for (int i = 0; i < nlocal; ++i)
      if (!(weight_[i] > 0.0) || !std::isfinite(weight_[i]))
        error->one(FLERR, "{}: weight {}{}{} gives atom {} the weight {}; a weight must be a number above 0", who_,
                   w.style, w.name.empty() ? "" : " ", w.name, atom->tag[i], weight_[i]);
  }
}

SliceBalancer::Load SliceBalancer::load()
{
  double mine = atom->nlocal;
  if (!weight_.empty()) {
    mine = 0.0;
    for (int i = 0; i < atom->nlocal; ++i) mine += weight_[i];
  }
  Load load;
  double total;
  MPI_Allreduce(&mine, &load.most, 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&mine, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  if (total > 0.0) load.imbalance = load.most * comm->nprocs / total;
  return load;
}

std::array<double, 3> SliceBalancer::filledRegion() const
{
  // of a uniform region: its edges; a grain that flies alone hardly counts
  const LamdaPositions lamda(domain, atom);
  std::array<double, 7> mine{}, all;
  for (int i = 0; i < atom->nlocal; ++i)
    for (int a = 0; a < 3; ++a) {
      const double f = (atom->x[i][a] - lamda.origin()[a]) / lamda.length()[a];
      mine[a] += f;
      mine[3 + a] += f * f;
    }
  mine[6] = atom->nlocal;
  MPI_Allreduce(mine.data(), all.data(), 7, MPI_DOUBLE, MPI_SUM, world);
  std::array<double, 3> extent;
  for (int a = 0; a < 3; ++a) {
    const double mean = all[a] / all[6], variance = all[3 + a] / all[6] - mean * mean;
    extent[a] = domain->prd[a] * (variance > 0.0 ? std::min(1.0, std::sqrt(12.0 * variance)) : 0.0);
  }
  return extent;
}

bool SliceBalancer::chooseSlabs()
{
  gpudem::SliceRequest request;
  request.ranks = comm->nprocs;
  request.dimension = domain->dimension;
  request.levels = levels_;
  request.axes = axes_;
  request.extent = filledRegion();
  for (int a = 0; a < 3; ++a) request.smallest[a] = width_ / domain->prd[a];
  gpudem::SliceGrid grid = gpudem::makeSliceGrid(request);
  // cuts that are there already are the better beginning, unless the region has become another or the box too small for
  // them
  const double before = gpudem::sliceSurface(grid_, request.extent);
  if (fits(grid_, request.smallest) && gpudem::sliceSurface(grid, request.extent) >= worthwhile * before) return false;
  grid_ = std::move(grid);
  return true;
}

SliceBalancer::Outcome SliceBalancer::balance()
{
  const double *length = domain->prd;
  if (width_ < 0.0) width_ = skins * neighbor->skin;
  gpudem::SliceReport report;
  std::vector<int> owner;
  try {
    const bool anew = chooseSlabs();
    gpudem::SliceOptions options;
    options.aim = aim_;
    options.betweenNeighbors = near_ && !anew;
    for (int a = 0; a < 3; ++a) options.smallest[a] = width_ / length[a];
    const LamdaPositions lamda(domain, atom);
    gpudem::HostSliceParticles particles(atom->nlocal, atom->nlocal ? atom->x[0] : nowhere,
                                         weight_.empty() ? nullptr : weight_.data(), lamda.origin(), lamda.length());
    report = gpudem::balanceSlices(grid_, particles, options, [this](double *values, int n) {
      MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, world);
    });
    owner = particles.group();
  } catch (const gpudem::Error &e) {
    fail(e.what());
  }

  applyToComm();
  if (domain->triclinic) domain->set_lamda_box();
  domain->set_local_box();
  domain->subbox_too_small_check(neighbor->skin);
  if (writer_) writer_->dumpout(update->ntimestep);

  Outcome outcome;
  const bigint leaving = atom->nlocal - std::count(owner.begin(), owner.end(), comm->me);
  MPI_Allreduce(&leaving, &outcome.moved, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!irregular_) irregular_ = std::make_unique<Irregular>(lmp);
  const LamdaPositions lamda(domain, atom);
  irregular_->migrate_atoms(1, 1, owner.data());  // messages in order of rank: the same run gives the same bits
  outcome.load = {report.imbalance, report.heaviest};
  outcome.rounds = report.rounds;
  outcome.cuts = report.moved;
  return outcome;
}

void SliceBalancer::applyToComm()
{
  comm->layout = Comm::LAYOUT_TILED;
  comm->rcbnew = 1;
  const gpudem::TreeCut cut = grid_.treeCut(comm->me);
  comm->rcbcutdim = cut.axis;
  comm->rcbcutfrac = cut.fraction;
  for (int a = 0; a < 3; ++a) {
    const auto bounds = grid_.bounds(comm->me, a);
    comm->mysplit[a][0] = bounds[0];
    comm->mysplit[a][1] = bounds[1];
  }
}

std::string SliceBalancer::shape() const
{
  std::string text;
  for (const gpudem::SliceLevel &level : grid_.levels)
    if (level.parts() > 1)
      text += fmt::format("{}{} parts along {}", text.empty() ? "" : ", ", level.parts(), "xyz"[level.axis]);
  return text;
}

double SliceBalancer::memoryUsage() const
{
  return static_cast<double>(weight_.capacity() * sizeof(double)) + (irregular_ ? irregular_->memory_usage() : 0.0);
}
