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

/// Coefficients of one ContactModel in the arithmetic of the step. What an entry means is up to the sub-model, which
/// fills it in derive() and names its index.
template <class Real>
struct ModelCoefficients {
  Real normal[maxNormalCoefficients];
  Real damping;
  Real tangential[maxCoefficients], rolling[maxCoefficients], twisting[maxCoefficients];
  Real lever;                      ///< see ContactModel
  std::int32_t model[modelSlots];  ///< index of the sub-model in its list, for laws that are chosen at run time
  std::int32_t limitDamping;
};

/// Numbers that one contact keeps from step to step, by slot.
template <class Real>
struct ModelHistory {
  Real normal[maxNormalHistory], tangential[maxTangentialHistory], rolling[maxRollingHistory],
      twisting[maxTwistingHistory];
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

/// What twisting takes from the tangential sub-model: stiffness with its factor a, and dashpot.
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

template <class Real>
GPUDEM_HD ContactFrame<Real> contactFrame(const Contact<Real> &c)
{
  ContactFrame<Real> f;
  f.normal = c.branch * c.inverseDistance;
  f.normalRate = dot(c.relativeVelocity, f.normal);
  f.slip = (c.relativeVelocity - f.normal * f.normalRate) - cross(c.surfaceSpin, f.normal);
  return f;
}

/// What derive() of a frictional sub-model may read besides its own parameters.
struct ModelContext {
  ContactModuli moduli;
  bool linear = false;    ///< the normal force is proportional to the overlap
  double friction = 0.0;  ///< Coulomb coefficient of the tangential sub-model
};

}  // namespace gpudem
