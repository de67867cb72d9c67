// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Constant directional torque against the relative spin w = w_i - w_j:
///
///   M = -mu R* |F_ne| (w - (w.n) n)/|w|,   F_ne the normal force without damping and cohesion.
///
/// No memory: grains at rest jitter about it. Type A of Ai, Chen, Rotter and Ooi, Powder Technol. 206 (2011) 269; Zhou,
/// Wright, Yang, Xu and Yu, Physica A 269 (1999) 536; the size by the whole relative spin as in LIGGGHTS.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct CdtRolling {
  static constexpr const char *name = "cdt";
  static constexpr int history = 0;
  static constexpr bool takesInertia = false;
  static std::vector<ParameterInfo> parameters() { return {frictionParameter()}; }
  static std::vector<signed char> mirror() { return {}; }
  static void derive(const double *p, const ModelContext &, double *c) { c[coulomb] = p[0]; }

  template <class Real>
  GPUDEM_HD static Vec3<Real> moment(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                     const ContactFrame<Real> &f, const NormalForce<Real> &n,
                                     const TangentialStiffness<Real> &, Real, Real *, Real, bool)
  {
    const Vec3<Real> &spin = c.spinDifference;
    const Real square = dot(spin, spin);
    const Real size = k.rolling[coulomb] * c.effectiveRadius * absolute(n.elastic);
    const Real factor = square > Real(0) ? -size * inverseSquareRoot(square) : Real(0);
    return (spin - f.normal * dot(spin, f.normal)) * factor;
  }

 private:
  enum { coulomb };
};

}  // namespace gpudem
