// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Friction without memory: F_t = -min(mu F_n0, eta_t |v_t|) v_t/|v_t|, eta_t = xgt eta.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

/// Frictionless.
struct NoTangential {
  static constexpr const char *name = "none";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {}; }
  static std::vector<signed char> mirror() { return {}; }
  static double friction(const double *) { return 0.0; }
  static double derived(std::size_t, const ContactModuli &) { return 0.0; }
  static void derive(const double *, const ModelContext &, double *) {}
  template <class Real>
  GPUDEM_HD static Vec3<Real> force(const ModelCoefficients<Real> &, const ContactFrame<Real> &, Real, Real, Real,
                                    Real *, Real, bool)
  {
    return {Real(0), Real(0), Real(0)};
  }
  template <class Real>
  GPUDEM_HD static TangentialStiffness<Real> stiffness(const ModelCoefficients<Real> &, Real, Real)
  {
    return {Real(0), Real(0)};
  }
};

struct ViscousTangential {
  static constexpr const char *name = "linear_nohistory";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("xgt", "-"), frictionParameter()}; }
  static std::vector<signed char> mirror() { return {}; }
  static double friction(const double *p) { return p[1]; }
  static double derived(std::size_t, const ContactModuli &) { return 0.0; }
  static void derive(const double *p, const ModelContext &, double *c)
  {
    c[drag] = p[0];
    c[coulomb] = p[1];
  }
  /// \param a     contact radius
  /// \param eta   coefficient of the normal dashpot
  /// \param base  normal force that the Coulomb limit counts from
  template <class Real>
  GPUDEM_HD static Vec3<Real> force(const ModelCoefficients<Real> &k, const ContactFrame<Real> &f, Real, Real eta,
                                    Real base, Real *, Real, bool)
  {
    const Real speed = squareRoot(dot(f.slip, f.slip));
    const Real viscous = k.tangential[drag] * eta * speed, limit = k.tangential[coulomb] * base;
    return f.slip * (speed > Real(0) ? -divide(limit < viscous ? limit : viscous, speed) : Real(0));
  }
  template <class Real>
  GPUDEM_HD static TangentialStiffness<Real> stiffness(const ModelCoefficients<Real> &k, Real, Real eta)
  {
    return {Real(0), k.tangential[drag] * eta};
  }

 private:
  enum { drag, coulomb };
};

}  // namespace gpudem
