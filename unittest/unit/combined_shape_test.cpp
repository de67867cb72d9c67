// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Union, intersection and difference of shapes: closed and two-manifold, sharp where bodies meet, errors of
/// second order, and what is said about a bad one.
#include "surface/mesh_edges.hpp"
#include "surface/solid_tree.hpp"
#include "testing/meshes.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace gpudem::testing {
namespace {

using Distance = std::function<double(const Vec3<double> &)>;

Vec3<double> at(const Point &p)
{
  return {p[0], p[1], p[2]};
}

double fromBoxEdges(const Vec3<double> &x, const Vec3<double> &lo, const Vec3<double> &hi)
{
  double off[3];
  for (int d = 0; d < 3; ++d) off[d] = std::min(std::abs(x[d] - lo[d]), std::abs(x[d] - hi[d]));
  std::sort(off, off + 3);
  return std::hypot(off[0], off[1]);
}

struct Case {
  const char *shape;
  double volume, area;
  Distance sharp;  ///< distance from the exact curves where its faces meet
};

const Case cases[] = {
    {"difference(box(-2,2,-2,2,0,1),cylinder(z,0,0,1,-1,2))", 16.0 - M_PI, 2.0 * (16.0 - M_PI) + 16.0 + 2.0 * M_PI,
     [](const Vec3<double> &x) {
       const double rim = std::hypot(std::hypot(x.x, x.y) - 1.0, std::min(std::abs(x.z), std::abs(x.z - 1.0)));
       return std::min(rim, fromBoxEdges(x, {-2, -2, 0}, {2, 2, 1}));
     }},
    {"union(sphere(0,0,0,1),sphere(1,0,0,1))", 9.0 / 4.0 * M_PI, 6.0 * M_PI,
     [](const Vec3<double> &x) { return std::hypot(x.x - 0.5, std::hypot(x.y, x.z) - std::sqrt(0.75)); }},
    {"intersection(box(0,2,0,2,0,2),sphere(0,0,0,1))", M_PI / 6.0, 5.0 / 4.0 * M_PI,
     [](const Vec3<double> &x) {
       double arc = INFINITY;
       for (int d = 0; d < 3; ++d) arc = std::min(arc, std::hypot(x[d], length(x) - 1.0));
       return std::min(arc, fromBoxEdges(x, {0, 0, 0}, {2, 2, 2}));
     }},
    {"difference(union(box(-1,1,-1,1,-1,1),cylinder(x,0,0,0.5,0,2)),sphere(0,0,1,0.75))",
     8.0 + 0.25 * M_PI - 2.0 / 3.0 * M_PI * 0.421875, 24.0 + M_PI + M_PI * 0.5625, nullptr},
};

/// Largest distance from the body of the middles of triangles and of their sides (distance).
double deepest(const SurfaceMesh &m, const char *shape)
{
  const SolidTree body(parseShape(shape));
  double most = 0.0;
  for (const auto &t : m.triangle) {
    const Vec3<double> a = at(m.vertex[t[0]]), b = at(m.vertex[t[1]]), c = at(m.vertex[t[2]]);
    for (const Vec3<double> &x : {(a + b + c) * (1.0 / 3.0), (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5})
      most = std::max(most, std::abs(body.at(x).distance));
  }
  return most;
}

/// Triangles whose inner side is outside the body, a quarter of the spacing away, and whose outer side is inside.
int turnedOver(const SurfaceMesh &m, const std::string &shape, double spacing)
{
  const SolidTree body(parseShape(shape));
  int found = 0;
  for (const auto &t : m.triangle) {
    const Vec3<double> a = at(m.vertex[t[0]]), b = at(m.vertex[t[1]]), c = at(m.vertex[t[2]]), n = cross(b - a, c - a);
    const Vec3<double> middle = (a + b + c) * (1.0 / 3.0), out = n * (0.25 * spacing / length(n));
    found += body.at(middle - out).distance > 0.1 * spacing && body.at(middle + out).distance < -0.1 * spacing;
  }
  return found;
}

void expectManifold(const MeshReport &report)
{
  EXPECT_TRUE(report.closed()) << report.text();
  for (const MeshDefect d : {MeshDefect::OpenEdge, MeshDefect::NonManifold, MeshDefect::Unorientable})
    EXPECT_EQ(report.count(d), 0u) << report.text();
}

TEST(CombinedShape, IsClosedAndNearTheExactOneToSecondOrder)
{
  for (const Case &c : cases) {
    SCOPED_TRACE(c.shape);
    double before = 0.0;
    for (const double spacing : {0.2, 0.1, 0.05}) {
      SurfaceMesh m = shapeSurface(c.shape, spacing, 0.0);
      const MeshReport report = cleanSurface(m);
      expectManifold(report);
      EXPECT_EQ(report.bodies, 1u);
      EXPECT_EQ(report.turned, 0u);  // they point outward as they come
      const double error = std::abs(report.volume / c.volume - 1.0), depth = deepest(m, c.shape);
      std::printf("%s, spacing %g: volume %.2e, area %.2e, depth %.2e, %zu triangles\n", c.shape, spacing,
                  report.volume / c.volume - 1.0, report.area / c.area - 1.0, depth, m.triangle.size());
      EXPECT_LE(error, 0.8 * spacing * spacing);
      EXPECT_NEAR(report.area, c.area, 0.8 * c.area * spacing * spacing);
      EXPECT_LE(depth, 0.75 * spacing * spacing);
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / error), 2.0, 0.35);
      }
      before = error;
    }
  }
}

/// Corners of all sides whose two triangles differ by more than 30 degrees.
std::vector<Vec3<double>> creases(const SurfaceMesh &m)
{
  const auto normal = [&](std::uint32_t k) {
    const auto &t = m.triangle[k];
    const Vec3<double> n = cross(at(m.vertex[t[1]]) - at(m.vertex[t[0]]), at(m.vertex[t[2]]) - at(m.vertex[t[0]]));
    return n * (1.0 / length(n));
  };
  std::vector<Vec3<double>> found;
  forEachEdge(edgeUses(m), [&](const EdgeUse *first, const EdgeUse *last) {
    ASSERT_EQ(last - first, 2);
    if (dot(normal(first[0].triangle), normal(first[1].triangle)) > std::cos(M_PI / 6.0)) return;
    found.push_back(at(m.vertex[first->low]));
    found.push_back(at(m.vertex[first->high]));
  });
  return found;
}

TEST(CombinedShape, EdgesLieWhereTheBodiesMeet)
{
  for (const Case &c : cases) {
    if (!c.sharp) continue;
    SCOPED_TRACE(c.shape);
    SurfaceMesh m = shapeSurface(c.shape, 0.05, 0.0);
    cleanSurface(m);
    const auto found = creases(m);
    double most = 0.0;
    for (const Vec3<double> &x : found) most = std::max(most, c.sharp(x));
    std::printf("%s: %zu corners of edges, at most %.1e away\n", c.shape, found.size(), most);
    EXPECT_GT(found.size(), 100u);
    EXPECT_LE(most, shapeRoundOff);
    const SolidTree body(parseShape(c.shape));
    for (const Point &p : m.vertex) EXPECT_NEAR(body.at(at(p)).distance, 0.0, shapeRoundOff);
  }
}

TEST(CombinedShape, BoxesAreExact)
{
  struct {
    const char *shape;
    double volume, area;
  } const exact[] = {
      {"difference(box(0,10,0,4,0,3),box(1,9,1,3,1,4))", 120.0 - 32.0, 2.0 * (40.0 + 30.0 + 12.0) + 2.0 * (16.0 + 4.0)},
      {"union(box(0,1,0,1,0,1),box(1,2,0,1,0,1))", 2.0, 10.0},      // a common face vanishes
      {"union(box(0,1,0,1,0,1),box(0.5,2,0,1,0,1))", 2.0, 10.0},    // faces in one plane
      {"difference(box(0,2,0,1,0,1),box(1,2,0,1,0,1))", 1.0, 6.0},  // nothing as thin as a face is left
      {"difference(box(0,3,0,3,0,3),box(1,2,1,2,-1,4),box(1,2,-1,4,1,2))", 27.0 - 5.0, 54.0 - 4.0 + 16.0 + 2.0},
      {"intersection(box(0,2,0,2,0,2),box(1,3,0,2,0,2),box(0,3,0,1.5,0,2))", 3.0, 2.0 * (1.5 + 2.0 + 3.0)},
  };
  for (const auto &c : exact) {
    SCOPED_TRACE(c.shape);
    for (const double spacing : {0.31, 0.25, 0.1}) {
      SurfaceMesh m = shapeSurface(c.shape, spacing, 0.0);
      const MeshReport report = cleanSurface(m);
      expectManifold(report);
      EXPECT_NEAR(report.volume, c.volume, shapeRoundOff * c.volume);
      EXPECT_NEAR(report.area, c.area, shapeRoundOff * c.area);
    }
  }
}

/// Axes that meet, faces in one plane, bodies that touch: round numbers, as people write them.
TEST(CombinedShape, RoundNumbersAreNoTrouble)
{
  const char *pairs[][2] = {
      {"cylinder(x,0.5,0,0.5,-1,1)", "cylinder(z,0.5,0,0.5,-0.5,1)"},
      {"box(0,1.5,-0.5,0.5,0,1.5)", "cone(z,0,-0.5,0.5,0,-0.5,1)"},
      {"torus(z,0,-0.5,0,1,0.5)", "box(0,1.5,-0.5,0.5,-0.5,0.5)"},
      {"sphere(-0.5,0.5,-0.5,0.5)", "torus(z,-0.5,0,0,1,0.5)"},
      {"torus(x,0,0,0,1,0.5)", "torus(x,0.5,-0.5,-0.5,1,0.5)"},
      {"cylinder(x,0.5,0.5,0.5,-0.5,0.5)", "box(-0.5,0.5,-0.5,0,-1,1)"},
      {"sphere(0,0,0,1)", "cylinder(z,0,0,0.5,-2,2)"},
      {"cone(z,0,0,1,0,0,1)", "cylinder(z,0,0,1,-1,0)"},
      {"box(0,1,0,1,0,1)", "box(1,2,1,2,0,1)"},
  };
  constexpr double spacing = 0.06;
  const auto volume = [](const std::string &shape) {
    SurfaceMesh m;
    try {
      m = shapeSurface(shape, spacing, 0.0);
    } catch (const Error &e) {
      EXPECT_NE(std::string(e.what()).find("nothing is left"), std::string::npos) << e.what();
      return 0.0;
    }
    const MeshReport report = cleanSurface(m);
    EXPECT_TRUE(report.closed()) << shape << "\n" << report.text();
    EXPECT_EQ(turnedOver(m, shape, spacing), 0) << shape;
    return report.volume;
  };
  for (const auto &p : pairs) {
    SCOPED_TRACE(std::string(p[0]) + " " + p[1]);
    const std::string both = std::string(p[0]) + "," + p[1];
    const double a = volume(p[0]), b = volume(p[1]), common = volume("intersection(" + both + ")");
    EXPECT_NEAR(volume("union(" + both + ")") + common, a + b, 3.0 * (a + b) * spacing * spacing);
    EXPECT_NEAR(volume("difference(" + both + ")") + common, a, 3.0 * (a + b) * spacing * spacing);
  }
}

TEST(CombinedShape, NamesWhatIsWrong)
{
  const auto said = [](const std::string &shape, double spacing = 0.1) {
    try {
      shapeSurface(shape, spacing, 0.0);
    } catch (const Error &e) {
      const std::string what = e.what(), start = "shape '" + shape + "': ";
      return what.compare(0, start.size(), start) == 0 ? what.substr(start.size()) : what;
    }
    return std::string("nothing");
  };
  const std::string box = "box(0,1,0,1,0,1)", far = "box(3,4,0,1,0,1)", plane = "plane(0,0,0,0,0,1,1)";
  EXPECT_EQ(said("minus(" + box + "," + far + ")"),
            "'minus' is no shape; there are box, sphere, cylinder, cone, torus and plane, and their union, "
            "intersection and difference");
  EXPECT_EQ(said("union(" + box + ")"), "union takes two or more shapes, not 1");
  EXPECT_EQ(said("union()"), "union takes two or more shapes, not 0");
  EXPECT_EQ(said("union(" + box + ",)"), "operand 2 of union is missing");
  EXPECT_EQ(said("union(" + box + ",part.stl)"), "'part.stl' is no shape, and union combines shapes");
  EXPECT_EQ(said("difference(" + box + "," + plane + ")"),
            "'" + plane + "' is an open sheet, and difference takes closed shapes; a box has planes for sides");
  EXPECT_EQ(said("union(" + box + "," + far), "its brackets do not match");
  EXPECT_EQ(said("union(" + box + ",sphere(0,0,0,-1))"),
            "shape 'sphere(0,0,0,-1)': the radius is -1, it must be above 0");
  EXPECT_EQ(said("intersection(" + box + "," + far + ")"), "nothing is left of it: the bodies have nothing in common");
  EXPECT_EQ(said("difference(" + box + ",sphere(0,0,0,2))"),
            "nothing is left of it, or nothing as thick as the spacing, 0.1");
  EXPECT_EQ(said("union(" + box + "," + far + ")", 0.0),
            "it needs the length of the cells that find its triangles, keyword spacing");
  EXPECT_EQ(said("union(" + box + "," + far + ")", 1e-4),
            "spacing is too small: it would take more than 1e+09 nodes of the grid");
  EXPECT_TRUE(isShape("union(box(0,1,0,1,0,1),sphere(0,0,0,1))"));
  EXPECT_TRUE(isOperation("difference"));
  EXPECT_FALSE(isOperation("minus"));
}

}  // namespace
}  // namespace gpudem::testing
