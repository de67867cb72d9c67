// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Contacts of a sphere with walls of triangles: numbers, values, continuity.
#include "surface/contact_identity.hpp"
#include "testing/meshes.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace gpudem::testing {

namespace {

Surface sheet(SurfaceMesh m, double reach)
{
  cleanSurface(m);
  return Surface(m, reach, SurfaceSide::Both);
}

/// Distances of coordinates of size 1 with some rounding of each operation.
const Tolerance exactly = roundOff(Precision::Double, 1.0, 64);

/// Largest change of the force per length of path, at \p steps between two places.
double steepest(const Surface &s, const Vec3<double> &from, const Vec3<double> &to, double radius, int steps)
{
  Vec3<double> before = unitForce(contactsAt(s, from, radius), radius);
  double most = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const Vec3<double> x = from + (to - from) * (static_cast<double>(k) / steps);
    const Vec3<double> now = unitForce(contactsAt(s, x, radius), radius);
    most = std::max(most, length(now - before));
    before = now;
  }
  return most / (length(to - from) / steps);
}

TEST(SurfaceContact, planeOfManyTrianglesIsOnePlane)
{
  SurfaceMesh m = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 20);
  tilt(m);
  const Surface s = sheet(m, 0.2);
  const Vec3<double> up = tilted({0, 0, 1}) - tilted({0, 0, 0});
  Random random;
  for (int k = 0; k < 20000; ++k) {
    // on vertices, edges and faces alike
    const double snap = k % 2 ? 0.05 : 1e-9;
    Vec3<double> p = random.inCube(0.25, 0.75);
    p = {snap * std::round(p.x / snap), snap * std::round(p.y / snap), random.between(0.02, 0.19) * (k % 3 ? 1 : -1)};
    const SurfaceContacts c = contactsAt(s, tilted(p), 0.2);
    ASSERT_EQ(c.count, 1) << k;
    EXPECT_TRUE(near(c.contact[0].distance, std::abs(p.z), exactly));
    EXPECT_TRUE(near(dot(c.contact[0].normal, up), p.z > 0 ? 1.0 : -1.0, exactly));
    EXPECT_EQ(c.contact[0].weight, 1.0);
  }
}

TEST(SurfaceContact, nearestOfAllTriangles)
{
  SurfaceMesh m = ball(0.5, 12);
  append(m, cube(0.4, 3));
  tilt(m);
  const MeshReport report = cleanSurface(m);
  ASSERT_TRUE(report.closed()) << report.text();
  const Surface s(m, 0.15, SurfaceSide::Both);
  Random random;
  int hits = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3<double> x = random.inCube(-0.7, 1.2);
    const double exact = bruteDistance(m, x);
    const SurfaceContacts c = contactsAt(s, x, 0.15);
    if (exact >= 0.15) {
      EXPECT_EQ(c.count, 0);
    } else {
      ++hits;
      ASSERT_GE(c.count, 1);
      EXPECT_TRUE(near(c.contact[0].distance, exact, exactly));
    }
  }
  EXPECT_GT(hits, 300);
}

/// Triangles that look in opposite directions share nodes of the search tree.
TEST(SurfaceContact, bothFacesOfAPlate)
{
  constexpr int n = 40;  // boxes as wide as the plate is thick hold some of each face
  constexpr double thickness = 0.5;
  SurfaceMesh plate = rectangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, n);
  append(plate, rectangle({0, 0, -thickness}, {0, 8, 0}, {8, 0, 0}, n));
  cleanSurface(plate);
  constexpr double radius = 0.5;
  const Surface surface(plate, radius, SurfaceSide::Both);
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const double height = random.between(0.1, 0.45);
    Vec3<double> x = random.inCube(1.0, 7.0);
    x.z = k % 2 ? height : -thickness - height;
    const SurfaceContacts c = contactsAt(surface, x, radius);
    ASSERT_EQ(c.count, 1) << x.x << " " << x.y << " " << x.z;
    ASSERT_NEAR(c.contact[0].distance, height, shapeRoundOff);
  }
}

TEST(SurfaceContact, cornersOfABox)
{
  SurfaceMesh m = cube(1.0, 4);
  cleanSurface(m);
  const Surface in(m, 0.1, SurfaceSide::Inside), out(m, 0.1, SurfaceSide::Outside);
  EXPECT_EQ(contactsAt(in, {0.5, 0.5, 0.5}, 0.1).count, 0);
  EXPECT_EQ(contactsAt(in, {0.5, 0.5, 0.09}, 0.1).count, 1);
  EXPECT_EQ(contactsAt(in, {0.5, 0.08, 0.09}, 0.1).count, 2);
  const SurfaceContacts corner = contactsAt(in, {0.07, 0.08, 0.09}, 0.1);
  ASSERT_EQ(corner.count, 3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(near(corner.contact[k].distance, 0.07 + 0.01 * k, exactly));
    EXPECT_TRUE(near(corner.contact[k].normal[k], 1.0, exactly));
    EXPECT_EQ(corner.contact[k].weight, 1.0);
  }
  // outside: one contact with face, edge and vertex
  for (const Vec3<double> &d : {Vec3<double>{0.03, 0.04, 0.05}, {0.03, 0.04, -0.5}, {0.03, -0.5, -0.5}}) {
    const Vec3<double> x = Vec3<double>{1, 1, 1} + d;
    const SurfaceContacts c = contactsAt(out, x, 0.1);
    const Vec3<double> to{std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)};
    ASSERT_EQ(c.count, 1);
    EXPECT_TRUE(near(c.contact[0].distance, length(to), exactly));
    EXPECT_TRUE(near(dot(c.contact[0].normal, to), length(to), exactly));
  }
  // a centre beyond the wall is pushed back
  const SurfaceContacts beyond = contactsAt(in, {0.5, 0.4, -0.03}, 0.1);
  ASSERT_EQ(beyond.count, 1);
  EXPECT_TRUE(near(beyond.contact[0].distance, -0.03, exactly));
  EXPECT_TRUE(near(beyond.contact[0].normal.z, 1.0, exactly));
}

TEST(SurfaceContact, slotTouchesBothFaces)
{
  SurfaceMesh m = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 7);
  append(m, rectangle({0, 0, 0.19}, {1, 0, 0}, {0, 1, 0}, 5));
  tilt(m);
  const Surface s = sheet(m, 0.1);
  const SurfaceContacts c = contactsAt(s, tilted({0.4, 0.5, 0.093}), 0.1);
  ASSERT_EQ(c.count, 2);
  EXPECT_TRUE(near(c.contact[0].distance, 0.093, exactly));
  EXPECT_TRUE(near(c.contact[1].distance, 0.097, exactly));
  EXPECT_TRUE(near(dot(c.contact[0].normal, c.contact[1].normal), -1.0, exactly));
  EXPECT_EQ(c.contact[0].weight, 1.0);
  EXPECT_EQ(c.contact[1].weight, 1.0);
}

TEST(SurfaceContact, tenThousandFacetsWithoutABump)
{
  // 100 x 50 quads of a fiftieth of the sphere's radius to a radius, rolled over askew
  SurfaceMesh m = gridMesh(100, 50, [](double a, double b) { return Point{a * (1.0 + 0.3 * b), b * b, 0.0}; }, true);
  tilt(m);
  ASSERT_EQ(m.triangle.size(), 10000u);
  const Surface s = sheet(m, 0.1);
  for (int k = 0; k < 20000; ++k) {
    const double t = k / 20000.0;
    const SurfaceContacts c = contactsAt(s, tilted({0.15 + 0.7 * t, 0.2 + 0.6 * t, 0.098}), 0.1);
    ASSERT_EQ(c.count, 1);
    EXPECT_TRUE(near(unitForce(c, 0.1).x * unitForce(c, 0.1).x + unitForce(c, 0.1).y * unitForce(c, 0.1).y +
                         unitForce(c, 0.1).z * unitForce(c, 0.1).z,
                     0.002 * 0.002, roundOff(Precision::Double, 0.002, 64)));
  }
}

TEST(SurfaceContact, overAConvexEdgeAndVertex)
{
  SurfaceMesh m = cube(1.0, 3);
  cleanSurface(m);
  const Surface s(m, 0.1, SurfaceSide::Outside);
  // around an edge and a corner at constant distance: one contact of constant force
  for (int k = 0; k <= 2000; ++k) {
    const double t = k / 2000.0, angle = M_PI / 2 * t;
    for (const Vec3<double> &way :
         {Vec3<double>{std::cos(angle), std::sin(angle), 0.0},
          Vec3<double>{std::cos(angle) * 0.6, std::sin(angle) * 0.6, 0.8}}) {
      const SurfaceContacts c = contactsAt(s, Vec3<double>{1, 1, way.z == 0.0 ? 0.37 : 1.0} + way * 0.095, 0.1);
      ASSERT_EQ(c.count, 1);
      EXPECT_TRUE(near(c.contact[0].distance, 0.095, exactly));
      EXPECT_TRUE(near(dot(c.contact[0].normal, way), 1.0, exactly));
    }
  }
  // from a face over the edge at constant height: no steeper than the law itself
  EXPECT_LT(steepest(s, {0.9, 0.43, 1.09}, {1.1, 0.41, 1.09}, 0.1, 20000), 1.01);
}

TEST(SurfaceContact, forceHasNoJumpInAnAngle)
{
  // out of one face into the angle with another: along the first face, then along the second
  for (const double degrees : {0.1, 1.0, 3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0})
    for (const double overlap : {0.002, 0.01, 0.05}) {
      const double a = degrees * M_PI / 180.0, r = 0.1, z = r * (1 - overlap);
      SurfaceMesh m = rectangle({0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, 3);
      append(m, rectangle({0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {0, 1, 0}, 4));
      const Surface s = sheet(m, r);
      const double turn = -z * std::tan(a / 2);  // where both faces are equally far
      const Vec3<double> middle{turn, 0.41, z};
      double slope[2];
      for (int fine = 0; fine < 2; ++fine) {
        const int steps = fine ? 200000 : 20000;
        slope[fine] = std::max(
            steepest(s, middle - Vec3<double>{0.08, 0.01, 0}, middle, r, steps),
            steepest(s, middle, middle + Vec3<double>{0.08 * std::cos(a), 0.01, 0.08 * std::sin(a)}, r, steps));
      }
      if (overlap == 0.01) std::printf("angle of %g degrees: force changes by at most %.3f k per length\n", degrees, slope[1]);
      // a jump would make the slope of the finer path ten times that of the coarser
      EXPECT_LT(slope[1], 1.2 * slope[0] + 1e-6) << degrees << " " << overlap;
    }
}

TEST(SurfaceContact, facettedTubeConverges)
{
  const double R = 1.0, r = 0.3;
  for (const double overlap : {0.003, 0.01}) {
    double before = 0.0;
    for (const int n : {90, 180, 360, 720, 1440}) {
      SurfaceMesh m = tube(R, 2.0, n, 3);
      const Surface s = sheet(m, r);
      double worst = 0.0;
      for (int k = 0; k < 3000; ++k) {
        const double phi = 2.0 * M_PI / n * 3 * k / 3000.0, d = R - r * (1 - overlap);
        const Vec3<double> x{d * std::cos(phi), d * std::sin(phi), 0.9 + 0.0001 * k};
        const Vec3<double> exact{-r * overlap * std::cos(phi), -r * overlap * std::sin(phi), 0.0};
        const SurfaceContacts c = contactsAt(s, x, r);
        ASSERT_FALSE(c.overflow);
        worst = std::max(worst, length(unitForce(c, r) - exact) / (r * overlap));
      }
      std::printf("tube of %d facets, overlap %g: force wrong by %.2e\n", n, overlap, worst);
      if (n > 360) {
        EXPECT_LT(worst, 0.5 * before);
      }
      before = worst;
    }
  }
}

}  // namespace

/// What the normal cones pass over holds no minimum.
TEST(SurfaceContact, ConesHideNoMinimum)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const double reach = 0.4;
  std::size_t minima = 0, visited = 0, all = 0;
  for (int shape = 0; shape < 4; ++shape) {
    SurfaceMesh m = shape == 0 ? ball(1.0, 24) : shape == 1 ? tube(1.0, 2.0, 64, 20) : cube(1.5, 6);
    if (shape == 3)  // rough
      for (Point &p : m.vertex)
        for (std::size_t d = 0; d < 3; ++d)
          p[d] += 0.03 * std::sin(37.0 * p[0] + 5.0 * d) * std::cos(29.0 * p[1] - 41.0 * p[2]);
    tilt(m);
    cleanSurface(m);
    const Surface surface(m, reach, SurfaceSide::Both);
    const SurfaceView s = surface.view();
    for (int n = 0; n < 4000; ++n) {
      const Vec3<double> x = tilted({1.5 * even(random), 1.5 * even(random), 1.0 + 1.5 * even(random)});
      std::set<std::uint32_t> expected, found;
      visitNear(s, x, reach, [&](std::uint32_t k, const TrianglePoint &p, double) {
        ++all;
        if (isMinimum(s, s.triangle[k], p, x)) expected.insert(k);
        return true;
      });
      visitNear<Wanted::Minima>(s, x, reach, [&](std::uint32_t k, const TrianglePoint &p, double) {
        ++visited;
        if (isMinimum(s, s.triangle[k], p, x)) found.insert(k);
        return true;
      });
      EXPECT_EQ(found, expected);
      minima += expected.size();
    }
  }
  EXPECT_GT(minima, 4000u);
  EXPECT_LT(visited, 3 * all / 4);
}

/// A list made for a larger reach serves a centre that has moved by the difference, to the last bit; with triangles, with
/// nodes, and without room.
TEST(SurfaceContact, ListsOfWhatIsNearMissNothing)
{
  std::mt19937 random(12);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const double reach = 0.2, margin = 0.05;
  int triangles = 0, nodes = 0, full = 0, empty = 0;
  for (int shape = 0; shape < 4; ++shape) {
    SurfaceMesh m = shape == 0 ? ball(1.0, 24) : shape == 1 ? tube(1.0, 2.0, 24, 4) : shape == 2 ? cube(1.5, 2) : ball(1.0, 96);
    tilt(m);
    cleanSurface(m);
    const Surface surface(m, reach + margin, SurfaceSide::Both);
    const SurfaceView s = surface.view();
    for (int n = 0; n < 20000; ++n) {
      const Vec3<double> x = tilted({1.5 * even(random), 1.5 * even(random), 1.0 + 1.5 * even(random)});
      std::uint32_t entries[NearList::most];
      float gaps[NearList::most];
      const bool some = listNear(s, x, reach + margin, margin, entries, gaps, 1);
      const Vec3<double> way{even(random), even(random), even(random)};
      const double far = n % 3 == 0 ? 0.0 : 0.999 * margin * (n % 3 == 1 ? 1.0 : std::abs(even(random)));
      const Vec3<double> moved = x + way * (far / length(way));
      const NearList list{entries, gaps, 1, static_cast<float>(length(moved - x)) * 1.000001f};
      EXPECT_EQ(some, gaps[0] != NearList::noEntry);
      (!some ? empty : list.holdsTriangles() ? triangles : list.holdsMinima() ? nodes : full) += 1;
      SurfaceContacts expected, found;
      surfaceContacts(s, moved, reach, expected);
      surfaceContacts(s, moved, reach, found, list);
      ASSERT_EQ(found.count, expected.count);
      EXPECT_EQ(found.overflow, expected.overflow);
      for (int k = 0; k < found.count; ++k) {
        EXPECT_EQ(found.contact[k].triangle, expected.contact[k].triangle);
        EXPECT_EQ(found.contact[k].distance, expected.contact[k].distance);
        EXPECT_EQ(found.contact[k].weight, expected.contact[k].weight);
      }
    }
  }
  for (const int cases : {triangles, nodes, full, empty}) EXPECT_GT(cases, 500);
}

}  // namespace gpudem::testing
