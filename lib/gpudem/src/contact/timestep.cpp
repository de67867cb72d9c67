// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/timestep.h"

#include "contact/derive.hpp"
#include "contact/layout.hpp"
#include "contact/product.hpp"
#include "gpudem/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gpudem {

namespace {
constexpr double pi = 3.14159265358979323846;
constexpr int mostSteps = 1000000;

/// Coefficients and history of one contact.
class HeadOnContact {
 public:
  explicit HeadOnContact(const HeadOnImpact &impact)
      : impact_(impact), layout_(historyLayout({impact.model})), k_(deriveCoefficients(impact.model)),
        history_(static_cast<std::size_t>(layout_.size), 0.0)
  {
    const double m = impact.mass, n = impact.partnerMass, r = impact.radius, s = impact.partnerRadius;
    mass_ = n > 0.0 ? m * n / (m + n) : m;
    radius_ = s > 0.0 ? r * s / (r + s) : r;
  }
  double mass() const { return mass_; }
  double effectiveRadius() const { return radius_; }

  /// Repulsion at an overlap and a speed of approach.
  double push(double overlap, double approach, double dt)
  {
    Contact<double> c{};
    c.distance = impact_.radius + impact_.partnerRadius - overlap;
    c.branch = {c.distance, 0.0, 0.0};
    c.inverseDistance = 1.0 / c.distance;
    c.overlap = overlap;
    c.effectiveRadius = radius_;
    c.effectiveMass = mass_;
    c.relativeVelocity = {-approach, 0.0, 0.0};
    c.radiusDifference = impact_.partnerRadius - impact_.radius;
    const double own = impact_.mass * impact_.radius * impact_.radius;
    const double other = impact_.partnerMass * impact_.partnerRadius * impact_.partnerRadius;
    c.inertia = other > 0.0 ? own * other / (own + other) : own;
    c.atWall = impact_.partnerRadius == 0.0;
    const LayoutView view = layoutView(layout_);
    ModelHistory<double> h{};
    moveHistory<AnyProduct>(view, h, [&](double &inRegister, int at) { inRegister = history_[at]; });
    const ContactParts<double> p = AnyProduct::parts(k_, c, h, dt, true);
    moveHistory<AnyProduct>(view, h, [&](double &inRegister, int at) { history_[at] = inRegister; });
    return p.normal.push;
  }

 private:
  const HeadOnImpact &impact_;
  HistoryLayout layout_;
  ModelCoefficients<double> k_;
  std::vector<double> history_;
  double mass_, radius_;
};
}  // namespace

double rayleighTime(double radius, double density, double young, double poisson, double acceleration)
{
  const double shear = young / (2.0 * (1.0 + poisson));
  return pi * radius * std::sqrt(density / (shear * acceleration)) / (0.1631 * poisson + 0.8766);
}

double hertzTime(double effectiveMass, double effectiveRadius, double effectiveYoung, double speed, double acceleration)
{
  const double stiffness = effectiveYoung * acceleration;
  return 2.87 * std::pow(effectiveMass * effectiveMass / (effectiveRadius * stiffness * stiffness * speed), 0.2);
}

ContactModel headOnModel(const ContactLaw &law)
{
  ContactModel m;
  const bool hertz = law.normal == NormalModel::Hertz;
  m.normal = {hertz ? "hertz" : "hooke", {law.normalStiffness, law.normalDamping}};
  m.damping = {hertz ? "viscoelastic" : "mass_velocity", {}};
  m.tangential = {"linear_nohistory", {0.0, 0.0}};
  m.limitDamping = law.limitDamping;
  return m;
}

ImpactResult integrateImpact(const HeadOnImpact &impact, double dt, double phase)
{
  HeadOnContact contact(impact);
  const double neck = reachesBeyondTouch(impact.model) ? pullOffGap(impact.model, contact.effectiveRadius()) : 0.0;
  const double kick = 0.5 * dt * impact.acceleration / contact.mass();
  ImpactResult r;
  double overlap = (phase - 1.0) * impact.speed * dt, approach = impact.speed, push = 0.0, turned = 0.0;
  bool touched = false;
  for (int step = 1; step <= mostSteps; ++step) {
    approach -= kick * push;
    overlap += dt * approach;
    touched = touched || overlap > 0.0;
    const bool acts = touched && overlap > -neck;
    if (touched && !acts) {
      r.rebound = -approach / impact.speed;
      r.duration = r.steps * dt;
      return r;
    }
    push = acts ? contact.push(overlap, approach, dt) : 0.0;
    approach -= kick * push;
    r.steps += acts ? 1 : 0;
    if (overlap > r.largestOverlap) {
      r.largestOverlap = overlap;
      turned = r.steps * dt;
    }
    // at rest in each other's arms: 100 times as long as it took to the largest overlap
    if (acts && r.steps * dt > 100.0 * turned && std::abs(approach) < 0.05 * impact.speed) {
      r.duration = 2.0 * turned;
      return r;
    }
  }
  throw Error(fmt::format("an impact at speed {:g} does not end within {} steps of {:g}", impact.speed, mostSteps, dt));
}

ImpactResult resolveImpact(const HeadOnImpact &impact)
{
  if (!(impact.mass > 0.0) || !(impact.radius > 0.0) || !(impact.speed > 0.0))
    throw Error(fmt::format("an impact needs mass, radius and speed above 0, not {:g}, {:g}, {:g}", impact.mass,
                            impact.radius, impact.speed));
  double dt = 0.01 * impact.radius / impact.speed;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const ImpactResult r = integrateImpact(impact, dt, 0.5);
    const double wanted = r.duration / 4000.0;
    if (r.steps > 1000 && dt < 1.5 * wanted) return r;
    dt = std::clamp(wanted, 1e-3 * dt, 10.0 * dt);
  }
  throw Error(fmt::format("the duration of an impact at speed {:g} cannot be found", impact.speed));
}

double timestepForError(const HeadOnImpact &impact, double error)
{
  const ImpactResult exact = resolveImpact(impact);
  constexpr int phases = 8;
  double good = 0.0;
  for (double steps = 2000.0; steps >= 3.0; steps /= 1.08) {
    const double dt = exact.duration / steps;
    double sum = 0.0;
    for (int p = 0; p < phases; ++p) {
      const double off = integrateImpact(impact, dt, (p + 0.5) / phases).rebound - exact.rebound;
      sum += off * off;
    }
    if (!(sum < phases * error * error)) break;
    good = dt;
  }
  return good;
}

}  // namespace gpudem
