// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The worked example of CONTRIBUTING.md: a sub-model that is not in the lists.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

// example-begin
/// Stiffening spring: F = kn R* (delta/R*)^n.
struct PowerNormal {
  static constexpr const char *name = "power";                                  // the word in a script
  static constexpr bool linear = false, adhesive = false, beyondTouch = false;  // what others must know of it
  static constexpr int history = 0;                                             // numbers kept per contact
  static std::vector<ParameterInfo> parameters()
  {
    return {notNegative("kn", "force/distance"), dampingParameter(), {"n", "-", 1.0, 3.0, false}};
  }
  static ContactModuli moduli(const double *) { return {}; }  // it names no material
  static void derive(const double *p, double *c)
  {
    c[stiffness] = p[0];
    c[exponent] = p[2];
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    NormalForce<Real> f{};
    const Real strain = divide(c.overlap, c.effectiveRadius);
    f.contactRadius = squareRoot(c.overlap * c.effectiveRadius);
    f.elastic = k.normal[stiffness] * c.effectiveRadius * pow(strain, k.normal[exponent]);
    f.stiffness = divide(f.elastic, c.overlap);
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { stiffness, exponent };
};
// example-end

}  // namespace gpudem
