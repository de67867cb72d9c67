// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Elastic spheres: F = kn a delta, a = sqrt(R* delta), kn given or 4/3 E*.
/// Hertz, J. reine angew. Math. 92 (1882) 156; Johnson, Contact Mechanics (1985), chapter 4.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct HertzNormal {
  static constexpr const char *name = "hertz";
  static constexpr bool linear = false, adhesive = false, beyondTouch = false;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("kn", "force/distance^2"), dampingParameter()}; }
  static ContactModuli moduli(const double *) { return {}; }
  static void derive(const double *p, double *c) { c[stiffness] = p[0]; }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    NormalForce<Real> f{};
    f.contactRadius = squareRoot(c.overlap * c.effectiveRadius);
    f.stiffness = k.normal[stiffness] * f.contactRadius;
    f.elastic = f.stiffness * c.overlap;
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 protected:
  enum { stiffness };
};

struct HertzMaterialNormal : HertzNormal {
  static constexpr const char *name = "hertz/material";
  static std::vector<ParameterInfo> parameters() { return {youngParameter(), dampingParameter(), poissonParameter()}; }
  static ContactModuli moduli(const double *p) { return selfContact(p[0], p[2]); }
  static void derive(const double *p, double *c) { c[stiffness] = 4.0 / 3.0 * moduli(p).young; }
};

}  // namespace gpudem
