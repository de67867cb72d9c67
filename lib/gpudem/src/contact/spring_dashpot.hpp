// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contact law of LAMMPS' gran/hooke, gran/hooke/history and gran/hertz/history.
///
/// One pure function serves grain-grain and grain-wall contacts, on every backend and in every
/// precision. With n the unit vector from the partner to the grain, delta the overlap, m the effective
/// mass, v_n and v_t the normal and tangential relative velocity, xi the tangential spring:
///
///   Hooke   F_n = s (kn delta - m gamma_n v_n),  s = 1
///   Hertz   the same with s = sqrt(delta R_eff)
///   Viscous F_t = -min(mu |F_n|, m gamma_t |v_t|) v_t/|v_t|
///   Spring  F_t = -s (kt xi + m gamma_t v_t), clipped to mu |F_n|; xi then shortened so that the sum of
///           spring and dashpot is the clipped force. xi += v_t dt first, then its part along n is removed.
///
/// Source: Silbert et al., Phys. Rev. E 64 (2001) 051302; Brilliantov et al., Phys. Rev. E 53 (1996)
/// 5382; Zhang and Makse, Phys. Rev. E 72 (2005) 011301; conventions of LAMMPS 29 Sep 2021.
#pragma once

#include "contact/contact.hpp"
#include "gpudem/scene.h"

namespace gpudem {

/// Coefficients of a ContactLaw in the arithmetic of the step.
template <class Real>
struct LawCoefficients {
  Real kn, kt, gamman, gammat, friction;
  Real inverseKt;  ///< 1/kt, 0 if kt is 0
  bool limitDamping;
};

template <class Real>
LawCoefficients<Real> coefficients(const ContactLaw &law)
{
  return {static_cast<Real>(law.normalStiffness),
          static_cast<Real>(law.tangentialStiffness),
          static_cast<Real>(law.normalDamping),
          static_cast<Real>(law.tangentialDamping),
          static_cast<Real>(law.friction),
          static_cast<Real>(law.tangentialStiffness != 0.0 ? 1.0 / law.tangentialStiffness : 0.0),
          law.limitDamping};
}

/// \param spring tangential spring, read and written by TangentialModel::Spring only (distance)
/// \param dt     time step, 0 when the springs must not advance (LAMMPS' setup)
template <NormalModel normal, TangentialModel tangential, class Real>
GPUDEM_HD ContactForce<Real> springDashpot(const LawCoefficients<Real> &law, const Contact<Real> &c, Vec3<Real> &spring,
                                           Real dt, bool advance)
{
  const Real inverse = c.inverseDistance;
  const Real inverse2 = inverse * inverse;
  const Real normalRate = dot(c.relativeVelocity, c.branch);

  Real scale = Real(1);
  Real push = law.kn * c.overlap * inverse - c.effectiveMass * law.gamman * normalRate * inverse2;
  if (normal == NormalModel::Hertz) {
    scale = squareRoot(c.overlap * c.effectiveRadius);
    push *= scale;
  }
  push = law.limitDamping && push < Real(0) ? Real(0) : push;

  ContactForce<Real> out;
  out.force = c.branch * push;
  out.couple = out.moment = {Real(0), Real(0), Real(0)};
  out.shorter = Real(0);
  if (tangential == TangentialModel::None) return out;

  const Vec3<Real> slip =
      (c.relativeVelocity - c.branch * (normalRate * inverse2)) - cross(c.surfaceSpin * inverse, c.branch);
  const Real limit = law.friction * absolute(push * c.distance);
  Vec3<Real> friction;

  if (tangential == TangentialModel::Viscous) {
    const Real speed = squareRoot(dot(slip, slip));
    const Real drag = c.effectiveMass * law.gammat * speed;
    friction = slip * (speed > Real(0) ? -divide(limit < drag ? limit : drag, speed) : Real(0));
  } else {
    if (advance) spring += slip * dt;
    const bool fresh = dot(spring, spring) == Real(0);
    if (advance) spring -= c.branch * (dot(spring, c.branch) * inverse2);
    const Vec3<Real> dashpot = slip * (c.effectiveMass * law.gammat);
    friction = (spring * law.kt + dashpot) * (-scale);
    const Real magnitude2 = dot(friction, friction);
    const bool slides = magnitude2 > limit * limit;
    const Real ratio = slides ? limit * inverseSquareRoot(magnitude2) : Real(1);
    const Vec3<Real> lag = dashpot * law.inverseKt;
    const Vec3<Real> shortened = (spring + lag) * ratio - lag;
    const bool shorten = slides && !fresh;
    spring = {shorten ? shortened.x : spring.x, shorten ? shortened.y : spring.y, shorten ? shortened.z : spring.z};
    friction = friction * (slides && fresh ? Real(0) : ratio);
  }
  out.force += friction;
  out.couple = cross(c.branch, friction) * inverse;
  return out;
}

/// The same with the models chosen at run time, for contacts that are few (walls).
template <class Real>
GPUDEM_HD ContactForce<Real> springDashpot(NormalModel normal, TangentialModel tangential,
                                           const LawCoefficients<Real> &law, const Contact<Real> &c, Vec3<Real> &spring,
                                           Real dt, bool advance)
{
  using N = NormalModel;
  using T = TangentialModel;
  if (normal == N::Hertz) {
    return tangential == T::Spring ? springDashpot<N::Hertz, T::Spring>(law, c, spring, dt, advance)
                                   : springDashpot<N::Hertz, T::Viscous>(law, c, spring, dt, advance);
  }
  return tangential == T::Spring ? springDashpot<N::Hooke, T::Spring>(law, c, spring, dt, advance)
                                 : springDashpot<N::Hooke, T::Viscous>(law, c, spring, dt, advance);
}

}  // namespace gpudem
