// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a contact law is given and what it returns.
///
/// Every quantity either flips its sign exactly or stays exactly the same when the two grains change places, so the
/// two evaluations of a contact are opposite to the last bit.
#pragma once

#include "base/real.hpp"
#include "base/vec3.hpp"

namespace gpudem {

/// Geometry and motion of one contact, seen from the grain.
template <class Real>
struct Contact {
  Vec3<Real> branch;            ///< from the partner's centre (or the wall) to the grain's (distance)
  Real distance;                ///< |branch|
  Real inverseDistance;         ///< 1/|branch|
  Real overlap;                 ///< sum of radii - distance (distance)
  Real effectiveRadius;         ///< R_i R_j/(R_i + R_j), filled for laws that read it (distance)
  Real effectiveMass;           ///< m_i m_j/(m_i + m_j)
  Vec3<Real> relativeVelocity;  ///< v_i - v_j (distance/time)
  Vec3<Real> surfaceSpin;       ///< R_i omega_i + R_j omega_j (distance/time)
  Vec3<Real> spinDifference;    ///< omega_i - omega_j, filled for laws that read it (radian/time)
  Real radiusDifference;        ///< R_j - R_i, -R_i at a wall; filled with the above (distance)
  Real inertia;                 ///< I_i I_j/(I_i + I_j), I = m R^2, m R^2 at a wall; filled for laws that read it
  bool atWall;
};

template <class Real>
struct ContactForce {
  Vec3<Real> force;   ///< on the grain
  Vec3<Real> couple;  ///< n x F_t: the grain's torque is -arm couple
  Vec3<Real> moment;  ///< torque on the grain that needs no arm (rolling, twisting); opposite on the partner
  Real shorter;       ///< the arm is the radius less this (distance)
};

}  // namespace gpudem
