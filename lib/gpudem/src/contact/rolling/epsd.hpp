// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Elastic-plastic spring and dashpot against rolling, w_t = w - (w.n) n the relative spin without its twist:
///
///   torque of the spring  dM = -k_r w_t dt,  |M| clipped to M_m = mu R* F_n0;
///   below M_m a dashpot adds -2 eta sqrt(1.4 I k_r) w_t, I = I_i I_j/(I_i + I_j) with I_i = m_i R_i^2.
///
///   epsd    k_r = 2.25 kn (mu R*)^2      epsd3   k_r = c kn (mu R*)^2, c given
///   epsd2   k_r = kt R*^2, no dashpot: with a linear spring, rolling sds of k = kt, gamma = 0 but for the turning
///
/// kn is F_ne/delta, kt the tangential stiffness. As in LIGGGHTS the stored torque is not turned with the contact.
/// Model C of Ai, Chen, Rotter and Ooi, Powder Technol. 206 (2011) 269 (2.25 after Jiang, Yu and Harris, Comput.
/// Geotech. 32 (2005) 340); epsd2: Iwashita and Oda, J. Eng. Mech. 124 (1998) 285, as in LIGGGHTS.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"
#include "gpudem/errors.h"

namespace gpudem {

enum class RollingSpring {
  Normal,     ///< 2.25 kn (mu R*)^2
  Tangential  ///< kt R*^2
};

template <RollingSpring spring>
struct EpsdForm {
  static constexpr int history = 3;  ///< torque of the spring on the grain
  static constexpr bool takesInertia = spring == RollingSpring::Normal;
  /// The partner's torque is the opposite.
  static std::vector<signed char> mirror() { return {-1, -1, -1}; }

  /// \param base     normal force that the limit counts from
  /// \param advance  false: the forces at the start of a run. The spring does not grow then, but whether it slides is
  ///                 decided as in a step: a spring kept at its limit must not let the dashpot act
  /// \return torque on the grain
  template <class Real>
  GPUDEM_HD static Vec3<Real> moment(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                     const ContactFrame<Real> &f, const NormalForce<Real> &n,
                                     const TangentialStiffness<Real> &t, Real base, Real *history, Real dt,
                                     bool advance)
  {
    const Real square = c.effectiveRadius * c.effectiveRadius;
    const Real kr = square * (spring == RollingSpring::Tangential ? t.spring : k.rolling[stiffness] * n.stiffness);
    const Vec3<Real> rate = c.spinDifference - f.normal * dot(c.spinDifference, f.normal);
    const Vec3<Real> kept{history[0], history[1], history[2]}, grown = kept - rate * (kr * dt);
    const Real limit = k.rolling[coulomb] * c.effectiveRadius * base, magnitude2 = dot(grown, grown);
    const bool rolls = magnitude2 > limit * limit;
    const Vec3<Real> sticks = advance ? grown : kept;
    const Vec3<Real> torque = rolls ? grown * (limit * inverseSquareRoot(magnitude2)) : sticks;
    history[0] = torque.x;
    history[1] = torque.y;
    history[2] = torque.z;
    if (spring == RollingSpring::Tangential) return torque;
    return torque - rate * (rolls ? Real(0) : k.rolling[drag] * squareRoot(c.inertia * kr));
  }

 protected:
  enum { coulomb, stiffness, drag };
  static void derive(double mu, double eta, double perNormal, double *c)
  {
    c[coulomb] = mu;
    c[stiffness] = perNormal * mu * mu;
    c[drag] = 2.0 * eta * std::sqrt(1.4);
  }
};

struct EpsdRolling : EpsdForm<RollingSpring::Normal> {
  static constexpr const char *name = "epsd";
  static std::vector<ParameterInfo> parameters() { return {frictionParameter(), notNegative("eta", "-")}; }
  static void derive(const double *p, const ModelContext &, double *c) { EpsdForm::derive(p[0], p[1], 2.25, c); }
};

struct Epsd2Rolling : EpsdForm<RollingSpring::Tangential> {
  static constexpr const char *name = "epsd2";
  static std::vector<ParameterInfo> parameters() { return {frictionParameter()}; }
  static void derive(const double *p, const ModelContext &context, double *c)
  {
    if (!context.spring) throw Error("rolling epsd2 needs a tangential sub-model that has a spring");
    EpsdForm::derive(p[0], 0.0, 0.0, c);
  }
};

struct Epsd3Rolling : EpsdForm<RollingSpring::Normal> {
  static constexpr const char *name = "epsd3";
  static std::vector<ParameterInfo> parameters()
  {
    return {frictionParameter(), notNegative("eta", "-"), notNegative("c", "-")};
  }
  static void derive(const double *p, const ModelContext &, double *c) { EpsdForm::derive(p[0], p[1], p[2], c); }
};

}  // namespace gpudem
