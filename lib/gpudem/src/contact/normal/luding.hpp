// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Linear spring with hysteresis and adhesion. With delta_max the largest overlap of the contact,
///
///   F_ne = max(k1 delta_max + k2* (delta - delta_max), -kc delta),
///
/// which is k1 delta on first loading, slope k2* on unloading and reloading, and the adhesive branch -kc delta below.
/// On that branch delta_max shrinks so that reloading leaves it with slope k2*. The slope grows with the deformation,
///
///   k2* = k1 + (k2 - k1) delta_max/delta_l,   delta_l = k2/(k2 - k1) phi 2 R*,
///
/// up to k2 at delta_l, beyond which the contact is elastic with slope k2. With phi = 0 the slope is k2 throughout and
/// loading has no end. Without damping and with kc = 0, phi = 0 the restitution is sqrt(k1/k2).
///
/// The Coulomb limit counts from F_ne + kc delta where kc > 0.  Luding, Granul. Matter 10 (2008) 235; without adhesion
/// Walton and Braun, J. Rheol. 30 (1986) 949.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"
#include "gpudem/errors.h"

namespace gpudem {

struct LudingNormal {
  static constexpr const char *name = "luding";
  static constexpr bool linear = true, adhesive = true, beyondTouch = false;
  static constexpr int history = 1;  ///< largest overlap, the same from either side
  static std::vector<ParameterInfo> parameters()
  {
    return {positive("k1", "force/distance"),
            dampingParameter(),
            positive("k2", "force/distance"),
            notNegative("kc", "force/distance"),
            {"phi", "-", 0.0, 1.0, false}};
  }
  static ContactModuli moduli(const double *) { return {}; }
  static void derive(const double *p, double *c)
  {
    if (p[2] < p[0]) throw Error("normal luding: the stiffness k2 of unloading must not be below k1 of loading");
    const bool plastic = p[2] > p[0];
    c[loading] = p[0];
    c[unloading] = p[2];
    c[adhesion] = p[3];
    c[depth] = plastic ? 2.0 * p[4] * p[2] / (p[2] - p[0]) : 0.0;
    c[retreat] = plastic ? (p[2] + p[3]) / (p[2] - p[0]) : 1.0;
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    const Real k1 = k.normal[loading], kc = k.normal[adhesion], limit = k.normal[depth] * c.effectiveRadius;
    const bool grows = limit > Real(0);
    Real largest = history[0] > c.overlap ? history[0] : c.overlap;
    largest = grows && largest > limit ? limit : largest;
    const Real growth = grows ? divide(k.normal[unloading] - k1, limit) : Real(0);
    const Real slope = grows ? k1 + growth * largest : k.normal[unloading];
    const Real spring = k1 * largest + slope * (c.overlap - largest), least = -kc * c.overlap;
    // where the branches meet: growth x^2 - growth delta x - (k1 + kc) delta = 0 for x = delta_max
    const Real square = c.overlap * c.overlap + Real(4) * divide((k1 + kc) * c.overlap, growth);
    const Real met = grows ? Real(0.5) * (c.overlap + squareRoot(square)) : k.normal[retreat] * c.overlap;
    const bool pulls = spring < least;
    history[0] = pulls ? met : largest;

    NormalForce<Real> f{};
    f.elastic = pulls ? least : spring;
    f.contactRadius = squareRoot(c.overlap * c.effectiveRadius);
    f.stiffness = k1;  // of the dashpot: F/delta would vanish and change its sign on unloading
    f.pullOff = Real(0.5) * kc * c.overlap;
    f.adhesive = kc > Real(0);
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { loading, unloading, adhesion, depth, retreat };
};

}  // namespace gpudem
