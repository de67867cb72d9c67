// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Adhesion of compliant spheres, gamma being half of the work of adhesion:
///
///   delta = a^2/R* - 2 sqrt(pi gamma a/E*),   F = 4/3 E* a^3/R* - 2 pi a^2 sqrt(4 gamma E*/(pi a)).
///
/// Once in touch, spheres hold together up to a gap of (9 pi gamma/(4 E*))^(2/3) R*^(1/3)/3; the pull-off force is
/// 3 pi gamma R*.  Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301; the root for a from Parteli et al.,
/// Sci. Rep. 4 (2014) 6227.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct JkrNormal {
  static constexpr const char *name = "jkr";
  static constexpr bool linear = false, adhesive = true, beyondTouch = true;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters()
  {
    return {youngParameter(), dampingParameter(), poissonParameter(), notNegative("gamma", "energy/distance^2")};
  }
  static ContactModuli moduli(const double *p) { return selfContact(p[0], p[2]); }
  static void derive(const double *p, double *c)
  {
    const double young = moduli(p).young;
    c[stiffness] = 4.0 / 3.0 * young;
    c[scale] = std::cbrt(p[3] / young);
    c[neck] = 2.0 * pi * std::sqrt(4.0 * p[3] * young / pi);
    c[pull] = 3.0 * pi * p[3];
    c[reach] = std::pow(9.0 * pi * p[3] / (4.0 * young), 2.0 / 3.0) / 3.0;
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    NormalForce<Real> f{};
    const Real length = k.normal[scale] * cubeRoot(c.effectiveRadius * c.effectiveRadius);
    const Real product = c.overlap * c.effectiveRadius;
    f.contactRadius = length > Real(0) ? length * contactRadius(divide(product, length * length))
                                       : squareRoot(product > Real(0) ? product : Real(0));
    const Real a2 = f.contactRadius * f.contactRadius;
    f.stiffness = k.normal[stiffness] * f.contactRadius;
    f.elastic =
        divide(f.stiffness * a2, c.effectiveRadius) - k.normal[neck] * f.contactRadius * squareRoot(f.contactRadius);
    f.pullOff = k.normal[pull] * c.effectiveRadius;
    f.adhesive = true;
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real effectiveRadius)
  {
    return k.normal[reach] * cubeRoot(effectiveRadius);
  }

 private:
  enum { stiffness, scale, neck, pull, reach };
  static constexpr double pi = 3.14159265358979323846;

  /// Larger root x of x^2 - 2 sqrt(pi x) = d: contact radius and overlap in units of (gamma R*^2/E*)^(1/3).
  template <class Real>
  GPUDEM_HD static Real contactRadius(Real d)
  {
    const Real t1 = Real(27.0 * pi * pi), t2 = Real(8) * d * d * d;
    const Real root1 = t1 + Real(2) * t2;
    const Real t4 = cubeRoot(t1 + t2 + Real(5.19615242270663188 * pi) * squareRoot(root1 > Real(0) ? root1 : Real(0)));
    const Real t5 = divide(Real(4) * d * d, t4) + t4;
    const Real root2 = Real(2) * d + t5;
    const Real t6 = squareRoot(root2 > Real(0) ? root2 : Real(0));
    const Real root3 = Real(4) * d - t5 + divide(Real(14.6969384566990686 * pi), t6);
    return Real(0.408248290463863016) * (t6 + squareRoot(root3 > Real(0) ? root3 : Real(0)));
  }
};

}  // namespace gpudem
