// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Linear spring: F = kn delta.  Cundall and Strack, Geotechnique 29 (1979) 47.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct HookeNormal {
  static constexpr const char *name = "hooke";
  static constexpr bool linear = true, adhesive = false, beyondTouch = false;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("kn", "force/distance"), dampingParameter()}; }
  static ContactModuli moduli(const double *) { return {}; }
  static void derive(const double *p, double *c) { c[stiffness] = p[0]; }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    NormalForce<Real> f{};
    f.elastic = k.normal[stiffness] * c.overlap;
    f.contactRadius = squareRoot(c.overlap * c.effectiveRadius);
    f.stiffness = k.normal[stiffness];
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { stiffness };
};

}  // namespace gpudem
