// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A body of combined shapes as unions and intersections of what lies behind smooth surfaces.
///
/// Ricci, Comput. J. 16 (1973) 157: where each surface has a function that is negative inside, the union of bodies has
/// the least of theirs, the intersection the greatest, and the complement the opposite.
#pragma once

#include "base/vec3.hpp"
#include "surface/shape_parse.hpp"

#include <vector>

namespace gpudem {

/// One smooth surface: a side of a box, the round part of a cylinder.
struct SmoothSurface {
  enum Kind { Plane, Sphere, Cone, Torus } kind;
  Vec3<double> origin, axis;  ///< a point of it or its centre (distance); normal or axis of length 1
  double a = 0.0;             ///< radius, that of the ring, or that at the origin (distance)
  double b = 0.0;  ///< radius of the tube (distance), or what the radius of a cone gains along the axis per length

  struct Value {
    double distance;        ///< signed, negative inside; no more than the true one beyond the tip of a cone (distance)
    Vec3<double> gradient;  ///< of length 1
  };
  Value at(const Vec3<double> &x) const;
};

class SolidTree {
 public:
  struct Value {
    double distance;  ///< negative inside; the nearest surface is at least as far away as its absolute value (distance)
    int surface;      ///< index of the surface whose distance it is
    double sign;      ///< -1 where the body is what lies outside that surface
  };
  explicit SolidTree(const ParsedShape &shape);

  Value at(const Vec3<double> &x) const { return node(0, x); }
  const SmoothSurface &surface(int k) const { return surface_[static_cast<std::size_t>(k)]; }
  const std::vector<Vec3<double>> &tips() const { return tip_; }  ///< of cones
  const Vec3<double> &lo() const { return node_.front().lo; }     ///< box around the body; lo above hi: there is none
  const Vec3<double> &hi() const { return node_.front().hi; }

 private:
  struct Node {
    enum { Simple, Union, Intersection, Difference } kind;
    std::vector<int> member;  ///< surfaces of a simple body, which lies behind all of them, or nodes
    Vec3<double> lo, hi;
  };
  int add(const ParsedShape &shape);
  void addSimple(Node &node, const ParsedShape &shape);
  void addSurface(Node &node, const SmoothSurface &surface);
  Value node(int k, const Vec3<double> &x) const;

  std::vector<Node> node_;  ///< the whole first
  std::vector<SmoothSurface> surface_;
  std::vector<Vec3<double>> tip_;
};

}  // namespace gpudem
