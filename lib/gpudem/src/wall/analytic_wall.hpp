// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Planes and the z cylinder of LAMMPS' fix wall/gran, as one contact per grain. Laws at walls.
#pragma once

#include "contact/product.hpp"
#include "step/step_view.hpp"

namespace gpudem {

/// Where a wall touches a grain: the vector from the contact point to the centre.
struct WallGap {
  Vec3<double> branch;    ///< (distance)
  double distance;        ///< |branch|
  double curvature;       ///< 0 flat; else the signed radius that enters R_eff (distance)
  Vec3<double> velocity;  ///< of the surface at the contact (distance/time)
};

/// Signed radius of the surface at \p x, which enters R_eff as in LAMMPS: negative inside a cylinder, 0 flat
/// (distance).
template <class Real>
GPUDEM_HD double wallCurvature(const WallView<Real> &wall, const Vec3<double> &x)
{
  if (wall.shape == WallShape::Plane) return 0.0;
  return x.x * x.x + x.y * x.y < wall.radius * wall.radius ? -2.0 * wall.radius : 2.0 * wall.radius;
}
GPUDEM_HD double wallEffectiveRadius(double radius, double curvature)
{
  return curvature == 0.0 ? radius : radius * curvature / (curvature + radius);
}

/// \param reach radius, larger if an adhesive contact may outlive touch (distance)
/// \return false when the grain does not touch. The nearer of two planes acts, as in LAMMPS.
template <class Real>
GPUDEM_HD bool wallGap(const WallView<Real> &wall, const Vec3<double> &x, double reach, WallGap &gap)
{
  gap.branch = {0.0, 0.0, 0.0};
  gap.curvature = wallCurvature(wall, x);
  gap.velocity = wall.velocity;
  if (wall.shape == WallShape::Plane) {
    const double above = x[wall.axis] - wall.lo;
    const double below = wall.hi - x[wall.axis];
    const double signedDistance = above < below ? above : -below;
    gap.branch[wall.axis] = signedDistance;
    gap.distance = absolute(signedDistance);
    return gap.distance <= reach;
  }
  const double rho = squareRoot(x.x * x.x + x.y * x.y);
  const double inward = wall.radius - rho;
  if (inward > reach || rho == 0.0) return false;
  gap.branch = {-inward / rho * x.x, -inward / rho * x.y, 0.0};
  gap.distance = absolute(inward);
  if (wall.tangentialSpeed != 0.0)
    gap.velocity = {wall.tangentialSpeed * x.y / rho, -wall.tangentialSpeed * x.x / rho, 0.0};
  return gap.distance <= reach;
}

/// Law of the gran/ styles at a wall; what it keeps is updated in place.
template <class Real>
GPUDEM_HD ContactForce<Real> classicWallForce(const WallView<Real> &wall, const Contact<Real> &c, Real *kept, Real dt,
                                              bool advance)
{
  Vec3<Real> spring{Real(0), Real(0), Real(0)};
  if (kept) spring = {kept[0], kept[1], kept[2]};
  const ContactForce<Real> f = springDashpot(wall.normal, wall.tangential, wall.law, c, spring, dt, advance);
  if (kept) {
    kept[0] = spring.x;
    kept[1] = spring.y;
    kept[2] = spring.z;
  }
  return f;
}

/// Product law at a wall; what it keeps is updated in place.
template <class Law = AnyProduct, class Real>
GPUDEM_HD ContactForce<Real> modelWallForce(const WallView<Real> &wall, const Contact<Real> &c, Real *kept, Real dt,
                                            bool advance)
{
  ModelHistory<Real> h{};
  if (Law::beyondTouch && wall.flag) *kept++ = Real(1);
  moveHistory<Law>(wall.layout, h, [&](Real &inRegister, int at) { inRegister = kept[at]; });
  const ContactForce<Real> f = Law::evaluate(*wall.model, c, h, dt, advance);
  moveHistory<Law>(wall.layout, h, [&](Real &inRegister, int at) { kept[at] = inRegister; });
  return f;
}

/// The eight columns of LAMMPS' "contacts" output.
template <class Real>
GPUDEM_HD void recordContact(const WallView<Real> &wall, std::uint32_t i, std::uint32_t count, const Vec3<Real> &force,
                             const Vec3<double> &at, double radius)
{
  const Real column[8] = {Real(1),
                          force.x,
                          force.y,
                          force.z,
                          static_cast<Real>(at.x),
                          static_cast<Real>(at.y),
                          static_cast<Real>(at.z),
                          static_cast<Real>(radius)};
  for (int k = 0; k < 8; ++k) wall.contacts[static_cast<std::size_t>(k) * count + i] = column[k];
}

/// Force of one wall on grain \p i; springs and recorded contacts are updated in place.
/// \tparam Product law of walls that have one, AnyProduct but for WallUse::Same
template <WallUse use, class Product = AnyProduct, class Real>
GPUDEM_HD ContactForce<Real> wallForce(const WallView<Real> &wall, std::uint32_t i, std::uint32_t count,
                                       const Vec3<double> &x, double radius, const Motion<Real> &m, Real dt,
                                       bool advance)
{
  WallGap gap;
  Real *kept = wall.history ? wall.history + static_cast<std::size_t>(wall.historySize) * i : nullptr;
  double reach = radius;
  constexpr bool products = use == WallUse::Any || use == WallUse::Same;
  if (products && Product::beyondTouch && wall.flag && (kept[0] != Real(0) || wall.model->beforeTouch)) {
    const double effective = wallEffectiveRadius(radius, wallCurvature(wall, x));
    reach += static_cast<double>(Product::gap(*wall.model, static_cast<Real>(effective)));
  }
  const bool touches = wallGap(wall, x, reach, gap);
  ContactForce<Real> result{};
  if (!touches) {
    if (kept)
      for (int d = 0; d < wall.historySize; ++d) kept[d] = Real(0);
    return result;
  }
  Contact<Real> c{};
  c.branch = gap.branch.template as<Real>();
  c.distance = static_cast<Real>(gap.distance);
  c.inverseDistance = static_cast<Real>(1.0 / gap.distance);
  c.overlap = static_cast<Real>(radius - gap.distance);
  c.effectiveRadius = static_cast<Real>(wallEffectiveRadius(radius, gap.curvature));
  c.effectiveMass = m.mass;
  c.relativeVelocity = Vec3<Real>{m.vx, m.vy, m.vz} - gap.velocity.template as<Real>();
  c.surfaceSpin = Vec3<Real>{m.wx, m.wy, m.wz} * static_cast<Real>(radius);
  c.spinDifference = {m.wx, m.wy, m.wz};
  c.radiusDifference = -static_cast<Real>(radius);
  c.inertia = m.mass * static_cast<Real>(radius * radius);
  c.atWall = true;
  result = use == WallUse::Same || (products && wall.model) ? modelWallForce<Product>(wall, c, kept, dt, advance)
                                                            : classicWallForce(wall, c, kept, dt, advance);
  if (wall.contacts) recordContact(wall, i, count, result.force, x - gap.branch, radius);
  return result;
}

}  // namespace gpudem
