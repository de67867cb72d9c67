// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Adhesion of compliant spheres, gamma being half of the work of adhesion:
///
///   delta = a^2/R* - 2 sqrt(pi gamma a/E*),   F = 4/3 E* a^3/R* - 2 pi a^2 sqrt(4 gamma E*/(pi a)).
///
/// Once in touch, spheres hold together up to a gap of (9 pi gamma/(4 E*))^(2/3) R*^(1/3)/3; the pull-off force is
/// 3 pi gamma R*. That gap is where the neck parts under a load, as in LAMMPS; pulled at a given distance it could be
/// stretched a little further.  Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301; a in closed form as in
/// Parteli et al., Sci. Rep. 4 (2014) 6227, rearranged.
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
  ///
  /// For y = sqrt(x) this is a quartic without square and cube, so y = (r + sqrt(4 sqrt(pi)/r - r^2))/2, where u = r^2
  /// solves u^3 + 4 d u = 4 pi. Cardano's difference of roots p - q is taken as (p^3 - q^3)/(p^2 + p q + q^2): nothing
  /// cancels for stiff or hardly adhesive grains (large d), where the form of Parteli et al. loses half of the digits.
  template <class Real>
  GPUDEM_HD static Real contactRadius(Real d)
  {
    const Real size = absolute(d);
    const Real power = Real(1.53960071783900203) * size * squareRoot(size);  // sqrt(64/27) |d|^(3/2)
    const Real square = Real(4 * pi * pi) + (d < Real(0) ? -power * power : power * power);
    const Real root = power > Real(1e12) ? power : squareRoot(square > Real(0) ? square : Real(0));
    const Real p = cubeRoot(Real(2 * pi) + root), q = divide(Real(4.0 / 3.0) * d, p);
    const Real r = squareRoot(divide(Real(4 * pi), p * p + p * q + q * q));
    const Real rest = divide(Real(7.08981540362206109), r) - r * r;  // 4 sqrt(pi)/r - r^2, zero where contact ends
    const Real y = Real(0.5) * (r + squareRoot(rest > Real(0) ? rest : Real(0)));
    return y * y;
  }
};

}  // namespace gpudem
