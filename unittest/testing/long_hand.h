// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contact laws once more, written from the papers and the manual of LAMMPS' pair_style granular, for speed
/// and symmetry careless: plain double arrays, names compared as text, the root of JKR by bisection.
#pragma once

#include "gpudem/contact_model.h"
#include "testing/long_hand_further.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gpudem::testing {

using Triple = std::array<double, 3>;
inline double inner(const Triple &a, const Triple &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Triple &a)
{
  return std::sqrt(inner(a, a));
}
inline Triple outer(const Triple &a, const Triple &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Triple along(const Triple &a, double f)
{
  return {a[0] * f, a[1] * f, a[2] * f};
}
inline Triple sum(const Triple &a, const Triple &b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// What the contact keeps, by its meaning.
struct LongHandHistory {
  Triple slip{}, roll{};                             ///< slip: displacement, or force for mindlin/force
  double largestRadius = 0, twist = 0, largest = 0;  ///< largest: overlap, or its power
};

struct LongHandResult {
  Triple force, torque, friction, rolling;
  double push, twisting, contactRadius, limit;
};

constexpr double circle = 3.14159265358979323846;

/// Larger a with a^2/R - 2 sqrt(pi gamma a/E) = delta.
inline double jkrContactRadius(double delta, double radius, double gamma, double young)
{
  const auto overlap = [&](double a) { return a * a / radius - 2.0 * std::sqrt(circle * gamma * a / young); };
  double low = std::cbrt(0.25 * circle * gamma * radius * radius / young);  // where the overlap is least
  double high = 2.0 * low + std::sqrt(std::max(0.0, delta) * radius) + radius;
  while (overlap(high) < delta) high *= 2.0;
  for (int k = 0; k < 200; ++k) (overlap(0.5 * (low + high)) < delta ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

/// alpha of F = -alpha sqrt(m k) v_n.
inline double longHandDamping(const std::string &name, double given, double mass, double a, double stiffness,
                              bool linear)
{
  if (name == "velocity") return given;
  if (name == "mass_velocity") return given * mass;
  if (name == "viscoelastic") return given * mass * a;
  if (name == "tsuji/lammps") {
    const double c[7] = {1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218};
    double alpha = 0.0;
    for (int n = 0; n < 7; ++n) alpha += c[n] * std::pow(given, n);
    return alpha * std::sqrt(mass * stiffness);
  }
  const double l = std::log(given), beta = -l / std::sqrt(l * l + circle * circle);
  // Hooke: critical damping 2 sqrt(m k) times beta; Hertz: 2 sqrt(5/6) beta sqrt(m S), S = 3/2 F/delta
  return linear ? 2.0 * beta * std::sqrt(mass * stiffness)
                : 2.0 * std::sqrt(5.0 / 6.0) * beta * std::sqrt(mass * 1.5 * stiffness);
}

/// Spring and dashpot in the plane with a slider; \p force: the spring is kept as the force it carries.
inline Triple longHandSlider(Triple &kept, const Triple &n, const Triple &rate, double k, double eta, double limit,
                             double dt, bool force)
{
  if (dt > 0.0) {
    const double out = inner(kept, n);
    if (std::abs(out) * (force ? 1.0 : k) > 1e-10 * limit) {
      const double length = norm(kept);
      kept = sum(kept, along(n, -out));
      if (norm(kept) > 0.0) kept = along(kept, length / norm(kept));
    }
    kept = sum(kept, along(rate, force ? -k * dt : dt));
  }
  const Triple elastic = force ? kept : along(kept, -k), drag = along(rate, -eta);
  Triple total = sum(elastic, drag);
  if (norm(total) <= limit) return total;
  if (norm(kept) == 0.0) return {0, 0, 0};
  total = along(total, limit / norm(total));
  const Triple carried = sum(total, along(drag, -1.0));
  kept = force ? carried : along(carried, -1.0 / k);
  return total;
}

/// LIGGGHTS' tangential history: the spring alone is clipped, and is the whole friction then. Without a time step the spring
/// stays unless it slides.
inline Triple longHandLiggghts(Triple &kept, const Triple &n, const Triple &rate, double k, double eta, double limit,
                               double dt)
{
  const Triple moved = sum(kept, along(rate, dt)), grown = sum(moved, along(n, -inner(moved, n)));
  if (k * norm(grown) <= limit) {
    if (dt > 0.0) kept = grown;
    return sum(along(kept, -k), along(rate, -eta));
  }
  kept = along(grown, limit / (k * norm(grown)));
  return along(kept, -k);
}

/// LIGGGHTS' rolling epsd, epsd2, epsd3. \param kept torque of the spring
inline Triple longHandEpsd(const ContactModel &m, const ContactState &s, Triple &kept, const Triple &roll, double kn,
                           double kt, double base, double dt)
{
  const std::vector<double> &p = m.rolling.parameter;
  const double radius = s.effectiveRadius, factor = m.rolling.name == "epsd3" ? p[2] : 2.25;
  const double kr = m.rolling.name == "epsd2" ? kt * radius * radius : factor * kn * std::pow(p[0] * radius, 2.0);
  kept = sum(kept, along(roll, -kr * dt));
  const double limit = p[0] * radius * base;
  if (norm(kept) > limit) return kept = along(kept, limit / norm(kept));
  if (m.rolling.name == "epsd2") return kept;
  return sum(kept, along(roll, -p[1] * 2.0 * std::sqrt(1.4 * s.inertia * kr)));
}

inline LongHandResult longHand(const ContactModel &m, const ContactState &s, LongHandHistory &h, double dt)
{
  LongHandResult r{};
  const auto triple = [](const double *v) { return Triple{v[0], v[1], v[2]}; };
  const Triple branch = triple(s.branch), n = along(branch, 1.0 / norm(branch)), v = triple(s.relativeVelocity);
  const double vn = inner(v, n), delta = s.overlap, radius = s.effectiveRadius;
  // the spins of both grains, and the surfaces' velocity with the arms of the slip velocity
  const double reach = s.radius + s.partnerRadius;
  const Triple spin = triple(s.spinDifference), both = triple(s.surfaceSpin);
  const Triple wi = along(sum(both, along(spin, s.partnerRadius)), 1.0 / reach);
  const Triple wj = along(sum(both, along(spin, -s.radius)), 1.0 / reach);
  const Triple surface =
      sum(along(wi, s.radius - m.slipLever * delta), along(wj, s.partnerRadius - m.slipLever * delta));
  const Triple slip = sum(sum(v, along(n, -vn)), along(outer(surface, n), -1.0));
  const std::string &normal = m.normal.name;
  const std::vector<double> &p = m.normal.parameter;

  const double cohesion = longHandCohesion(m.cohesion, s);
  if (delta < 0.0 && normal != "jkr") {  // a bridge, and nothing that needs touch
    h = {};
    r.push = cohesion;
    r.force = along(n, cohesion);
    return r;
  }

  // normal force
  double young = 0.0, shear = 0.0, elastic, stiffness, pullOff = 0.0, a = std::sqrt(std::max(0.0, delta * radius));
  if (p.size() > 2) {  // two grains of one material: 1/E* = 2 (1 - nu^2)/E, 1/G* = 2 (2 - nu)/G, G = E/(2 (1 + nu))
    young = 1.0 / (2.0 * (1.0 - p[2] * p[2]) / p[0]);
    shear = 1.0 / (2.0 * (2.0 - p[2]) / (p[0] / (2.0 * (1.0 + p[2]))));
  }
  LongHandNormal further{};
  const bool isFurther = normal == "luding" || normal == "thornton_ning" || normal.find("eepa") == 0;
  if (isFurther) {
    if (normal == "luding") further = longHandLuding(p, delta, radius, h.largest);
    else if (normal == "thornton_ning") further = longHandThorntonNing(young, p[3], delta, radius, h.largest);
    else further = longHandEepa(p, normal == "eepa" ? 1.5 : 1.0, delta, radius, h.largest);
    elastic = further.elastic;
    stiffness = further.stiffness;
    a = further.contactRadius;
  } else if (normal == "hooke") {
    stiffness = p[0];
    elastic = p[0] * delta;
  } else if (normal == "jkr") {
    a = jkrContactRadius(delta, radius, p[3], young);
    stiffness = 4.0 / 3.0 * young * a;
    elastic =
        4.0 * young * a * a * a / (3.0 * radius) - 2.0 * circle * a * a * std::sqrt(4.0 * p[3] * young / (circle * a));
    pullOff = 3.0 * circle * p[3] * radius;
  } else {
    const double kn = normal == "hertz" ? p[0] : 4.0 / 3.0 * young;
    stiffness = kn * a;
    elastic = kn * std::sqrt(radius) * std::pow(delta, 1.5);
    if (normal == "dmt") pullOff = 4.0 * circle * p[3] * radius;
    elastic -= pullOff;
  }
  const double eta = longHandDamping(m.damping.name, p[1], s.effectiveMass, a, stiffness,
                                     normal == "hooke" || normal == "luding" || normal == "eepa/linear");
  r.push = elastic - eta * vn;
  if (m.limitDamping) r.push = std::max(0.0, r.push);
  const bool adhesive = normal == "jkr" || normal == "dmt";
  double base = adhesive ? std::abs(elastic + 2.0 * pullOff) : std::abs(r.push);
  if (further.adhesive) base = std::abs(elastic + further.loss);
  r.push += cohesion;
  if (m.coulombBase == CoulombBase::Net) base = std::abs(r.push);
  r.contactRadius = a;

  // friction
  const std::string &tangential = m.tangential.name;
  const std::vector<double> &t = m.tangential.parameter;
  double kt = 0.0, etat = 0.0, mu = 0.0;
  r.friction = {0, 0, 0};
  if (tangential == "linear_nohistory") {
    mu = t[1];
    etat = t[0] * eta;
    if (norm(slip) > 0.0) r.friction = along(slip, -std::min(mu * base, etat * norm(slip)) / norm(slip));
  } else if (tangential != "none") {
    mu = t[2];
    etat = t[1] * eta;
    kt = std::isnan(t[0]) ? 8.0 * shear : t[0];
    if (std::isnan(t[1])) etat = eta * std::sqrt(8.0 * shear / (2.0 * young));  // sqrt(S_t/S_n)
    if (tangential.find("linear_history") == std::string::npos) kt *= a;
    if (tangential.find("rescale") != std::string::npos) {
      if (a < h.largestRadius) h.slip = along(h.slip, a / h.largestRadius);
      if (dt > 0.0) h.largestRadius = a;
    }
    if (tangential.find("liggghts") == 0) r.friction = longHandLiggghts(h.slip, n, slip, kt, etat, mu * base, dt);
    else
      r.friction =
          longHandSlider(h.slip, n, slip, kt, etat, mu * base, dt, tangential.find("/force") != std::string::npos);
  }
  r.limit = mu * base;

  // rolling: velocity R* (w_i - w_j) x n, torque R* n x F
  const Triple roll = sum(spin, along(n, -inner(spin, n)));
  if (m.rolling.name == "cdt" && norm(spin) > 0.0)
    r.rolling = along(roll, -m.rolling.parameter[0] * radius * std::abs(elastic) / norm(spin));
  if (m.rolling.name.find("epsd") == 0) r.rolling = longHandEpsd(m, s, h.roll, roll, stiffness, kt, base, dt);
  if (m.rolling.name == "sds") {
    const std::vector<double> &q = m.rolling.parameter;
    const Triple rate = along(outer(spin, n), radius);
    r.rolling = along(outer(n, longHandSlider(h.roll, n, rate, q[0], q[1], q[2] * base, dt, false)), radius);
  }

  // twisting
  if (m.twisting.name != "none") {
    const std::vector<double> q = m.twisting.name == "sds"
                                      ? m.twisting.parameter
                                      : std::vector<double>{0.5 * kt * a * a, 0.5 * etat * a * a, 2.0 / 3.0 * a * mu};
    const double rate = inner(spin, n), sign = rate > 0.0 ? 1.0 : rate < 0.0 ? -1.0 : 0.0;
    h.twist += rate * dt;
    r.twisting = -q[0] * h.twist - q[1] * rate;
    if (std::abs(r.twisting) > q[2] * base) {
      r.twisting = -sign * q[2] * base;
      h.twist = q[0] > 0.0 ? -(r.twisting + q[1] * rate) / q[0] : 0.0;
    }
  }

  r.force = sum(along(n, r.push), r.friction);
  r.torque = sum(sum(along(outer(n, r.friction), -(s.radius - m.lever * delta)), r.rolling), along(n, r.twisting));
  return r;
}

}  // namespace gpudem::testing
