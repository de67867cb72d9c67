// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The numbers a contact law reads in the step, and what its members hand to each other.
#pragma once

#include "contact/contact.hpp"
#include "gpudem/contact_model.h"

#include <cstdint>

namespace gpudem {

constexpr int maxNormalCoefficients = 8, maxCoefficients = 4;
constexpr int maxNormalHistory = 2, maxTangentialHistory = 4, maxRollingHistory = 3, maxTwistingHistory = 1;
constexpr int maxCohesionHistory = 1;

/// Coefficients of one ContactModel in the arithmetic of the step. What an entry means is up to the sub-model, which
/// fills it in derive() and names its index.
template <class Real>
struct ModelCoefficients {
  Real normal[maxNormalCoefficients];
  Real damping;
  Real tangential[maxCoefficients], rolling[maxCoefficients], twisting[maxCoefficients], cohesion[maxCoefficients];
  Real lever, slipLever;           ///< see ContactModel
  std::int32_t model[modelSlots];  ///< index of the sub-model in its list, for laws that are chosen at run time
  std::int32_t limitDamping;
  std::int32_t netBase;       ///< see CoulombBase
  std::int32_t necks;         ///< the normal sub-model acts beyond touch
  std::int32_t beforeTouch;   ///< the cohesion sub-model acts before touch
  std::int32_t readsInertia;  ///< the rolling sub-model reads Contact::inertia
};

/// Numbers that one contact keeps from step to step, by slot.
template <class Real>
struct ModelHistory {
  Real normal[maxNormalHistory], tangential[maxTangentialHistory], rolling[maxRollingHistory],
      twisting[maxTwistingHistory], cohesion[maxCohesionHistory];
};

/// What the normal sub-model tells the others.
template <class Real>
struct NormalForce {
  Real elastic;        ///< force without damping, repulsion positive
  Real contactRadius;  ///< a (distance)
  Real stiffness;      ///< k_nd of the damping laws: elastic force over overlap (force/distance)
  Real pullOff;        ///< adhesive laws: pull-off force, which enters the Coulomb limit; else 0
  bool adhesive;       ///< the Coulomb limit counts from the elastic force plus twice the pull-off force
};

/// What rolling and twisting take from the tangential sub-model: stiffness with its factor a, and dashpot.
template <class Real>
struct TangentialStiffness {
  Real spring, dashpot;
};

/// Normal direction and velocities shared by the frictional sub-models.
template <class Real>
struct ContactFrame {
  Vec3<Real> normal;  ///< from the partner to the grain
  Real normalRate;    ///< v_n
  Vec3<Real> slip;    ///< tangential velocity of the surfaces
};

/// R_i omega_i + R_j omega_j with radii shortened by \p lever times the overlap. The sum of the spins follows from what
/// the contact has: (R_i + R_j)(w_i + w_j) = 2 (R_i w_i + R_j w_j) + (R_j - R_i)(w_i - w_j).
template <class Real>
GPUDEM_HD Vec3<Real> shortenedSpin(const Contact<Real> &c, Real lever)
{
  const Real perReach = divide(lever * c.overlap, c.distance + c.overlap);
  return c.surfaceSpin - (c.surfaceSpin * Real(2) + c.spinDifference * c.radiusDifference) * perReach;
}

/// \param surfaceSpin of the contact, or shortened
template <class Real>
GPUDEM_HD ContactFrame<Real> contactFrame(const Contact<Real> &c, const Vec3<Real> &surfaceSpin)
{
  ContactFrame<Real> f;
  f.normal = c.branch * c.inverseDistance;
  f.normalRate = dot(c.relativeVelocity, f.normal);
  f.slip = (c.relativeVelocity - f.normal * f.normalRate) - cross(surfaceSpin, f.normal);
  return f;
}

/// What derive() of a frictional sub-model may read besides its own parameters.
struct ModelContext {
  ContactModuli moduli;
  bool linear = false;    ///< the normal force is proportional to the overlap
  double friction = 0.0;  ///< Coulomb coefficient of the tangential sub-model
  bool spring = false;    ///< the tangential sub-model has a spring
};

}  // namespace gpudem
