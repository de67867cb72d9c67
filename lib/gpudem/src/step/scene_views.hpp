// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From the scene and a step number to the tables a launch carries. Host code.
#pragma once

#include "step/roles.hpp"
#include "step/step_view.hpp"
#include "gpudem/engine.h"

#include <cmath>

namespace gpudem {

inline Vec3<double> toVec3(const Array3 &a)
{
  return {a[0], a[1], a[2]};
}

/// Wall at \p step: LAMMPS' wiggle is coord + A - A cos(w t), shear is a constant surface velocity.
template <class Real>
WallView<Real> wallAt(const WallSpec &spec, const Roles &roles, std::int64_t step, double dt)
{
  WallView<Real> v{};
  v.law = coefficients<Real>(spec.law);
  v.normal = spec.law.normal;
  v.tangential = spec.law.tangential;
  v.shape = spec.shape;
  v.axis = spec.axis;
  v.lo = spec.lo;
  v.hi = spec.hi;
  v.radius = spec.radius;
  v.velocity = {0.0, 0.0, 0.0};
  v.role = roles.of(spec.groupMask);
  if (spec.wiggle) {
    const double phase = spec.angularFrequency * static_cast<double>(step - spec.stepOrigin) * dt;
    if (spec.shape == WallShape::Plane && spec.axis == spec.motionAxis) {
      const double shift = spec.amplitude - spec.amplitude * std::cos(phase);
      v.lo += shift;
      v.hi += shift;
    }
    v.velocity[spec.motionAxis] = spec.amplitude * spec.angularFrequency * std::sin(phase);
  } else if (spec.shear) {
    if (spec.shape == WallShape::Cylinder && spec.motionAxis != 2) v.tangentialSpeed = spec.shearSpeed;
    else v.velocity[spec.motionAxis] = spec.shearSpeed;
  }
  return v;
}

inline int componentBits(const std::array<bool, 3> &set)
{
  return (set[0] ? 1 : 0) | (set[1] ? 2 : 0) | (set[2] ? 4 : 0);
}

/// Integrator whose coming positions belong to \p coming.
inline IntegratorView integratorAt(const IntegratorSpec &spec, const Roles &roles, std::int64_t coming, double dt,
                                   double halfKick)
{
  IntegratorView v{};
  v.kind = spec.kind;
  v.role = roles.of(spec.groupMask);
  v.halfKickPerInertia = halfKick / spec.inertia;
  v.prescribed = componentBits(spec.prescribed);
  v.point = toVec3(spec.point);
  v.axis = toVec3(spec.axis);
  v.angularFrequency = spec.angularFrequency;
  const double elapsed = static_cast<double>(coming - spec.stepOrigin) * dt;
  const double phase = spec.angularFrequency * elapsed;
  v.cosine = std::cos(phase);
  v.sine = std::sin(phase);
  const Vec3<double> vector = toVec3(spec.vector);
  if (spec.wiggle) {
    v.displacement = vector * v.sine;
    v.velocity = vector * (spec.angularFrequency * v.cosine);
  } else {
    v.displacement = vector * elapsed;
    v.velocity = vector;
  }
  return v;
}

}  // namespace gpudem
