// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_check_timestep_gran.h"

#include "gpudem/errors.h"
#include "resident.h"
#include "resident_wall.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {
constexpr double none = std::numeric_limits<double>::max();
}

FixCheckTimestepGran::FixCheckTimestepGran(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (!atom->sphere_flag) error->all(FLERR, "Fix check/timestep/gran needs atom style sphere");
  vector_flag = 1;
  size_vector = 5;
  extvector = 0;
  parse(narg, arg);
  global_freq = nevery;
}

void FixCheckTimestepGran::parse(int narg, char **arg)
{
  const std::string who = fmt::format("Fix check/timestep/gran {}: ", arg[0]);
  if (narg < 6)
    error->all(FLERR, who + "expected N, a fraction of the Rayleigh time and a fraction of the Hertz time");
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  if (nevery < 1) error->all(FLERR, fmt::format("{}N is {}, but must be at least 1", who, arg[3]));
  const auto fraction = [&](const char *word, const char *name) {
    const double value = utils::numeric(FLERR, word, false, lmp);
    if (!(value > 0.0)) error->all(FLERR, fmt::format("{}{} is {}, but must be above 0", who, name, word));
    return value;
  };
  rayleighAllowed = fraction(arg[4], "the fraction of the Rayleigh time");
  hertzAllowed = fraction(arg[5], "the fraction of the Hertz time");
  for (int k = 6; k < narg; k += 2) {
    const std::string word = arg[k];
    if (k + 1 >= narg) error->all(FLERR, fmt::format("{}keyword {} has no value", who, word));
    const auto choice = [&] {
      const std::string value = arg[k + 1];
      if (value != "yes" && value != "no") error->all(FLERR, fmt::format("{}{} is {}, but must be yes or no", who, word, value));
      return value == "yes";
    };
    if (word == "warn") warns = choice();
    else if (word == "error") stops = choice();
    else if (word == "contact") contactAllowed = fraction(arg[k + 1], "contact");
    else if (word == "move") moveAllowed = fraction(arg[k + 1], "move");
    else if (word == "speed") givenSpeed = fraction(arg[k + 1], "speed");
    else if (word == "auto") wantedError = fraction(arg[k + 1], "auto");
    else
      error->all(FLERR, fmt::format("{}unknown keyword {}: known are warn, error, contact, move, speed, auto", who, word));
  }
}

int FixCheckTimestepGran::setmask()
{
  return END_OF_STEP;
}

void FixCheckTimestepGran::init()
{
  readLaws();
  usedTypes.clear();
}

void FixCheckTimestepGran::setup(int)
{
  end_of_step();
}

void FixCheckTimestepGran::end_of_step()
{
  readGrains();
  updateTimes();
  check();
}

/// The laws of the pair style and of the walls, as the resident run has them.
void FixCheckTimestepGran::readLaws()
{
  const auto *pair = dynamic_cast<ResidentPair *>(force->pair);
  if (!pair)
    error->all(FLERR, fmt::format("Fix check/timestep/gran {} knows the contact laws of gran/hooke, gran/hooke/history, "
                                  "gran/hertz/history and granular with suffix gpudem, not of pair style {}",
                                  id, force->pair_style ? force->pair_style : "none"));
  gpudem::SceneSpec scene;
  scene.types = atom->ntypes;
  pair->describeLaws(scene);
  pairs = scene.pairModels;
  if (pairs.empty())
    pairs.assign(static_cast<std::size_t>(atom->ntypes) * atom->ntypes, gpudem::headOnModel(scene.pair));
  walls.clear();
  for (int k = 0; k < modify->nfix; ++k) {
    auto *wall = dynamic_cast<ResidentWall *>(modify->fix[k]);
    if (!wall || !wall->resident().possible) continue;
    gpudem::SceneSpec own;
    wall->describe(own);
    for (const gpudem::WallSpec &w : own.walls) walls.push_back(w.model ? *w.model : gpudem::headOnModel(w.law));
  }
}

void FixCheckTimestepGran::readGrains()
{
  const int n = atom->ntypes;
  std::vector<double> mine(2 * n, none), all(2 * n), largest{0.0, 0.0}, over(2);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *v = atom->v[i], radius = atom->radius[i];
    const double speed = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    double &r = mine[2 * (atom->type[i] - 1)], &m = mine[2 * (atom->type[i] - 1) + 1];
    r = std::min(r, radius);
    m = std::min(m, atom->rmass[i]);
    largest[0] = std::max(largest[0], speed);
    largest[1] = std::max(largest[1], speed * update->dt / radius);
  }
  MPI_Allreduce(mine.data(), all.data(), 2 * n, MPI_DOUBLE, MPI_MIN, world);
  MPI_Allreduce(largest.data(), over.data(), 2, MPI_DOUBLE, MPI_MAX, world);
  types.assign(n, {});
  for (int t = 0; t < n; ++t)
    if (all[2 * t] < none) types[t] = {all[2 * t], all[2 * t + 1]};
  fastest = over[0];
  furthest = over[1];
}

/// The shortest times; kept while grains and speeds are the same within a twentieth.
void FixCheckTimestepGran::updateTimes()
{
  const double speed = givenSpeed > 0.0 ? givenSpeed : 2.0 * fastest;
  const auto alike = [](double a, double b) { return a == b || std::abs(a - b) < 0.05 * std::max(a, b); };
  bool same = usedTypes.size() == types.size() && alike(speed, usedSpeed);
  for (std::size_t t = 0; same && t < types.size(); ++t)
    same = alike(types[t].radius, usedTypes[t].radius) && alike(types[t].mass, usedTypes[t].mass);
  if (same) return;
  usedTypes = types;
  usedSpeed = speed;
  times = {none, none, none, none};
  const auto n = types.size();
  try {
    for (std::size_t a = 0; a < n; ++a) {
      if (types[a].radius == 0.0) continue;
      for (std::size_t b = a; b < n; ++b)
        if (types[b].radius > 0.0) add(pairs[a * n + b], types[a], types[b]);
      for (const gpudem::ContactModel &wall : walls) add(wall, types[a], {});
      const gpudem::ContactModuli moduli = gpudem::contactModuli(pairs[a * n + a]);
      if (!moduli.known) continue;
      double young, poisson;
      gpudem::equivalentMaterial(moduli, young, poisson);
      const double r = types[a].radius, density = types[a].mass / (4.0 / 3.0 * 3.14159265358979323846 * r * r * r);
      times.rayleigh = std::min(times.rayleigh, gpudem::rayleighTime(r, density, young, poisson, force->ftm2v));
    }
  } catch (const gpudem::Error &e) {
    error->all(FLERR, fmt::format("Fix check/timestep/gran {}: {}", id, e.what()));
  }
  for (double *t : {&times.rayleigh, &times.hertz, &times.contact, &times.proposal})
    if (*t == none) *t = 0.0;
}

/// One kind of contact, between the smallest grains it can have.
void FixCheckTimestepGran::add(const gpudem::ContactModel &model, const TypeExtremes &a, const TypeExtremes &b)
{
  if (!(usedSpeed > 0.0)) return;
  const gpudem::HeadOnImpact impact{model, a.mass, b.mass, a.radius, b.radius, usedSpeed, force->ftm2v};
  const gpudem::ContactModuli moduli = gpudem::contactModuli(model);
  double young = moduli.known ? moduli.young : 0.0;
  if (model.normal.name == "hertz") young = 0.75 * model.normal.parameter[0];  // kn = 4/3 E*
  if (young > 0.0) {
    const double mass = b.mass > 0.0 ? a.mass * b.mass / (a.mass + b.mass) : a.mass;
    const double radius = b.radius > 0.0 ? a.radius * b.radius / (a.radius + b.radius) : a.radius;
    times.hertz = std::min(times.hertz, gpudem::hertzTime(mass, radius, young, usedSpeed, force->ftm2v));
  }
  times.contact = std::min(times.contact, gpudem::resolveImpact(impact).duration);
  if (wantedError > 0.0) times.proposal = std::min(times.proposal, gpudem::timestepForError(impact, wantedError));
}

void FixCheckTimestepGran::check()
{
  const double dt = update->dt;
  if (times.rayleigh > 0.0) complain(fmt::format("of the Rayleigh time {:.4g}", times.rayleigh), dt / times.rayleigh, rayleighAllowed);
  if (times.hertz > 0.0) complain(fmt::format("of the Hertz time {:.4g}", times.hertz), dt / times.hertz, hertzAllowed);
  if (contactAllowed > 0.0 && times.contact > 0.0)
    complain(fmt::format("of the shortest contact, which lasts {:.4g}", times.contact), dt / times.contact, contactAllowed);
  if (moveAllowed > 0.0 && furthest > moveAllowed) {
    const std::string text = fmt::format("Fix check/timestep/gran {}: a grain moves {:.4g} of its radius in the step {:g}, allowed are {:g}",
                                         id, furthest, dt, moveAllowed);
    if (stops) error->all(FLERR, text);
    if (warns && comm->me == 0) error->warning(FLERR, text);
  }
  if (wantedError > 0.0 && times.proposal != said) {
    said = times.proposal;
    if (comm->me == 0)
      utils::logmesg(lmp, fmt::format("Fix check/timestep/gran {}: for an error of {:g} of the speed after an impact at speed {:.4g}: "
                                      "timestep {:.4g} at most, now {:g}\n", id, wantedError, usedSpeed, said, dt));
  }
}

void FixCheckTimestepGran::complain(const std::string &what, double fraction, double allowed)
{
  if (fraction <= allowed) return;
  const std::string text = fmt::format("Fix check/timestep/gran {}: the timestep {:g} is {:.4g} {}, allowed are {:g}", id, update->dt,
                                       fraction, what, allowed);
  if (stops) error->all(FLERR, text);
  if (warns && comm->me == 0) error->warning(FLERR, text);
}

double FixCheckTimestepGran::compute_vector(int n)
{
  const auto of = [&](double time) { return time > 0.0 ? update->dt / time : 0.0; };
  switch (n) {
    case 0: return of(times.rayleigh);
    case 1: return of(times.hertz);
    case 2: return of(times.contact);
    case 3: return furthest;
    default: return times.proposal;
  }
}
