// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file One contact that is pressed and released by hand.
#pragma once

#include "contact/derive.hpp"
#include "testing/tolerance.h"

#include <cmath>

namespace gpudem::testing {

/// A contact of two grains of radius 1/2 (R* = 1/4, m* = 1/2) along x that remembers.
class Contacting {
 public:
  explicit Contacting(ContactModel model) : model_(std::move(model)), layout_(historyLayout({model_}))
  {
    kept.resize(static_cast<std::size_t>(layout_.size));
  }
  std::vector<double> kept;  ///< what the contact keeps

  ContactState state(double overlap) const
  {
    ContactState s{};
    s.overlap = overlap;
    s.radius = s.partnerRadius = 0.5;
    s.branch[0] = 1.0 - overlap;
    s.effectiveRadius = 0.25;
    s.effectiveMass = 0.5;
    s.inertia = 0.125;
    return s;
  }
  ContactResult evaluate(const ContactState &s, double dt = 1e-3)
  {
    return evaluateContact(model_, layout_, s, kept.data(), dt);
  }
  double push(double overlap, double speed = 0.0)
  {
    ContactState s = state(overlap);
    s.relativeVelocity[0] = speed;
    return evaluate(s).push;
  }
  /// Work done by the grain while the overlap goes from one value to another.
  double work(double from, double to, int steps = 20000)
  {
    double sum = 0.0, before = push(from);
    for (int k = 1; k <= steps; ++k) {
      const double now = push(from + (to - from) * k / steps);
      sum += 0.5 * (before + now) * (to - from) / steps;
      before = now;
    }
    return sum;
  }
  /// Rebound over impact speed of a head-on collision, by velocity Verlet.
  double restitution(double speed, double dt)
  {
    double overlap = 0.0, rate = speed, force = 0.0;
    do {
      rate -= 0.5 * dt * force / 0.5;
      overlap += dt * rate;
      force = overlap > 0.0 ? push(overlap) : 0.0;
      rate -= 0.5 * dt * force / 0.5;
    } while (overlap > 0.0);
    return -rate / speed;
  }

 private:
  ContactModel model_;
  HistoryLayout layout_;
};

inline ContactModel undamped(const std::string &name, std::vector<double> parameter)
{
  ContactModel m;
  m.damping.name = "velocity";
  m.normal = {name, std::move(parameter)};
  m.tangential = {"none", {}};
  return m;
}
inline ContactModel luding(double kc, double phi)
{
  return undamped("luding", {1e4, 0.0, 4e4, kc, phi});
}

inline Tolerance exact(double magnitude)
{
  return roundOff(Precision::Double, std::abs(magnitude), 64);
}
/// Trapezia of 20000 steps, and collisions of some 10^4 steps of second order.
inline Tolerance integrated(double magnitude)
{
  return {1e-6, magnitude};
}

}  // namespace gpudem::testing
