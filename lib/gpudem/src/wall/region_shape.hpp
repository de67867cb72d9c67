// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Parts of a region as the device sees them, where they are, and the flat shapes among them.
///
/// Conventions of LAMMPS 29 Sep 2021 (region.cpp): a shape is a closed set; from inside each closed face touches a
/// grain by its plane, from outside the nearest point of the closed faces does.
#pragma once

#include "base/real.hpp"
#include "base/vec3.hpp"
#include "gpudem/scene.h"

#include <cstdint>

namespace gpudem {

/// RegionPart with what follows from its place in the tree.
struct RegionShape {
  RegionKind kind;
  int size, parent;         ///< parts of the subtree; index of the union or intersection it belongs to, -1 if none
  bool inside, open;        ///< as in RegionPart
  bool listsInside;         ///< contacts are those from inside, once the sides of all above it are considered
  bool moves, rotates;      ///< the place of the surface changes
  bool turns;               ///< the surface has a velocity of rotation, perhaps without changing its place
  std::uint32_t openFaces;  ///< bit per face
  int order, members;       ///< place among the members of the parent; number of own members
  int numberOffset;         ///< faces of the members before it
  int axis;
  Vec3<double> lo, hi, tilt, centre, normal;
  double radius, radiusHi;
  Vec3<double> pivot, pivotAxis;
};

/// Where a part is at the step being evaluated.
struct PartState {
  Vec3<double> displacement, velocity;  ///< (distance), (distance/time)
  double cosine, sine;                  ///< of the angle
  double angularVelocity;               ///< (radian/time)
};

/// Point of a face that touches a grain.
struct SurfacePoint {
  Vec3<double> at;   ///< (distance)
  double curvature;  ///< 0 flat; else the signed radius that enters R_eff, negative where concave (distance)
  int face;
};
constexpr int maxSurfacePoints = 6;  ///< of one shape

GPUDEM_HD bool isOpen(const RegionShape &s, int face)
{
  return (s.openFaces >> face & 1u) != 0;
}
GPUDEM_HD double squaredDistance(const Vec3<double> &a, const Vec3<double> &b)
{
  const Vec3<double> d = a - b;
  return dot(d, d);
}
GPUDEM_HD double clampTo(double x, double lo, double hi)
{
  return x < lo ? lo : x > hi ? hi : x;
}

// block

GPUDEM_HD bool blockContains(const RegionShape &s, const Vec3<double> &x)
{
  bool in = true;
  for (int d = 0; d < 3; ++d) in = in && x[d] >= s.lo[d] && x[d] <= s.hi[d];
  return in;
}

GPUDEM_HD int blockFromInside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  if (!blockContains(s, x)) return 0;
  int n = 0;
  for (int face = 0; face < 6; ++face) {
    const int d = face / 2;
    const double plane = face & 1 ? s.hi[d] : s.lo[d];
    if (isOpen(s, face) || absolute(x[d] - plane) >= reach) continue;
    point[n] = {x, 0.0, face};
    point[n++].at[d] = plane;
  }
  return n;
}

GPUDEM_HD int blockFromOutside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  bool within = true;
  for (int d = 0; d < 3; ++d) {
    if (x[d] <= s.lo[d] - reach || x[d] >= s.hi[d] + reach) return 0;
    within = within && x[d] > s.lo[d] && x[d] < s.hi[d];
  }
  if (within) return 0;
  Vec3<double> nearest;
  for (int d = 0; d < 3; ++d) nearest[d] = clampTo(x[d], s.lo[d], s.hi[d]);
  double least = reach * reach;
  int n = 0;
  for (int face = 0; face < 6; ++face) {
    Vec3<double> at = nearest;
    at[face / 2] = face & 1 ? s.hi[face / 2] : s.lo[face / 2];
    const double d2 = squaredDistance(x, at);
    if (isOpen(s, face) || d2 >= least) continue;
    least = d2;
    point[0] = {at, 0.0, 0};
    n = 1;
  }
  return n;
}

/// Distance to the nearest of the faces, open or not.
GPUDEM_HD double blockDistance(const RegionShape &s, const Vec3<double> &x)
{
  double least = 1.0e300, beyond2 = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double above = x[d] - s.lo[d], below = s.hi[d] - x[d];
    const double nearer = above < below ? above : below;
    if (nearer < 0.0) beyond2 += nearer * nearer;
    if (nearer < least) least = nearer;
  }
  return beyond2 > 0.0 ? squareRoot(beyond2) : least;
}

// sphere

GPUDEM_HD int spherePoint(const RegionShape &s, const Vec3<double> &x, double reach, bool fromInside,
                          SurfacePoint *point)
{
  const Vec3<double> arm = x - s.centre;
  const double r = squareRoot(dot(arm, arm)), depth = fromInside ? s.radius - r : r - s.radius;
  if (depth < 0.0 || depth >= reach || r == 0.0) return 0;
  point[0] = {s.centre + arm * (s.radius / r), fromInside ? -s.radius : s.radius, 0};
  return 1;
}

// plane

GPUDEM_HD double planeHeight(const RegionShape &s, const Vec3<double> &x)
{
  return dot(x - s.centre, s.normal);
}
GPUDEM_HD int planePoint(const RegionShape &s, const Vec3<double> &x, double reach, bool fromInside,
                         SurfacePoint *point)
{
  const double height = planeHeight(s, x), depth = fromInside ? height : -height;
  if (depth < 0.0 || depth >= reach) return 0;
  point[0] = {x - s.normal * height, 0.0, 0};
  return 1;
}

}  // namespace gpudem
