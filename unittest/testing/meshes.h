// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Meshes of simple shapes, and the nearest point by trying all triangles.
#pragma once

#include "gpudem/surface.h"
#include "surface/surface_contacts.hpp"
#include "testing/tolerance.h"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace gpudem::testing {

using Point = std::array<double, 3>;

inline void addTriangle(SurfaceMesh &m, const Point &a, const Point &b, const Point &c)
{
  const auto n = static_cast<std::uint32_t>(m.vertex.size());
  m.vertex.insert(m.vertex.end(), {a, b, c});
  m.triangle.push_back({n, n + 1, n + 2});
  m.zone.push_back(0);
}

/// Quads of a grid u x v, each cut into two triangles; \p alternate chooses the diagonal.
inline SurfaceMesh gridMesh(int nu, int nv, const std::function<Point(double, double)> &at, bool alternate = false)
{
  SurfaceMesh m;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const auto p = [&](int a, int b) { return at(static_cast<double>(i + a) / nu, static_cast<double>(j + b) / nv); };
      if (alternate && (i + j) % 2) {
        addTriangle(m, p(0, 0), p(1, 0), p(0, 1));
        addTriangle(m, p(1, 0), p(1, 1), p(0, 1));
      } else {
        addTriangle(m, p(0, 0), p(1, 0), p(1, 1));
        addTriangle(m, p(0, 0), p(1, 1), p(0, 1));
      }
    }
  return m;
}

inline void append(SurfaceMesh &m, const SurfaceMesh &o)
{
  for (const auto &t : o.triangle) addTriangle(m, o.vertex[t[0]], o.vertex[t[1]], o.vertex[t[2]]);
}

/// Rectangle from \p corner along \p u and \p v, normal u x v, of n x n quads.
inline SurfaceMesh rectangle(const Point &corner, const Point &u, const Point &v, int n = 1)
{
  return gridMesh(n, n, [&](double a, double b) {
    Point p;
    for (std::size_t d = 0; d < 3; ++d) p[d] = corner[d] + a * u[d] + b * v[d];
    return p;
  });
}

/// Box [0,a]^3 with outward normals.
inline SurfaceMesh cube(double a, int n = 1)
{
  SurfaceMesh m = rectangle({0, 0, 0}, {0, a, 0}, {a, 0, 0}, n);
  append(m, rectangle({0, 0, a}, {a, 0, 0}, {0, a, 0}, n));
  append(m, rectangle({0, 0, 0}, {a, 0, 0}, {0, 0, a}, n));
  append(m, rectangle({0, a, 0}, {0, 0, a}, {a, 0, 0}, n));
  append(m, rectangle({0, 0, 0}, {0, 0, a}, {0, a, 0}, n));
  append(m, rectangle({a, 0, 0}, {0, a, 0}, {0, 0, a}, n));
  return m;
}

/// Sphere around the origin with outward normals: the poles are vertices.
inline SurfaceMesh ball(double radius, int n)
{
  return gridMesh(2 * n, n, [&](double a, double b) {
    const double phi = 2.0 * M_PI * a, theta = M_PI * b;
    return Point{radius * std::sin(theta) * std::cos(phi), -radius * std::sin(theta) * std::sin(phi),
                 radius * std::cos(theta)};
  });
}

/// Tube around the z axis, 0 < z < length, of \p n facets, open at its ends.
inline SurfaceMesh tube(double radius, double length, int n, int rings = 1)
{
  return gridMesh(n, rings, [&](double a, double b) {
    const double phi = 2.0 * M_PI * a;
    return Point{radius * std::cos(phi), radius * std::sin(phi), length * b};
  });
}

/// Turned about an axis that is none of the mesh's, and moved.
inline Vec3<double> tilted(const Vec3<double> &p)
{
  const Vec3<double> axis{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return p * c + cross(axis, p) * s + axis * (dot(axis, p) * (1.0 - c)) + Vec3<double>{0.3, -0.2, 0.11};
}
inline void tilt(SurfaceMesh &m)
{
  for (Point &p : m.vertex) {
    const Vec3<double> q = tilted({p[0], p[1], p[2]});
    p = {q.x, q.y, q.z};
  }
}

inline double bruteDistance(const SurfaceMesh &m, const Vec3<double> &x)
{
  double least = INFINITY;
  for (const auto &t : m.triangle) {
    const auto corner = [&](std::size_t c) {
      const Point &p = m.vertex[t[c]];
      return Vec3<double>{p[0], p[1], p[2]} - x;
    };
    const TrianglePoint p = nearestPoint(corner(0), corner(1), corner(2));
    least = std::min(least, std::sqrt(dot(p.branch, p.branch)));
  }
  return least;
}

inline SurfaceContacts contactsAt(const Surface &s, const Vec3<double> &x, double radius)
{
  SurfaceContacts out;
  surfaceContacts(s.view(), x, radius, out);
  return out;
}

/// Sum of the elastic forces of unit stiffness on a sphere (distance).
inline Vec3<double> unitForce(const SurfaceContacts &c, double radius)
{
  Vec3<double> f{0.0, 0.0, 0.0};
  for (int k = 0; k < c.count; ++k) f += c.contact[k].normal * (c.contact[k].weight * (radius - c.contact[k].distance));
  return f;
}

inline double length(const Vec3<double> &v)
{
  return std::sqrt(dot(v, v));
}

class Random {
 public:
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine_); }
  Vec3<double> inCube(double lo, double hi) { return {between(lo, hi), between(lo, hi), between(lo, hi)}; }

 private:
  std::mt19937_64 engine_{20260704};
};

}  // namespace gpudem::testing
