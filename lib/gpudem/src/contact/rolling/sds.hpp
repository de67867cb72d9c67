// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Rolling resistance by a spring, a dashpot and a slider on the rolling velocity v_r = R* (w_i - w_j) x n:
/// pseudo-force F = -k xi - gamma v_r, clipped to mu F_n0; torque R* n x F.
/// Luding, Granul. Matter 10 (2008) 235; rolling velocity of Wang, Alonso-Marroquin, Xue and Xie, Particuology 23
/// (2015) 49.
#pragma once

#include "contact/tangential/spring.hpp"

namespace gpudem {

struct NoRolling {
  static constexpr const char *name = "none";
  static constexpr int history = 0;
  static constexpr bool takesInertia = false;
  static std::vector<ParameterInfo> parameters() { return {}; }
  static std::vector<signed char> mirror() { return {}; }
  static void derive(const double *, const ModelContext &, double *) {}
  template <class Real>
  GPUDEM_HD static Vec3<Real> moment(const ModelCoefficients<Real> &, const Contact<Real> &, const ContactFrame<Real> &,
                                     const NormalForce<Real> &, const TangentialStiffness<Real> &, Real, Real *, Real,
                                     bool)
  {
    return {Real(0), Real(0), Real(0)};
  }
};

struct SdsRolling {
  static constexpr const char *name = "sds";
  static constexpr int history = 3;
  static constexpr bool takesInertia = false;
  static std::vector<ParameterInfo> parameters()
  {
    return {notNegative("k", "force/distance"), notNegative("gamma", "force time/distance"), frictionParameter()};
  }
  /// The rolling velocity is the same seen from either grain.
  static std::vector<signed char> mirror() { return {1, 1, 1}; }
  static void derive(const double *p, const ModelContext &, double *c)
  {
    for (int n = 0; n < 3; ++n) c[n] = p[n];
  }

  /// \param base normal force that the Coulomb limit counts from
  /// \return torque on the grain
  template <class Real>
  GPUDEM_HD static Vec3<Real> moment(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                     const ContactFrame<Real> &f, const NormalForce<Real> &,
                                     const TangentialStiffness<Real> &, Real base, Real *history, Real dt, bool advance)
  {
    Vec3<Real> spring{history[0], history[1], history[2]};
    const Vec3<Real> rate = cross(c.spinDifference, f.normal) * c.effectiveRadius;
    const Vec3<Real> force = clippedSpring(spring, f.normal, rate, k.rolling[stiffness], k.rolling[drag],
                                           k.rolling[coulomb] * base, dt, advance, false);
    history[0] = spring.x;
    history[1] = spring.y;
    history[2] = spring.z;
    return cross(f.normal, force) * c.effectiveRadius;
  }

 private:
  enum { stiffness, drag, coulomb };
};

}  // namespace gpudem
