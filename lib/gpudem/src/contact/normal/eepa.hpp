// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Edinburgh elasto-plastic adhesion. With x = delta^n and x_max its largest value of the contact,
///
///   F_ne = -f0 + max(min(k1 x, k2 (x - x_p)), -kadh x),   x_p = (1 - k1/k2) x_max,
///
/// that is loading k1 x from the constant pull-off force -f0 on, unloading and reloading k2 (x - x_p), and the adhesive
/// branch -kadh x, on which x_max shrinks so that reloading leaves it with slope k2. The strongest attraction of a
/// contact, f0 + kadh (k2 - k1)/(k2 + kadh) x_max, grows with the deformation.
///
/// n = 3/2 (eepa) or 1 (eepa/linear). The Coulomb limit counts from F_ne + f0 + kadh x, zero at the strongest
/// attraction. Thakur, Morrissey, Sun, Chen and Ooi, Granul. Matter 16 (2014) 383; Morrissey, PhD thesis, Univ. of
/// Edinburgh (2013).
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"
#include "gpudem/errors.h"

namespace gpudem {

enum class EepaExponent { One, ThreeHalves };

template <EepaExponent exponent>
struct EepaForm {
  static constexpr bool linear = exponent == EepaExponent::One, adhesive = true, beyondTouch = false;
  static constexpr int history = 1;  ///< x_max, the same from either side
  static std::vector<ParameterInfo> parameters()
  {
    const char *unit = linear ? "force/distance" : "force/distance^1.5";
    return {positive("k1", unit), dampingParameter(), positive("k2", unit), notNegative("kadh", unit),
            notNegative("f0", "force")};
  }
  static ContactModuli moduli(const double *) { return {}; }
  static void derive(const double *p, double *c)
  {
    if (p[2] < p[0]) throw Error("normal eepa: the stiffness k2 of unloading must not be below k1 of loading");
    c[loading] = p[0];
    c[unloading] = p[2];
    c[adhesion] = p[3];
    c[pull] = p[4];
    c[retreat] = p[2] > p[0] ? (p[2] + p[3]) / (p[2] - p[0]) : 1.0;
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    const Real root = linear ? Real(1) : squareRoot(c.overlap), x = c.overlap * root;
    const Real largest = history[0] > x ? history[0] : x;
    const Real spring = k.normal[loading] * largest + k.normal[unloading] * (x - largest);
    const Real adhesive = k.normal[adhesion] * x;
    const bool pulls = spring < -adhesive;
    history[0] = pulls ? k.normal[retreat] * x : largest;

    NormalForce<Real> f{};
    f.elastic = (pulls ? -adhesive : spring) - k.normal[pull];
    f.contactRadius = squareRoot(c.overlap * c.effectiveRadius);
    f.stiffness = k.normal[loading] * root;  // of the dashpot: that of loading, always positive
    f.pullOff = Real(0.5) * (k.normal[pull] + adhesive);
    f.adhesive = k.normal[pull] > Real(0) || k.normal[adhesion] > Real(0);
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { loading, unloading, adhesion, pull, retreat };
};

struct EepaNormal : EepaForm<EepaExponent::ThreeHalves> {
  static constexpr const char *name = "eepa";
};
struct EepaLinearNormal : EepaForm<EepaExponent::One> {
  static constexpr const char *name = "eepa/linear";
};

}  // namespace gpudem
