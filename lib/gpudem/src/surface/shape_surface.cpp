// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Bodies of simple shape as triangles whose corners lie on the exact surface.
#include "gpudem/surface.h"

#include "base/vec3.hpp"
#include "surface/combined_shape.hpp"
#include "surface/shape_parse.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace gpudem {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double mostTriangles = 2e7;
using Parsed = ParsedShape;

/// How long facets may be.
struct Resolution {
  double spacing, chord;  ///< see shapeSurface()

  /// Facets along \p length of curvature 1/\p radius.
  int curved(const Parsed &p, double length, double radius) const
  {
    const double facet = spacing > 0.0 ? spacing : std::sqrt(8.0 * radius * chord);
    if (!(facet > 0.0)) p.refuse("it needs the longest length of a facet, keyword spacing");
    return count(p, std::max(12.0, std::ceil(length / facet)));
  }
  /// Facets along a straight line.
  int straight(const Parsed &p, double length) const
  {
    return spacing > 0.0 ? count(p, std::max(1.0, std::ceil(length / spacing))) : 1;
  }
  static int count(const Parsed &p, double n)
  {
    if (n > mostTriangles) p.refuse("spacing is too small: it would take more than 20 million triangles");
    return static_cast<int>(n);
  }
};

using Place = std::function<Vec3<double>(double, double)>;

void addTriangle(SurfaceMesh &m, const Vec3<double> &a, const Vec3<double> &b, const Vec3<double> &c)
{
  const auto same = [](const Vec3<double> &p, const Vec3<double> &q) { return dot(p - q, p - q) == 0.0; };
  if (same(a, b) || same(b, c) || same(c, a)) return;  // at the tip of a cone, in the middle of a disc
  const auto n = static_cast<std::uint32_t>(m.vertex.size());
  for (const Vec3<double> &p : {a, b, c}) m.vertex.push_back({p.x, p.y, p.z});
  m.triangle.push_back({n, n + 1, n + 2});
  m.zone.push_back(0);
}

/// at(u, v) for u and v from 0 to 1, in nu x nv pieces.
void addGrid(const Parsed &p, SurfaceMesh &m, int nu, int nv, const Place &at)
{
  if (2.0 * nu * nv + static_cast<double>(m.triangle.size()) > mostTriangles)
    p.refuse("spacing is too small: it would take more than 20 million triangles");
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const auto corner = [&](int a, int b) { return at(static_cast<double>(a) / nu, static_cast<double>(b) / nv); };
      const Vec3<double> a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
      addTriangle(m, a, b, c);
      addTriangle(m, a, c, d);
    }
}

/// Unit vector at a fraction of the whole circle; the ends are the same to the last bit.
Vec3<double> onCircle(double u)
{
  const double angle = 2.0 * pi * (u < 1.0 ? u : 0.0);
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// Coordinates with z along \p axis to those of the scene, in cyclic order.
Vec3<double> about(int axis, const Vec3<double> &p)
{
  return axis == 0 ? Vec3<double>{p.z, p.x, p.y} : axis == 1 ? Vec3<double>{p.y, p.z, p.x} : p;
}
/// c1 and c2 of a cylinder as LAMMPS orders them, (y,z), (x,z) or (x,y), and the place along the axis.
Vec3<double> placed(int axis, double c1, double c2, double along)
{
  return axis == 0   ? Vec3<double>{along, c1, c2}
         : axis == 1 ? Vec3<double>{c1, along, c2}
                     : Vec3<double>{c1, c2, along};
}

void addBox(const Parsed &p, const Resolution &r, SurfaceMesh &m)
{
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const auto at = [&](int axis, double u) {
      const auto k = static_cast<std::size_t>(2 * axis);
      return u < 1.0 ? p.value[k] + u * (p.value[k + 1] - p.value[k]) : p.value[k + 1];
    };
    const auto pieces = [&](int axis) { return r.straight(p, at(axis, 1.0) - at(axis, 0.0)); };
    for (const double side : {0.0, 1.0})
      addGrid(p, m, pieces(e), pieces(f), [&](double u, double v) {
        Vec3<double> x;
        x[d] = at(d, side);
        x[e] = at(e, u);
        x[f] = at(f, v);
        return x;
      });
  }
}

/// An icosahedron whose faces are cut into equal triangles, with all corners moved to the sphere.
void addSphere(const Parsed &p, const Resolution &r, SurfaceMesh &m)
{
  const Vec3<double> centre{p.value[0], p.value[1], p.value[2]};
  const double radius = p.value[3], edge = std::acos(1.0 / std::sqrt(5.0)) * radius;
  // the corners of the pieces lie 1.18 times as far apart in the middle of a face
  const int n = std::max(2, (r.curved(p, 12.0 * 1.18 * edge, radius) + 11) / 12);
  if (20.0 * n * n > mostTriangles) p.refuse("spacing is too small: it would take more than 20 million triangles");
  std::vector<Vec3<double>> corner{{0.0, 0.0, 1.0}};
  const double height = 1.0 / std::sqrt(5.0);
  for (int k = 0; k < 10; ++k) {
    const double sign = k < 5 ? 1.0 : -1.0, angle = 2.0 * pi * (k % 5 + (k < 5 ? 0.0 : 0.5)) / 5.0;
    corner.push_back({2.0 * height * std::cos(angle), 2.0 * height * std::sin(angle), sign * height});
  }
  corner.push_back({0.0, 0.0, -1.0});
  const auto face = [&](int a, int b, int c) {
    const auto at = [&](int i,
                        int j) {  // the same sum from both sides of an edge, but for rounding, which welding mends
      const Vec3<double> x = corner[static_cast<std::size_t>(a)] * static_cast<double>(n - i - j) +
                             corner[static_cast<std::size_t>(b)] * static_cast<double>(i) +
                             corner[static_cast<std::size_t>(c)] * static_cast<double>(j);
      return centre + x * (radius / std::sqrt(dot(x, x)));
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        addTriangle(m, at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) addTriangle(m, at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  };
  for (int k = 0; k < 5; ++k) {
    const int next = (k + 1) % 5;
    face(0, 1 + k, 1 + next);
    face(1 + k, 6 + k, 1 + next);
    face(1 + next, 6 + k, 6 + next);
    face(11, 6 + next, 6 + k);
  }
}

/// A frustum between the radii \p low at lo and \p high at hi, with its ends.
void addFrustum(const Parsed &p, const Resolution &r, double low, double high, double lo, double hi, SurfaceMesh &m)
{
  const int axis = static_cast<int>(p.value[0]);
  const double widest = std::max(low, high), slant = std::hypot(hi - lo, high - low);
  const int n = r.curved(p, 2.0 * pi * widest, widest);
  const auto ring = [&](double u, double radius, double along) {
    const Vec3<double> c = onCircle(u) * radius;
    return placed(axis, p.value[1] + c.x, p.value[2] + c.y, along);
  };
  addGrid(p, m, n, r.straight(p, slant), [&](double u, double v) {
    return ring(u, v < 1.0 ? low + v * (high - low) : high, v < 1.0 ? lo + v * (hi - lo) : hi);
  });
  for (const auto &[radius, along] : {std::pair{low, lo}, {high, hi}})
    if (radius > 0.0)
      addGrid(p, m, n, r.straight(p, radius), [&, radius = radius, along = along](double u, double v) {
        return ring(v > 0.0 ? u : 0.0, v < 1.0 ? v * radius : radius, along);
      });
}

void addTorus(const Parsed &p, const Resolution &r, SurfaceMesh &m)
{
  const Vec3<double> centre{p.value[1], p.value[2], p.value[3]};
  const double ring = p.value[4], tube = p.value[5], outer = ring + tube;
  addGrid(p, m, r.curved(p, 2.0 * pi * outer, outer), r.curved(p, 2.0 * pi * tube, tube), [&](double u, double v) {
    const Vec3<double> around = onCircle(u), c = onCircle(v);
    Vec3<double> x = around * (ring + tube * c.x);
    x.z = tube * c.y;
    return centre + about(static_cast<int>(p.value[0]), x);
  });
}

void addPlane(const Parsed &p, const Resolution &r, SurfaceMesh &m)
{
  const Vec3<double> centre{p.value[0], p.value[1], p.value[2]}, given{p.value[3], p.value[4], p.value[5]};
  const double half = p.value[6];
  const Vec3<double> n = given * (1.0 / std::sqrt(dot(given, given)));
  int least = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) < std::abs(n[least])) least = d;
  Vec3<double> e{0.0, 0.0, 0.0};
  e[least] = 1.0;
  Vec3<double> u = e - n * dot(e, n);
  u = u * (half / std::sqrt(dot(u, u)));
  const Vec3<double> v = cross(n, u);
  const int pieces = r.straight(p, 2.0 * half);
  addGrid(p, m, pieces, pieces, [&](double a, double b) { return centre + u * (2.0 * a - 1.0) + v * (2.0 * b - 1.0); });
}

}  // namespace

SurfaceMesh shapeSurface(const std::string &shape, double spacing, double chord)
{
  const Parsed p = parseShape(shape);
  if (p.combined()) return combinedSurface(p, spacing);
  const Resolution r{spacing, chord};
  SurfaceMesh m;
  m.zoneName.push_back(p.name);
  if (p.name == "box") addBox(p, r, m);
  if (p.name == "sphere") addSphere(p, r, m);
  if (p.name == "cylinder") addFrustum(p, r, p.value[3], p.value[3], p.value[4], p.value[5], m);
  if (p.name == "cone") addFrustum(p, r, p.value[3], p.value[4], p.value[5], p.value[6], m);
  if (p.name == "torus") addTorus(p, r, m);
  if (p.name == "plane") addPlane(p, r, m);
  return m;
}

}  // namespace gpudem
