// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Long-hand copies of the sub-models beyond LAMMPS 2021, branch by branch as the papers have them.
#pragma once

#include "gpudem/contact_model.h"

#include <algorithm>
#include <cmath>

namespace gpudem::testing {

/// What a long-hand normal sub-model gives.
struct LongHandNormal {
  double elastic, stiffness, contactRadius, loss = 0;  ///< loss: what the Coulomb limit adds to the force
  bool adhesive = false;
};

inline LongHandNormal longHandLuding(const std::vector<double> &p, double delta, double radius, double &largest)
{
  const double k1 = p[0], k2 = p[2], kc = p[3], limit = k2 / (k2 - k1) * p[4] * 2.0 * radius;
  const auto slope = [&](double x) { return p[4] > 0.0 ? k1 + (k2 - k1) * x / limit : k2; };
  const auto elastic = [&](double x) { return slope(x) * (delta - (1.0 - k1 / slope(x)) * x); };
  largest = std::max(largest, delta);
  if (p[4] > 0.0) largest = std::min(largest, limit);
  LongHandNormal f{elastic(largest), k1, std::sqrt(delta * radius), kc * delta, kc > 0.0};
  if (f.elastic >= -kc * delta) return f;
  f.elastic = -kc * delta;
  double low = delta, high = largest;
  for (int k = 0; k < 200; ++k) (elastic(0.5 * (low + high)) > -kc * delta ? low : high) = 0.5 * (low + high);
  largest = 0.5 * (low + high);
  return f;
}

inline LongHandNormal longHandEepa(const std::vector<double> &p, double n, double delta, double radius, double &largest)
{
  const double k1 = p[0], k2 = p[2], kadh = p[3], f0 = p[4], x = std::pow(delta, n);
  largest = std::max(largest, x);
  const double unloading = k2 * (x - (1.0 - k1 / k2) * largest);
  double f = k1 * x;
  if (k1 * x > unloading) f = unloading;
  if (f < -kadh * x) {
    f = -kadh * x;
    largest = (x + kadh * x / k2) / (1.0 - k1 / k2);  // k2 (x - x_p) = -kadh x
  }
  return {f - f0, k1 * std::pow(delta, n - 1.0), std::sqrt(delta * radius), f0 + kadh * x, f0 > 0.0 || kadh > 0.0};
}

inline LongHandNormal longHandThorntonNing(double young, double yield, double delta, double radius, double &largest)
{
  const double pi = std::acos(-1.0), yieldRadius = pi * yield * radius / (2.0 * young);
  const double deltaYield = yieldRadius * yieldRadius / radius;
  const double forceYield = 4.0 / 3.0 * young * std::pow(yieldRadius, 3) / radius;
  const auto loading = [&](double x) {
    return x < deltaYield ? 4.0 / 3.0 * young * std::sqrt(radius) * std::pow(x, 1.5)
                          : forceYield + pi * yield * radius * (x - deltaYield);
  };
  if (delta >= largest) {
    largest = delta;
    const double a = std::sqrt(radius * delta);
    return {loading(delta), 4.0 / 3.0 * young * a, a};
  }
  double curvature = radius;
  const double force = loading(largest);
  if (largest > deltaYield)
    curvature = 4.0 * young / (3.0 * force) * std::pow((2.0 * force + forceYield) / (2.0 * pi * yield), 1.5);
  const double above = delta - (largest - radius * largest / curvature);
  if (above <= 0.0) return {0.0, 0.0, 0.0};
  const double a = std::sqrt(curvature * above);
  return {4.0 / 3.0 * young * std::sqrt(curvature) * std::pow(above, 1.5), 4.0 / 3.0 * young * a, a};
}

/// Force of the cohesion sub-model, repulsion positive.
inline double longHandCohesion(const SubModel &m, const ContactState &s)
{
  const double pi = std::acos(-1.0), ri = s.radius, rj = s.partnerRadius, delta = s.overlap;
  const std::vector<double> &p = m.parameter;
  if (m.name == "sjkr") {
    if (rj == 0.0) return -p[0] * pi * (ri * ri - (ri - delta) * (ri - delta));
    const double d = ri + rj - delta;
    return p[0] * pi / 4.0 * ((d - ri - rj) * (d + ri - rj) * (d - ri + rj) * (d + ri + rj)) / (d * d);
  }
  if (m.name == "sjkr2") return -p[0] * 2.0 * pi * delta * 2.0 * s.effectiveRadius;
  if (m.name == "capillary") {
    const double radius = 2.0 * s.effectiveRadius, gap = std::max(0.0, -delta) * std::sqrt(radius / p[2]);
    return -2.0 * pi * radius * p[0] * std::cos(p[1] * pi / 180.0) / (1.0 + 1.05 * gap + 2.5 * gap * gap);
  }
  if (m.name == "vdw") return -p[0] * s.effectiveRadius / (6.0 * std::pow(std::max(-delta, p[1]), 2.0));
  return 0.0;
}

}  // namespace gpudem::testing
