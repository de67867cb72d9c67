// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Built-in shapes: closed, corners on the exact surface, errors of second order, and what is said about a bad one.
#include "testing/meshes.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace gpudem::testing {
namespace {

using Distance = std::function<double(const Vec3<double> &)>;

double fromTube(double rho, double z, double radius, double lo, double hi)
{
  const double side = rho - radius, end = std::max(lo - z, z - hi);
  return side > 0.0 && end > 0.0 ? std::hypot(side, end) : std::max(side, end);
}

struct Case {
  const char *shape;
  double volume, area;
  Distance distance;  ///< exact, negative inside
  double radius;      ///< smallest radius of curvature, 0: flat
};

const Case cases[] = {
    {"box(-1,2,0.5,1.5,-3,-1)", 6.0, 22.0,
     [](const Vec3<double> &x) {
       const double a = std::max(-1 - x.x, x.x - 2), b = std::max(0.5 - x.y, x.y - 1.5), c = std::max(-3 - x.z, x.z + 1);
       const double out = std::hypot(std::max(a, 0.0), std::max(b, 0.0), std::max(c, 0.0));
       return out > 0.0 ? out : std::max({a, b, c});
     },
     0.0},
    {"sphere( 1, -2, 0.5, 1.5)", 4.0 / 3.0 * M_PI * 3.375, 4.0 * M_PI * 2.25,
     [](const Vec3<double> &x) { return length(x - Vec3<double>{1.0, -2.0, 0.5}) - 1.5; }, 1.5},
    {"cylinder(y,1,2,0.75,-1,3)", M_PI * 0.5625 * 4.0, 2.0 * M_PI * 0.75 * 4.75,
     [](const Vec3<double> &x) { return fromTube(std::hypot(x.x - 1, x.z - 2), x.y, 0.75, -1, 3); }, 0.75},
    {"cone(x,0,0,2,0,0,4)", M_PI * 4.0 * 4.0 / 3.0, M_PI * 2.0 * (2.0 + std::sqrt(20.0)), nullptr, 2.0},
    {"cone(z,0,0,1,2,0,4)", M_PI * 4.0 / 3.0 * 7.0, M_PI * (5.0 + 3.0 * std::sqrt(17.0)), nullptr, 2.0},
    {"torus(x,0,1,0,2,0.5)", 2.0 * M_PI * M_PI * 2.0 * 0.25, 4.0 * M_PI * M_PI,
     [](const Vec3<double> &x) { return std::hypot(std::hypot(x.y - 1, x.z) - 2.0, x.x) - 0.5; }, 0.5},
};

double longestSide(const SurfaceMesh &m, std::uint32_t k)
{
  double longest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Point &a = m.vertex[m.triangle[k][c]], &b = m.vertex[m.triangle[k][(c + 1) % 3]];
    longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return longest;
}

TEST(ShapeSurface, IsClosedAndNearTheExactOneToSecondOrder)
{
  for (const Case &c : cases) {
    SCOPED_TRACE(c.shape);
    double before = 0.0;
    for (const double spacing : {0.2, 0.1, 0.05}) {
      SurfaceMesh m = shapeSurface(c.shape, spacing, 0.0);
      const MeshReport report = cleanSurface(m);
      EXPECT_TRUE(report.closed()) << report.text();
      EXPECT_EQ(report.bodies, 1u);
      EXPECT_TRUE(report.defects.empty()) << report.text();
      for (std::uint32_t k = 0; k < m.triangle.size(); ++k) EXPECT_LE(longestSide(m, k), std::sqrt(2.0) * spacing * (1.0 + 1e-9));
      const double lost = c.volume - report.volume;
      std::printf("%s, spacing %g: volume %.2e too small, %zu triangles\n", c.shape, spacing, lost / c.volume, m.triangle.size());
      EXPECT_GE(lost, -shapeRoundOff * c.volume);  // corners lie on a convex surface, or the torus' outside wins
      if (c.radius == 0.0) {
        EXPECT_LE(lost, shapeRoundOff * c.volume);
        EXPECT_NEAR(report.area, c.area, shapeRoundOff * c.area);
      } else {
        EXPECT_LE(lost, c.volume * spacing * spacing / (c.radius * c.radius));
        if (before > 0.0) EXPECT_NEAR(std::log2(before / lost), 2.0, 0.35);
        EXPECT_NEAR(report.area, c.area, c.area * spacing * spacing / (c.radius * c.radius));
        before = lost;
      }
      if (!c.distance) continue;
      // a quad is two triangles: its diagonal counts
      const double sagitta = c.radius > 0.0 ? 2.0 * spacing * spacing / (8.0 * c.radius) : 0.0;
      for (const Point &p : m.vertex) EXPECT_NEAR(c.distance({p[0], p[1], p[2]}), 0.0, shapeRoundOff);
      for (const auto &t : m.triangle) {
        Vec3<double> middle{0.0, 0.0, 0.0};
        for (const std::uint32_t v : t) middle = middle + Vec3<double>{m.vertex[v][0], m.vertex[v][1], m.vertex[v][2]} * (1.0 / 3.0);
        EXPECT_NEAR(c.distance(middle), 0.0, sagitta + shapeRoundOff);
      }
    }
  }
}

TEST(ShapeSurface, ChordsStayWithinTheGivenOne)
{
  for (const double chord : {1e-2, 1e-3, 1e-4}) {
    SurfaceMesh m = shapeSurface("sphere(0,0,0,1)", 0.0, chord);
    cleanSurface(m);
    double deepest = 0.0;
    for (const auto &t : m.triangle) {
      Vec3<double> middle{0.0, 0.0, 0.0};
      for (const std::uint32_t v : t) middle = middle + Vec3<double>{m.vertex[v][0], m.vertex[v][1], m.vertex[v][2]} * (1.0 / 3.0);
      deepest = std::max(deepest, 1.0 - length(middle));
    }
    EXPECT_LE(deepest, 1.5 * chord);  // the middle of a triangle is 4/3 as far from its corners as that of a side
    EXPECT_GE(deepest, 0.2 * chord);
  }
  EXPECT_EQ(shapeSurface("box(0,1,0,1,0,1)", 0.0, 0.0).triangle.size(), 12u);
}

TEST(ShapeSurface, APlaneIsASquareSheet)
{
  SurfaceMesh m = shapeSurface("plane(1,2,3,1,1,0,5)", 0.0, 0.0);
  const MeshReport report = cleanSurface(m);
  EXPECT_EQ(m.triangle.size(), 2u);
  EXPECT_NEAR(report.area, 100.0, 100.0 * shapeRoundOff);
  for (const Point &p : m.vertex) EXPECT_NEAR((p[0] - 1.0) + (p[1] - 2.0), 0.0, shapeRoundOff);
  EXPECT_FALSE(report.closed());
}

TEST(ShapeSurface, NamesWhatIsWrong)
{
  const auto said = [](const char *shape, double spacing = 0.1) {
    try {
      shapeSurface(shape, spacing, 0.0);
    } catch (const Error &e) {
      return std::string(e.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(said("ball(0,0,0,1)"), "shape 'ball(0,0,0,1)': 'ball' is no shape; there are box, sphere, cylinder, cone, torus and plane, and their union, intersection and difference");
  EXPECT_EQ(said("sphere(0,0,1)"), "shape 'sphere(0,0,1)': sphere takes 4 values (x, y, z, radius), not 3");
  EXPECT_EQ(said("sphere(0,0,zero,1)"), "shape 'sphere(0,0,zero,1)': 'zero' stands where z is expected, a number");
  EXPECT_EQ(said("sphere(0,0,0,-1)"), "shape 'sphere(0,0,0,-1)': the radius is -1, it must be above 0");
  EXPECT_EQ(said("cylinder(w,0,0,1,0,1)"), "shape 'cylinder(w,0,0,1,0,1)': the axis is x, y or z, not 'w'");
  EXPECT_EQ(said("box(0,1,1,1,0,1)"), "shape 'box(0,1,1,1,0,1)': the lower end in y is 1, it must be below the upper one, 1");
  EXPECT_EQ(said("cone(z,0,0,0,0,0,1)"), "shape 'cone(z,0,0,0,0,0,1)': its radii must not be negative, and one of them above 0");
  EXPECT_EQ(said("torus(z,0,0,0,1,1)"), "shape 'torus(z,0,0,0,1,1)': the tube must be thinner than the ring");
  EXPECT_EQ(said("plane(0,0,0,0,0,0,1)"), "shape 'plane(0,0,0,0,0,0,1)': the normal is a vector of no length");
  EXPECT_EQ(said("sphere(0,0,0,1"), "shape 'sphere(0,0,0,1': it must have the form name(value,value,...)");
  EXPECT_EQ(said("sphere(0,0,0,1)", 0.0), "shape 'sphere(0,0,0,1)': it needs the longest length of a facet, keyword spacing");
  EXPECT_EQ(said("sphere(0,0,0,1)", 1e-9), "shape 'sphere(0,0,0,1)': spacing is too small: it would take more than 20 million triangles");
  EXPECT_TRUE(isShape("box(0,1,0,1,0,1)"));
  EXPECT_FALSE(isShape("drum.stl"));
  EXPECT_FALSE(isShape("meshes/drum(2).stl"));
}

}  // namespace
}  // namespace gpudem::testing
