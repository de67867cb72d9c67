// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Cylinder and cone of a region: in the half plane through their axis and the grain both are a trapezium.
#pragma once

#include "wall/region_shape.hpp"

namespace gpudem {

/// A grain seen from the axis of a cylinder or cone.
struct AxialPlace {
  Vec3<double> arm;  ///< from the axis, normal to it (distance)
  double rho;        ///< |arm|
  double z;          ///< along the axis (distance)
};
GPUDEM_HD AxialPlace axialPlace(const RegionShape &s, const Vec3<double> &x)
{
  AxialPlace p;
  p.arm = x - s.centre;
  p.z = x[s.axis];
  p.arm[s.axis] = 0.0;
  p.rho = squareRoot(dot(p.arm, p.arm));
  return p;
}
GPUDEM_HD double roundLo(const RegionShape &s)
{
  return s.lo[s.axis];
}
GPUDEM_HD double roundHi(const RegionShape &s)
{
  return s.hi[s.axis];
}
/// Radius of the curved face at height z.
GPUDEM_HD double radiusAt(const RegionShape &s, double z)
{
  if (s.kind == RegionKind::Cylinder) return s.radius;
  return s.radius + (z - roundLo(s)) * (s.radiusHi - s.radius) / (roundHi(s) - roundLo(s));
}
GPUDEM_HD bool roundContains(const RegionShape &s, const AxialPlace &p)
{
  return p.z >= roundLo(s) && p.z <= roundHi(s) && p.rho <= radiusAt(s, p.z);
}

/// Point of the half plane, \p rho from the axis in the direction of the grain.
GPUDEM_HD Vec3<double> fromAxis(const RegionShape &s, const AxialPlace &p, double rho, double z)
{
  Vec3<double> at = s.centre;
  if (p.rho > 0.0) at += p.arm * (rho / p.rho);
  at[s.axis] = z;
  return at;
}
/// Height of the point of the curved face that is nearest to the grain.
GPUDEM_HD double curvedHeight(const RegionShape &s, const AxialPlace &p)
{
  if (s.kind == RegionKind::Cylinder) return clampTo(p.z, roundLo(s), roundHi(s));
  const double rise = roundHi(s) - roundLo(s), widening = s.radiusHi - s.radius;
  const double along =
      ((p.z - roundLo(s)) * rise + (p.rho - s.radius) * widening) / (rise * rise + widening * widening);
  return along <= 0.0 ? roundLo(s) : along >= 1.0 ? roundHi(s) : roundLo(s) + along * rise;
}

GPUDEM_HD int roundFromInside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  const AxialPlace p = axialPlace(s, x);
  if (!roundContains(s, p)) return 0;
  int n = 0;
  if (p.rho > 0.0 && !isOpen(s, 2)) {
    const double z = curvedHeight(s, p), radius = radiusAt(s, z);
    const Vec3<double> at = fromAxis(s, p, radius, z);
    if (squaredDistance(x, at) < reach * reach) point[n++] = {at, -2.0 * radius, 2};
  }
  for (int end = 0; end < 2; ++end) {
    const double z = end ? roundHi(s) : roundLo(s);
    if (isOpen(s, end) || absolute(p.z - z) >= reach) continue;
    point[n] = {x, 0.0, end};
    point[n++].at[s.axis] = z;
  }
  return n;
}

/// Nearest point of the closed faces. A rim belongs to the curved face, and is hollow for a grain within it.
GPUDEM_HD int roundFromOutside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  const AxialPlace p = axialPlace(s, x);
  const double lo = roundLo(s), hi = roundHi(s);
  if (p.z <= lo - reach || p.z >= hi + reach) return 0;
  if (p.z > lo && p.z < hi && p.rho < radiusAt(s, p.z)) return 0;
  double least = reach * reach;
  int n = 0;
  if (p.rho > 0.0 && !isOpen(s, 2)) {
    const double z = curvedHeight(s, p), radius = radiusAt(s, z);
    const Vec3<double> at = fromAxis(s, p, radius, z);
    const double d2 = squaredDistance(x, at);
    if (d2 < least) {
      least = d2;
      point[0] = {at, p.rho < radius ? -2.0 * radius : 2.0 * radius, 0};
      n = 1;
    }
  }
  for (int end = 0; end < 2; ++end) {
    const double z = end ? hi : lo, rim = radiusAt(s, z);
    if (isOpen(s, end)) continue;
    Vec3<double> at = x;
    if (p.rho > rim) at = fromAxis(s, p, rim, z);
    at[s.axis] = z;
    const double d2 = squaredDistance(x, at);
    if (d2 >= least) continue;
    least = d2;
    point[0] = {at, 0.0, 0};
    n = 1;
  }
  return n;
}

/// Distance to the nearest of the faces, open or not.
GPUDEM_HD double roundDistance(const RegionShape &s, const Vec3<double> &x)
{
  const AxialPlace p = axialPlace(s, x);
  const double z = curvedHeight(s, p), aside = p.rho - radiusAt(s, z), along = p.z - z;
  double least2 = aside * aside + along * along;
  for (int end = 0; end < 2; ++end) {
    const double height = p.z - (end ? roundHi(s) : roundLo(s)), rim = end ? radiusAt(s, roundHi(s)) : s.radius;
    const double beyond = p.rho > rim ? p.rho - rim : 0.0;
    const double d2 = height * height + beyond * beyond;
    if (d2 < least2) least2 = d2;
  }
  return squareRoot(least2);
}

}  // namespace gpudem
