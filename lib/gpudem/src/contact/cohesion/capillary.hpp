// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Pendular liquid bridge of volume V, surface tension gamma and contact angle theta, at separation s:
///
///   F = -4 pi gamma R* cos(theta)/(1 + 1.05 S + 2.5 S^2),   S = s sqrt(2 R*/V),   s = 0 in touch.
///
/// The closed form of Willett, Adams, Johnson and Seville, Langmuir 16 (2000) 9396, for equal spheres of radius R = 2
/// R*, which by the approximation of Derjaguin serves unequal spheres and walls (R* = R) too; for V << R^3 and small
/// angles. The bridge forms at touch and breaks at s = (1 + theta/2) V^(1/3), theta in radian: Lian, Thornton and
/// Adams, J. Colloid Interface Sci. 161 (1993) 138. That a contact is there beyond touch is the memory of the bridge;
/// every contact has the same liquid, and none is lost or passed on.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct CapillaryCohesion {
  static constexpr const char *name = "capillary";
  static constexpr bool beyondTouch = true, beforeTouch = false;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters()
  {
    return {notNegative("gamma", "force/distance"), {"theta", "degree", 0.0, 90.0, false}, positive("V", "distance^3")};
  }
  static void derive(const double *p, double *c)
  {
    constexpr double pi = 3.14159265358979323846;
    const double angle = p[1] * pi / 180.0;
    c[pull] = 4.0 * pi * p[0] * std::cos(angle);
    c[wetness] = 2.0 / p[2];
    c[reach] = (1.0 + 0.5 * angle) * std::cbrt(p[2]);
  }

  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    const Real separation = c.overlap < Real(0) ? -c.overlap : Real(0);
    const Real s = separation * squareRoot(k.cohesion[wetness] * c.effectiveRadius);
    return -divide(k.cohesion[pull] * c.effectiveRadius, Real(1) + s * (Real(1.05) + Real(2.5) * s));
  }
  /// Separation at which the bridge breaks (distance).
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real)
  {
    return k.cohesion[reach];
  }

 private:
  enum { pull, wetness, reach };
};

}  // namespace gpudem
