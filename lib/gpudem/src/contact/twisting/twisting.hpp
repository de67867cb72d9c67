// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Resistance to relative spin w_n about the normal: torque -k theta - gamma w_n, clipped to mu F_n0.
///
///   sds       k, gamma, mu given.  Luding, Granul. Matter 10 (2008) 235.
///   marshall  k = k_t a^2/2, gamma = eta_t a^2/2, mu = 2/3 a mu_t from the tangential sub-model (k_t with its factor a
///             where it has one).  Marshall, J. Comput. Phys. 228 (2009) 1541.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

struct NoTwisting {
  static constexpr const char *name = "none";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {}; }
  static std::vector<signed char> mirror() { return {}; }
  static void derive(const double *, const ModelContext &, double *) {}
  template <class Real>
  GPUDEM_HD static Real torque(const ModelCoefficients<Real> &, const Contact<Real> &, const ContactFrame<Real> &, Real,
                               const TangentialStiffness<Real> &, Real, Real *, Real, bool)
  {
    return Real(0);
  }
};

/// Torque about the normal of spring \p k, dashpot \p gamma and slider \p limit.
template <class Real>
GPUDEM_HD Real clippedTwist(Real rate, Real k, Real gamma, Real limit, Real *history, Real dt, bool advance)
{
  Real angle = history[0];
  if (advance) angle += rate * dt;
  Real torque = -k * angle - gamma * rate;
  if (absolute(torque) > limit) {
    const Real sign = rate > Real(0) ? Real(1) : rate < Real(0) ? Real(-1) : Real(0);
    angle = k > Real(0) ? divide(limit * sign - gamma * rate, k) : Real(0);
    torque = -limit * sign;
  }
  history[0] = angle;
  return torque;
}

struct SdsTwisting {
  static constexpr const char *name = "sds";
  static constexpr int history = 1;
  static std::vector<ParameterInfo> parameters()
  {
    return {notNegative("k", "torque"), notNegative("gamma", "torque time"), {"mu", "distance", 0.0, unbounded, false}};
  }
  /// The relative spin about the normal is the same seen from either grain.
  static std::vector<signed char> mirror() { return {1}; }
  static void derive(const double *p, const ModelContext &, double *c)
  {
    for (int n = 0; n < 3; ++n) c[n] = p[n];
  }
  /// \param a    contact radius
  /// \param base normal force that the limit counts from
  template <class Real>
  GPUDEM_HD static Real torque(const ModelCoefficients<Real> &k, const Contact<Real> &c, const ContactFrame<Real> &f,
                               Real, const TangentialStiffness<Real> &, Real base, Real *history, Real dt, bool advance)
  {
    return clippedTwist(dot(c.spinDifference, f.normal), k.twisting[0], k.twisting[1], k.twisting[2] * base, history,
                        dt, advance);
  }
};

struct MarshallTwisting {
  static constexpr const char *name = "marshall";
  static constexpr int history = 1;
  static std::vector<ParameterInfo> parameters() { return {}; }
  static std::vector<signed char> mirror() { return {1}; }
  static void derive(const double *, const ModelContext &context, double *c) { c[0] = 2.0 / 3.0 * context.friction; }
  template <class Real>
  GPUDEM_HD static Real torque(const ModelCoefficients<Real> &k, const Contact<Real> &c, const ContactFrame<Real> &f,
                               Real a, const TangentialStiffness<Real> &t, Real base, Real *history, Real dt,
                               bool advance)
  {
    const Real half = Real(0.5) * a * a;
    return clippedTwist(dot(c.spinDifference, f.normal), half * t.spring, half * t.dashpot, k.twisting[0] * a * base,
                        history, dt, advance);
  }
};

}  // namespace gpudem
