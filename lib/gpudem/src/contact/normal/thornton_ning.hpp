// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Elastic, perfectly plastic spheres without adhesion. The contact yields where its pressure reaches Y,
///
///   loading     F_ne = 4/3 E* sqrt(R*) delta^(3/2)              up to delta_y = (pi Y/(2 E*))^2 R*,
///               F_ne = F_y + pi Y R* (delta - delta_y)          beyond, F_y = 2/3 pi Y R* delta_y
///   unloading   F_ne = 4/3 E* sqrt(R_p) (delta - delta_p)^(3/2)
///
/// with the curvature radius R_p = R* F_Hertz(delta_max)/F_max of the flattened surface and delta_p = delta_max -
/// (R*/R_p) delta_max, so that the contact radius sqrt(R* delta_max) and the force are those at the turning point.
/// Surfaces part at delta_p.  Thornton and Ning, Powder Technol. 99 (1998) 154; Thornton, J. Appl. Mech. 64 (1997) 383.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct ThorntonNingNormal {
  static constexpr const char *name = "thornton_ning";
  static constexpr bool linear = false, adhesive = false, beyondTouch = false;
  static constexpr int history = 1;  ///< largest overlap, the same from either side
  static std::vector<ParameterInfo> parameters()
  {
    return {youngParameter(), dampingParameter(), poissonParameter(), positive("Y", "pressure")};
  }
  static ContactModuli moduli(const double *p) { return selfContact(p[0], p[2]); }
  static void derive(const double *p, double *c)
  {
    constexpr double pi = 3.14159265358979323846;
    const double young = moduli(p).young, strain = pi * p[3] / (2.0 * young);
    c[stiffness] = 4.0 / 3.0 * young;
    c[yieldSlope] = pi * p[3];
    c[yieldOverlap] = strain * strain;
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    const Real radius = c.effectiveRadius, largest = history[0] > c.overlap ? history[0] : c.overlap;
    history[0] = largest;
    const Real limit = k.normal[yieldOverlap] * radius;
    const Real hertz = k.normal[stiffness] * squareRoot(radius * largest) * largest;
    const Real plastic = k.normal[yieldSlope] * radius * (largest - limit * Real(1.0 / 3.0));
    const Real flattening = largest > limit ? divide(plastic, hertz) : Real(1);  // R*/R_p
    const Real above = c.overlap - largest + largest * flattening;               // delta - delta_p

    NormalForce<Real> f{};
    f.contactRadius = above > Real(0) ? squareRoot(divide(radius * above, flattening)) : Real(0);
    f.stiffness = k.normal[stiffness] * f.contactRadius;
    f.elastic = above > Real(0) ? f.stiffness * above : Real(0);
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { stiffness, yieldSlope, yieldOverlap };
};

}  // namespace gpudem
