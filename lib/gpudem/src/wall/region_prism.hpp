// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Prism of a region: the parallelepiped with edges (lx, 0, 0), (xy, ly, 0) and (xz, yz, lz).
#pragma once

#include "wall/region_shape.hpp"

namespace gpudem {

/// Edge 0, 1 or 2 of the prism.
GPUDEM_HD Vec3<double> prismEdge(const RegionShape &s, int k)
{
  const Vec3<double> length = s.hi - s.lo;
  return k == 0   ? Vec3<double>{length.x, 0.0, 0.0}
         : k == 1 ? Vec3<double>{s.tilt.x, length.y, 0.0}
                  : Vec3<double>{s.tilt.y, s.tilt.z, length.z};
}

/// A face: one of its corners, the unit normal inwards, and its two edges.
struct PrismFace {
  Vec3<double> corner, normal, first, second;
};
/// Faces 2k and 2k + 1 are spanned by the edges other than 2 - k.
GPUDEM_HD PrismFace prismFace(const RegionShape &s, int face)
{
  const int across = 2 - face / 2;
  PrismFace f;
  f.first = prismEdge(s, (across + 1) % 3);
  f.second = prismEdge(s, (across + 2) % 3);
  f.corner = s.lo;
  f.normal = cross(f.first, f.second);
  f.normal = f.normal * (1.0 / squareRoot(dot(f.normal, f.normal)));
  if (face & 1) {
    f.corner += prismEdge(s, across);
    f.normal = f.normal * -1.0;
  }
  return f;
}
GPUDEM_HD double prismDepth(const PrismFace &f, const Vec3<double> &x)
{
  return dot(x - f.corner, f.normal);
}

/// Least depth below the six faces: negative outside.
GPUDEM_HD double prismLeastDepth(const RegionShape &s, const Vec3<double> &x)
{
  double least = 1.0e300;
  for (int face = 0; face < 6; ++face) {
    const double depth = prismDepth(prismFace(s, face), x);
    if (depth < least) least = depth;
  }
  return least;
}

GPUDEM_HD int prismFromInside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  if (prismLeastDepth(s, x) < 0.0) return 0;
  int n = 0;
  for (int face = 0; face < 6; ++face) {
    const PrismFace f = prismFace(s, face);
    const double depth = prismDepth(f, x);
    if (!isOpen(s, face) && depth < reach) point[n++] = {x - f.normal * depth, 0.0, face};
  }
  return n;
}

GPUDEM_HD Vec3<double> nearestOnSegment(const Vec3<double> &a, const Vec3<double> &edge, const Vec3<double> &x)
{
  return a + edge * clampTo(dot(x - a, edge) / dot(edge, edge), 0.0, 1.0);
}

GPUDEM_HD Vec3<double> nearestOnFace(const PrismFace &f, const Vec3<double> &x)
{
  const Vec3<double> foot = x - f.normal * prismDepth(f, x), from = foot - f.corner;
  // coordinates along the edges, times the squared area
  const Vec3<double> n = cross(f.first, f.second);
  const double u = dot(cross(from, f.second), n), v = dot(cross(f.first, from), n), whole = dot(n, n);
  if (u >= 0.0 && u <= whole && v >= 0.0 && v <= whole) return foot;
  Vec3<double> best = nearestOnSegment(f.corner, f.first, x);
  const Vec3<double> others[3] = {nearestOnSegment(f.corner, f.second, x),
                                  nearestOnSegment(f.corner + f.first, f.second, x),
                                  nearestOnSegment(f.corner + f.second, f.first, x)};
  for (const Vec3<double> &p : others)
    if (squaredDistance(x, p) < squaredDistance(x, best)) best = p;
  return best;
}

GPUDEM_HD int prismFromOutside(const RegionShape &s, const Vec3<double> &x, double reach, SurfacePoint *point)
{
  const double depth = prismLeastDepth(s, x);
  if (depth > 0.0 || depth <= -reach) return 0;
  double least = reach * reach;
  int n = 0;
  for (int face = 0; face < 6; ++face) {
    if (isOpen(s, face)) continue;
    const Vec3<double> at = nearestOnFace(prismFace(s, face), x);
    const double d2 = squaredDistance(x, at);
    if (d2 >= least) continue;
    least = d2;
    point[0] = {at, 0.0, 0};
    n = 1;
  }
  return n;
}

}  // namespace gpudem
