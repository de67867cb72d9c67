// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Planes and the z cylinder of LAMMPS' fix wall/gran, as one contact per grain.
#pragma once

#include "step/step_view.hpp"

namespace gpudem {

/// Where a wall touches a grain: the vector from the contact point to the centre.
struct WallGap {
  Vec3<double> branch;    ///< (distance)
  double distance;        ///< |branch|
  double curvature;       ///< 0 flat; else the signed radius that enters R_eff (distance)
  Vec3<double> velocity;  ///< of the surface at the contact (distance/time)
};

/// \return false when the grain does not touch. The nearer of two planes acts, as in LAMMPS.
template <class Real>
GPUDEM_HD bool wallGap(const WallView<Real> &wall, const Vec3<double> &x, double radius, WallGap &gap)
{
  gap.branch = {0.0, 0.0, 0.0};
  gap.curvature = 0.0;
  gap.velocity = wall.velocity;
  if (wall.shape == WallShape::Plane) {
    const double above = x[wall.axis] - wall.lo;
    const double below = wall.hi - x[wall.axis];
    const double signedDistance = above < below ? above : -below;
    gap.branch[wall.axis] = signedDistance;
    gap.distance = absolute(signedDistance);
    return gap.distance <= radius;
  }
  const double rho = squareRoot(x.x * x.x + x.y * x.y);
  const double inward = wall.radius - rho;
  if (inward > radius || rho == 0.0) return false;
  gap.branch = {-inward / rho * x.x, -inward / rho * x.y, 0.0};
  gap.distance = absolute(inward);
  gap.curvature = rho < wall.radius ? -2.0 * wall.radius : 2.0 * wall.radius;
  if (wall.tangentialSpeed != 0.0)
    gap.velocity = {wall.tangentialSpeed * x.y / rho, -wall.tangentialSpeed * x.x / rho, 0.0};
  return gap.distance <= radius;
}

/// Force of one wall on grain \p i; springs and recorded contacts are updated in place.
template <class Real>
GPUDEM_HD ContactForce<Real> wallForce(const WallView<Real> &wall, std::uint32_t i, std::uint32_t count,
                                       const Vec3<double> &x, double radius, const Motion<Real> &m, Real dt,
                                       bool advance)
{
  WallGap gap;
  const bool touches = wallGap(wall, x, radius, gap);
  ContactForce<Real> result{};
  if (!touches) {
    if (wall.spring) wall.spring[i] = {Real(0), Real(0), Real(0)};
    return result;
  }
  Contact<Real> c;
  c.branch = gap.branch.template as<Real>();
  c.distance = static_cast<Real>(gap.distance);
  c.inverseDistance = static_cast<Real>(1.0 / gap.distance);
  c.overlap = static_cast<Real>(radius - gap.distance);
  c.effectiveRadius =
      static_cast<Real>(gap.curvature == 0.0 ? radius : radius * gap.curvature / (gap.curvature + radius));
  c.effectiveMass = m.mass;
  c.relativeVelocity = Vec3<Real>{m.vx, m.vy, m.vz} - gap.velocity.template as<Real>();
  c.surfaceSpin = Vec3<Real>{m.wx, m.wy, m.wz} * static_cast<Real>(radius);
  Vec3<Real> spring{Real(0), Real(0), Real(0)};
  if (wall.spring) spring = wall.spring[i];
  result = springDashpot(wall.normal, wall.tangential, wall.law, c, spring, dt, advance);
  if (wall.spring) wall.spring[i] = spring;
  if (wall.contacts) {
    const Vec3<double> at = x - gap.branch;
    const Real column[8] = {Real(1),
                            result.force.x,
                            result.force.y,
                            result.force.z,
                            static_cast<Real>(at.x),
                            static_cast<Real>(at.y),
                            static_cast<Real>(at.z),
                            static_cast<Real>(radius)};
    for (int k = 0; k < 8; ++k) wall.contacts[static_cast<std::size_t>(k) * count + i] = column[k];
  }
  return result;
}

}  // namespace gpudem
