// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The point of a triangle nearest to a centre, and which feature of the triangle it lies on.
#pragma once

#include "base/real.hpp"
#include "base/vec3.hpp"

namespace gpudem {

/// Feature of a triangle: edge k runs from corner k to corner k+1.
enum class Feature { Face = 0, Edge0 = 1, Edge1 = 2, Edge2 = 3, Corner0 = 4, Corner1 = 5, Corner2 = 6 };

struct TrianglePoint {
  Vec3<double> branch;  ///< from the nearest point to the centre (distance)
  Feature feature;
};

/// Nearest point by the Voronoi regions of corners, edges and face in the plane of the triangle (Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5). Arguments are the corners less the centre: what is small stays exact.
GPUDEM_HD TrianglePoint nearestPoint(const Vec3<double> &a, const Vec3<double> &b, const Vec3<double> &c)
{
  const Vec3<double> ab = b - a, ac = c - a, zero{0.0, 0.0, 0.0};
  const double d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0.0 && d2 <= 0.0) return {zero - a, Feature::Corner0};
  const double d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0.0 && d4 <= d3) return {zero - b, Feature::Corner1};
  const double d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0.0 && d5 <= d6) return {zero - c, Feature::Corner2};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {zero - (a + ab * (d1 / (d1 - d3))), Feature::Edge0};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {zero - (b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)))), Feature::Edge1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {zero - (a + ac * (d2 / (d2 - d6))), Feature::Edge2};
  // along the normal, the same for all points of the plane
  const Vec3<double> n = cross(ab, ac);
  return {n * (-dot(n, a) / dot(n, n)), Feature::Face};
}

}  // namespace gpudem
