// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "pair_granular_gpudem.h"

#include "fix_neigh_history_gpudem.h"
#include "gpudem_settings.h"
#include "lammps_compat.h"
#include "material_file.h"
#include "resident_names.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "gpudem/errors.h"
#include "modify.h"
#include "neigh_list.h"
#include "update.h"
#include "utils.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using gpudem::ContactModel;
using gpudem::ModelSlot;

void PairGranularGpudem::coeff(int narg, char **arg)
{
  if (narg < 2) error->all(FLERR, "Pair_coeff: two type ranges are missing");
  if (!allocated) allocate();
  if (narg > 2 && MaterialFile::isName(arg[2])) {
    coeffOfMaterials(narg, arg);
    return;
  }
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
  GranularWords words;
  readGranularWords(lmp, "Pair_coeff", narg, arg, 2, {}, words);
  int pairs = 0;
  for (int i = ilo; i <= ihi; ++i)
    for (int j = std::max(jlo, i); j <= jhi; ++j) {
      set(i, j, words.model, words.cutoff);
      if (i == j) densities_.forget(i);
      ++pairs;
    }
  if (pairs == 0) error->all(FLERR, "Pair_coeff: the ranges {} and {} hold no pair of types i <= j", arg[0], arg[1]);
}

void PairGranularGpudem::set(int i, int j, const ContactModel &model, double cutoff)
{
  models_[{i, j}] = model;
  mixed_[{i, j}] = false;
  writeTables(i, j);
  GpudemCompat::granularTables(this).cutoff[i][j] = GpudemCompat::granularTables(this).cutoff[j][i] = cutoff;
  setflag[i][j] = 1;
}

/// pair_coeff * * file.gran NAME ...: a material or NULL for each type.
void PairGranularGpudem::coeffOfMaterials(int narg, char **arg)
{
  if (strcmp(arg[0], "*") != 0 || strcmp(arg[1], "*") != 0)
    error->all(FLERR, "Pair_coeff: a material file names all types: pair_coeff * * {} ..., not {} {}", arg[2], arg[0],
               arg[1]);
  if (narg != 3 + atom->ntypes)
    error->all(FLERR, "Pair_coeff: after {} stands a material or NULL for each of the {} atom types, not {} words",
               arg[2], atom->ntypes, narg - 3);
  const MaterialFile file(lmp, "Pair_coeff", arg[2]);
  const auto name = [&](int type) { return std::string(arg[2 + type]); };
  int pairs = 0;
  for (int i = 1; i <= atom->ntypes; ++i) {
    if (name(i) == "NULL") continue;
    densities_.expect(i, name(i), file.material(name(i)).density);
    for (int j = i; j <= atom->ntypes; ++j) {
      if (name(j) == "NULL") continue;
      set(i, j, file.model(name(i), name(j), gpudem::Partner::Grain), -1.0);
      utils::logmesg(lmp, "  types {} {}, {} {}: {}\n", i, j, name(i), name(j), granularWords(model(i, j)));
      ++pairs;
    }
  }
  if (pairs == 0) error->all(FLERR, "Pair_coeff: no type has a material of {}", arg[2]);
}

/// LAMMPS' numbers for the law of types i and j, so that its restart files and its own loop have the same law.
void PairGranularGpudem::writeTables(int i, int j)
{
  const GpudemCompat::GranularTables t = GpudemCompat::granularTables(this);
  const ContactModel &m = model(i, j);
  const StockNumbers n = stockNumbers(m);
  const gpudem::ContactModuli moduli = gpudem::contactModuli(m);
  const auto both = [&](auto **table, auto value) { table[i][j] = table[j][i] = value; };
  const auto fill = [&](double ***table, std::initializer_list<double> values) {
    int k = 0;
    for (const double v : values) {
      table[i][j][k] = table[j][i][k] = v;
      ++k;
    }
  };
  both(t.normalModel, std::max(0, n.normal));
  both(t.dampingModel, std::max(0, n.damping));
  both(t.tangentialModel, std::max(0, n.tangential));
  both(t.rollModel, std::max(0, n.rolling));
  both(t.twistModel, std::max(0, n.twisting));
  both(t.limitDamping, m.limitDamping ? 1 : 0);
  both(t.young, moduli.known ? m.normal.parameter[0] : 0.0);
  both(t.poisson, moduli.known ? m.normal.parameter[2] : 0.0);
  if (!n.known) return;
  const std::vector<double> &p = m.normal.parameter, &s = m.tangential.parameter;
  fill(t.normal, {moduli.known ? 4.0 / 3.0 * moduli.young : p[0], gpudem::dampingCoefficient(m),
                  moduli.known ? p[2] : 0.0, p.size() > 3 ? p[3] : 0.0});
  if (s.size() == 3) fill(t.tangential, {std::isnan(s[0]) ? 8.0 * moduli.shear : s[0], s[1], s[2]});
  else fill(t.tangential, {0.0, s.empty() ? 0.0 : s[0], s.empty() ? 0.0 : s[1]});
  const auto triple = [&](double ***table, const std::vector<double> &v) {
    fill(table, {v.empty() ? 0.0 : v[0], v.empty() ? 0.0 : v[1], v.empty() ? 0.0 : v[2]});
  };
  triple(t.roll, m.rolling.parameter);
  triple(t.twist, m.twisting.parameter);
}

/// The law of types i and j from LAMMPS' numbers, after a restart file was read. The file has E* but neither E nor nu:
/// any material with that E* serves, since the tangential stiffness is in the file as a number.
GranularWords PairGranularGpudem::readTables(int i, int j) const
{
  const GpudemCompat::GranularTables t = GpudemCompat::granularTables(const_cast<PairGranularGpudem *>(this));
  StockNumbers n;
  n.normal = t.normalModel[i][j];
  n.damping = t.dampingModel[i][j];
  n.tangential = t.tangentialModel[i][j];
  n.rolling = t.rollModel[i][j];
  n.twisting = t.twistModel[i][j];
  GranularWords w;
  ContactModel &m = w.model;
  m = modelOfNumbers(n);
  const double *normal = t.normal[i][j], *tangential = t.tangential[i][j];
  const bool linear = m.normal.name == "hooke", material = n.normal >= 2;
  const double damping =
      m.damping.name == "tsuji" ? restitutionOfCoefficient(std::max(0.0, normal[1]), linear) : normal[1];
  constexpr double nu = 0.25;
  if (material) m.normal.parameter = {0.75 * normal[0] * 2.0 * (1.0 - nu * nu), damping, nu};
  else m.normal.parameter = {normal[0], damping};
  if (gpudem::subModel(ModelSlot::Normal, m.normal.name).parameters.size() == 4)
    m.normal.parameter.push_back(normal[3]);
  if (n.tangential == 0) m.tangential.parameter = {tangential[1], tangential[2]};
  else m.tangential.parameter = {tangential[0], tangential[1], tangential[2]};
  if (n.rolling) m.rolling.parameter.assign(t.roll[i][j], t.roll[i][j] + 3);
  if (m.twisting.name == "sds") m.twisting.parameter.assign(t.twist[i][j], t.twist[i][j] + 3);
  m.limitDamping = t.limitDamping[i][j] != 0;
  w.cutoff = t.cutoff[i][j];
  return w;
}

/// A law that LAMMPS does not have is left out, so that the run after it asks for its pair_coeff.
void PairGranularGpudem::write_restart(FILE *fp)
{
  std::vector<std::pair<int, int>> left;
  for (const auto &entry : models_)
    if (!stockNumbers(entry.second).known) left.push_back(entry.first);
  if (!left.empty())
    error->warning(FLERR,
                   "Pair granular: a restart file cannot hold sub-models that LAMMPS does not have; give their "
                   "pair_coeff again after read_restart");
  for (const auto &[i, j] : left) setflag[i][j] = 0;
  PairGranular::write_restart(fp);
  for (const auto &[i, j] : left) setflag[i][j] = 1;
}

void PairGranularGpudem::read_restart(FILE *fp)
{
  PairGranular::read_restart(fp);
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      if (!setflag[i][j]) continue;
      models_[{i, j}] = readTables(i, j).model;
      mixed_[{i, j}] = false;
    }
}

void PairGranularGpudem::mixUnset()
{
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i + 1; j <= atom->ntypes; ++j) {
      if (setflag[i][j] && !mixed_[{i, j}]) continue;
      try {
        models_[{i, j}] = gpudem::mixModels(model(i, i), model(j, j));
      } catch (const gpudem::Error &e) {
        error->all(FLERR, "Pair granular: types {} and {}: {}; give pair_coeff {} {}", i, j, e.what(), i, j);
      }
      mixed_[{i, j}] = true;
      writeTables(i, j);
      GpudemCompat::granularTables(this).cutoff[i][j] = GpudemCompat::granularTables(this).cutoff[j][i] = -1.0;
      setflag[i][j] = 1;
    }
}

std::vector<ContactModel> PairGranularGpudem::allModels() const
{
  std::vector<ContactModel> all;
  for (const auto &entry : models_) all.push_back(entry.second);
  return all;
}

/// Where the device's numbers lie among LAMMPS', which has a gap of one number per type that rescales.
void PairGranularGpudem::arrangeHistory()
{
  try {
    layout_ = gpudem::historyLayout(allModels());
  } catch (const gpudem::Error &e) {
    error->all(FLERR, "Pair granular: {}", e.what());
  }
  stockKnows_ = true;
  for (const auto &entry : models_) stockKnows_ = stockKnows_ && stockNumbers(entry.second).known;
  const auto length = [&](ModelSlot slot) { return layout_.length[static_cast<int>(slot)]; };
  GpudemCompat::setGranularHistory(this, length(ModelSlot::Tangential) > 0, length(ModelSlot::Rolling) > 0,
                                   length(ModelSlot::Twisting) > 0);
  int gap = 0;
  for (int i = 1; i <= atom->ntypes; ++i) {
    bool rescales = false;
    for (int j = i; j <= atom->ntypes; ++j)
      rescales = rescales || utils::strmatch(model(i, j).tangential.name, "^mindlin_rescale");
    gap += rescales ? 1 : 0;
  }
  stockPlace_.clear();
  const int beyond = gap > 1 ? gap - 1 : 0;
  for (int d = 0; d < layout_.size; ++d) stockPlace_.push_back(d < length(ModelSlot::Tangential) ? d : d + beyond);
  stockSize_ = layout_.size + beyond;
}

void PairGranularGpudem::init_style()
{
  giveBackStockName(lmp, this);
  if (comm->ghost_velocity == 0) {
    if (comm->me == 0) error->warning(FLERR, "Granular pair styles need 'comm_modify vel yes'; GPUDEM turned it on");
    comm->ghost_velocity = 1;
  }
  mixUnset();
  densities_(lmp);
  arrangeHistory();
  beyond_contact = 0;
  for (const auto &entry : models_) beyond_contact |= gpudem::reachesBeyondTouch(entry.second) ? 1 : 0;
  const bool keeps = layout_.size > 0 || beyond_contact;
  if (keeps && fix_history == nullptr) {
    fix_history = (FixNeighHistory *)modify->replace_fix(
        "NEIGH_HISTORY_GRANULAR_DUMMY",
        "NEIGH_HISTORY_GRANULAR all NEIGH_HISTORY/gpudem " + std::to_string(std::max(1, stockSize_)), 1);
    fix_history->pair = this;
  }
  PairGranular::init_style();
  nondefault_history_transfer = 1;
  if (auto *ours = dynamic_cast<FixNeighHistoryGpudem *>(fix_history)) ours->setPlaces(stockPlace_, layout_.mirror);
}

/// What the partner keeps: rolling and twisting numbers have the same sign seen from either grain. The stock style
/// turns them, so that its rolling springs change sign whenever a rebuild lists a pair the other way round.
void PairGranularGpudem::transfer_history(double *source, double *target)
{
  std::fill_n(target, stockSize_, 0.0);
  for (int d = 0; d < layout_.size; ++d) target[stockPlace_[d]] = layout_.mirror[d] * source[stockPlace_[d]];
}

double PairGranularGpudem::largestGap(double radius1, double radius2) const
{
  if (!(radius1 > 0.0) || !(radius2 > 0.0)) return 0.0;
  double gap = 0.0;
  for (const auto &entry : models_)
    gap = std::max(gap, gpudem::pullOffGap(entry.second, radius1 * radius2 / (radius1 + radius2)));
  return gap;
}

/// The stock style shortens the cutoff by the gap of an adhesion neck, where it must lengthen it.
double PairGranularGpudem::init_one(int i, int j)
{
  const double cutoff = PairGranular::init_one(i, j);
  if (!gpudem::reachesBeyondTouch(model(i, j))) return cutoff;
  const double ri = std::max(maxrad_dynamic[i], maxrad_frozen[i]), rj = std::max(maxrad_dynamic[j], maxrad_frozen[j]);
  return std::max(cutoff, ri + rj + largestGap(ri, rj));
}
double PairGranularGpudem::atom2cut(int i)
{
  return 2.0 * atom->radius[i] + (beyond_contact ? largestGap(atom->radius[i], atom->radius[i]) : 0.0);
}
double PairGranularGpudem::radii2cut(double r1, double r2)
{
  return r1 + r2 + (beyond_contact ? largestGap(r1, r2) : 0.0);
}

void PairGranularGpudem::compute(int eflag, int vflag)
{
  if (!stockKnows_)
    error->all(FLERR,
               "Pair granular: a sub-model that LAMMPS does not have is in use, but this run is not resident "
               "(the log says why); only the resident loop evaluates it");
  PairGranular::compute(eflag, vflag);
}

void PairGranularGpudem::describeLaws(gpudem::SceneSpec &scene) const
{
  const int types = atom->ntypes;
  scene.pairModels.clear();
  for (int i = 1; i <= types; ++i)
    for (int j = 1; j <= types; ++j) scene.pairModels.push_back(model(i, j));
}

double PairGranularGpudem::largestRadius() const
{
  double r = 0.0;
  for (int t = 1; t <= atom->ntypes; ++t) r = std::max({r, maxrad_dynamic[t], maxrad_frozen[t]});
  return r;
}

void PairGranularGpudem::setVirial(const std::array<double, 6> &v)
{
  eng_vdwl = eng_coul = 0.0;
  std::copy(v.begin(), v.end(), virial);
}

/// One contact, for compute pair/local: force over distance, and the twelve numbers of the stock style.
double PairGranularGpudem::single(int i, int j, int itype, int jtype, double rsq, double, double, double &fforce)
{
  fforce = 0.0;
  std::fill_n(svector, single_extra, 0.0);
  const double ri = atom->radius[i], rj = atom->radius[j], reach = ri + rj, effective = ri * rj / reach;
  const ContactModel &law = model(itype, jtype);
  std::vector<double> kept(static_cast<std::size_t>(layout_.size), 0.0);
  bool held = false;
  if (fix_history && fix_history->firstvalue && list) {
    const int *jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    for (int jj = 0; jj < jnum; ++jj) {
      if ((jlist[jj] & NEIGHMASK) != j) continue;
      held = fix_history->firstflag[i][jj] != 0;
      const double *values = fix_history->firstvalue[i] + static_cast<std::size_t>(std::max(1, stockSize_)) * jj;
      for (int d = 0; d < layout_.size; ++d) kept[d] = values[stockPlace_[d]];
      break;
    }
  }
  const double limit = reach + (held || gpudem::actsBeforeTouch(law) ? gpudem::pullOffGap(law, effective) : 0.0);
  if (rsq > limit * limit) return 0.0;

  gpudem::ContactState s{};
  double **x = atom->x, **v = atom->v, **omega = atom->omega;
  for (int d = 0; d < 3; ++d) {
    s.branch[d] = x[i][d] - x[j][d];
    s.relativeVelocity[d] = v[i][d] - v[j][d];
    s.surfaceSpin[d] = ri * omega[i][d] + rj * omega[j][d];
    s.spinDifference[d] = omega[i][d] - omega[j][d];
  }
  const double mi = atom->rmass[i], mj = atom->rmass[j], distance = std::sqrt(rsq);
  s.effectiveMass = mi * mj / (mi + mj);
  if (atom->mask[i] & freeze_group_bit) s.effectiveMass = mj;
  if (atom->mask[j] & freeze_group_bit) s.effectiveMass = mi;
  s.overlap = reach - distance;
  s.effectiveRadius = effective;
  s.radius = ri;
  s.partnerRadius = rj;
  const double mine = mi * ri * ri, other = mj * rj * rj;
  s.inertia = mine * other / (mine + other);
  if (atom->mask[i] & freeze_group_bit) s.inertia = other;
  if (atom->mask[j] & freeze_group_bit) s.inertia = mine;
  const gpudem::ContactResult r = gpudem::evaluateContactAtStart(law, layout_, s, kept.data(), update->dt);
  fforce = r.push / distance;
  const auto length = [](const double *a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); };
  // the rolling pseudo-force F of the torque R* n x F
  const double *n = r.normal, *t = r.rolling;
  const double rolling[3] = {(t[1] * n[2] - t[2] * n[1]) / effective, (t[2] * n[0] - t[0] * n[2]) / effective,
                             (t[0] * n[1] - t[1] * n[0]) / effective};
  std::copy_n(r.friction, 3, svector);
  svector[3] = length(r.friction);
  std::copy_n(rolling, 3, svector + 4);
  svector[7] = length(rolling);
  svector[8] = r.twisting;
  std::copy_n(s.branch, 3, svector + 9);
  return 0.0;
}
