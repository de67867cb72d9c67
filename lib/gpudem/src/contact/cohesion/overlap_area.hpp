// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Attraction F = -k A by an energy density k. Named after JKR but without its necks: it acts in touch only.
///
///   sjkr    A: the lens where two spheres cut each other, pi (d^2 - (R_i - R_j)^2)((R_i + R_j)^2 - d^2)/(4 d^2) at
///           distance d; at a wall the circle pi (R^2 - d^2)
///   sjkr2   A = 2 pi delta 2 R*
///
/// Conventions of LIGGGHTS' cohesion models of these names.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

/// What holds for attraction that ends with touch.
struct WithinTouch {
  static constexpr bool beyondTouch = false, beforeTouch = false;
  static constexpr int history = 0;
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }
};

struct NoCohesion : WithinTouch {
  static constexpr const char *name = "none";
  static std::vector<ParameterInfo> parameters() { return {}; }
  static void derive(const double *, double *) {}
  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &, const Contact<Real> &, Real *)
  {
    return Real(0);
  }
};

struct SjkrCohesion : WithinTouch {
  static constexpr const char *name = "sjkr";
  static std::vector<ParameterInfo> parameters() { return {notNegative("k", "energy/distance^3")}; }
  static void derive(const double *p, double *c) { c[0] = 3.14159265358979323846 * p[0]; }
  /// \return force of the sub-model, repulsion positive
  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    const Real reach = c.distance + c.overlap, room2 = c.overlap * (reach + c.distance);  // reach^2 - d^2
    // d^2 - (R_i - R_j)^2 = 4 R_i R_j - room2, and R_i R_j = R* reach
    const Real lens = divide(room2 * (c.effectiveRadius * reach - Real(0.25) * room2), c.distance * c.distance);
    return -k.cohesion[0] * (c.atWall ? room2 : lens);
  }
};

struct Sjkr2Cohesion : WithinTouch {
  static constexpr const char *name = "sjkr2";
  static std::vector<ParameterInfo> parameters() { return {notNegative("k", "energy/distance^3")}; }
  static void derive(const double *p, double *c) { c[0] = 4.0 * 3.14159265358979323846 * p[0]; }
  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    return -k.cohesion[0] * (c.overlap * c.effectiveRadius);
  }
};

}  // namespace gpudem
