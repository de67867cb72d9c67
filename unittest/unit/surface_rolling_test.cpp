// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Curved walls made of facets, how little the triangulation matters, and springs that live on.
#include "surface/contact_identity.hpp"
#include "testing/meshes.h"

#include <gtest/gtest.h>

namespace gpudem::testing {

namespace {

/// Distances of coordinates of size 1 with some rounding of each operation.
const Tolerance exactly = roundOff(Precision::Double, 1.0, 64);

/// Half sphere open upward, of irregular triangles: the vertices are moved about on the sphere.
SurfaceMesh bowl(double radius, int n, double disorder)
{
  Random random;
  SurfaceMesh m = gridMesh(2 * n, n, [&](double a, double b) {
    const double phi = 2 * M_PI * a, theta = 0.5 * M_PI * b;
    return Point{radius * std::sin(theta) * std::cos(phi), radius * std::sin(theta) * std::sin(phi),
                 -radius * std::cos(theta)};
  }, true);
  cleanSurface(m);
  for (Point &p : m.vertex) {
    Vec3<double> q{p[0], p[1], p[2]};
    q += random.inCube(-1.0, 1.0) * (disorder * radius / n);
    q = q * (radius / length(q));
    p = {q.x, q.y, q.z};
  }
  return m;
}

/// As a wall fix does it: directions and one spring per contact, carried from step to step.
struct Rolling {
  Vec3<double> direction[maxSurfaceContacts];
  double spring[maxSurfaceContacts];
  int count = 0;

  /// Every contact's spring grows by \p growth. \return the weighted sum of the springs
  double step(const Surface &s, const Vec3<double> &x, double radius, double growth)
  {
    const SurfaceContacts c = contactsAt(s, x, radius);
    const double chord2 = identityChord2(c, radius);
    Rolling next;
    double sum = 0.0;
    for (int k = 0; k < c.count; ++k) {
      const int from = continuedContact(direction, count, c.contact[k], chord2);
      next.direction[k] = c.contact[k].normal;
      next.spring[k] = (from < 0 ? 0.0 : spring[from]) + growth;
      sum += c.contact[k].weight * next.spring[k];
    }
    next.count = c.count;
    *this = next;
    return sum;
  }
};

TEST(SurfaceRolling, springLivesOnOverFlatFacets)
{
  SurfaceMesh m = gridMesh(60, 60, [](double a, double b) { return Point{a, b, 0.0}; }, true);
  tilt(m);
  cleanSurface(m);
  const Surface s(m, 0.1, SurfaceSide::Both);
  Rolling grain;
  for (int k = 1; k <= 10000; ++k) {
    const double t = k / 10000.0;
    EXPECT_TRUE(near(grain.step(s, tilted({0.1 + 0.8 * t, 0.2 + 0.5 * t, 0.0985}), 0.1, 1.0), k,
                     roundOff(Precision::Double, k)));
  }
}

TEST(SurfaceRolling, springLivesOnAroundAConvexEdge)
{
  SurfaceMesh m = cube(1.0, 2);
  cleanSurface(m);
  const Surface s(m, 0.1, SurfaceSide::Outside);
  Rolling grain;
  int k = 0;
  for (double x = 0.8; x < 1.0; x += 0.001) EXPECT_EQ(grain.step(s, {x, 0.4, 1.09}, 0.1, 1.0), ++k);
  for (double a = 0.0; a < M_PI / 2; a += 0.02)
    EXPECT_EQ(grain.step(s, {1 + 0.09 * std::sin(a), 0.4, 1 + 0.09 * std::cos(a)}, 0.1, 1.0), ++k);
  for (double z = 1.0; z > 0.8; z -= 0.001) EXPECT_EQ(grain.step(s, {1.09, 0.4, z}, 0.1, 1.0), ++k);
}

TEST(SurfaceRolling, springLivesOnInAFacettedTube)
{
  // twice around; the sum of the weights, and so that of the springs, exceeds 1 by a little where facets meet
  SurfaceMesh m = tube(1.0, 1.0, 180);
  cleanSurface(m);
  const Surface s(m, 0.3, SurfaceSide::Both);
  Rolling grain;
  const double d = 0.7 + 0.01 * 0.3;
  double least = 1.0, most = 1.0;
  for (int k = 1; k <= 20000; ++k) {
    const double phi = 4 * M_PI * k / 20000;
    const double sum = grain.step(s, {d * std::cos(phi), d * std::sin(phi), 0.5}, 0.3, 1.0) / k;
    least = std::min(least, sum);
    most = std::max(most, sum);
  }
  std::printf("spring in a tube of 180 facets: between %.4f and %.4f of its value\n", least, most);
  EXPECT_GT(least, 1.0 - 1e-9);
  EXPECT_LT(most, 1.05);
}

TEST(SurfaceRolling, facesOfACornerKeepTheirOwnSprings)
{
  SurfaceMesh m = cube(1.0, 3);
  cleanSurface(m);
  const Surface s(m, 0.1, SurfaceSide::Inside);
  Rolling grain;
  for (int k = 0; k < 50; ++k) grain.step(s, {0.3, 0.5, 0.095}, 0.1, 1.0);
  for (double x = 0.3; x > 0.095; x -= 0.001) grain.step(s, {x, 0.5, 0.095}, 0.1, 1.0);
  const SurfaceContacts c = contactsAt(s, {0.0955, 0.5, 0.095}, 0.1);
  ASSERT_EQ(c.count, 2);
  ASSERT_EQ(grain.count, 2);
  EXPECT_GT(std::max(grain.spring[0], grain.spring[1]), 250.0);
  EXPECT_LT(std::min(grain.spring[0], grain.spring[1]), 10.0);
}

TEST(SurfaceRolling, noJumpInAnIrregularBowl)
{
  // bisection of the steepest part of a path tells a jump from a slope
  const double R = 1.0, r = 0.3, overlap = 0.015 * r, d = R - r + overlap;
  for (const int n : {8, 20, 60}) {
    const SurfaceMesh m = bowl(R, n, 0.3);
    const Surface s(m, r, SurfaceSide::Both);
    const auto force = [&](const Vec3<double> &x) { return unitForce(contactsAt(s, x * (d / length(x)), r), r); };
    int crowded = 0;
    Random random;
    double worst = 0.0;
    for (int path = 0; path < 4000; ++path) {
      Vec3<double> a = random.inCube(-1, 1), b = random.inCube(-1, 1);
      a.z = b.z = -1.2;
      a = a * (d / length(a));
      b = a + (b * (1.0 / length(b)) - a) * 0.1;
      Vec3<double> fa = force(a), fb = force(b);
      for (int k = 0; k < 40; ++k) {
        const Vec3<double> middle = (a + b) * 0.5, fm = force(middle);
        if (length(fm - fa) > length(fb - fm)) {
          b = middle;
          fb = fm;
        } else {
          a = middle;
          fa = fm;
        }
      }
      if (contactsAt(s, a * (d / length(a)), r).overflow || contactsAt(s, b * (d / length(b)), r).overflow)
        ++crowded;
      else
        worst = std::max(worst, length(fb - fa) / overlap);
    }
    std::printf("bowl of %zu irregular triangles: largest jump on 4000 paths %.2e of the force, %d too crowded\n",
                m.triangle.size(), worst, crowded);
    EXPECT_LT(worst, 1e-8);
    // facets a tenth of the disc that the grain's overlap cuts out: more minima than the list holds, now and then
    EXPECT_LE(crowded, 40);
  }
}

TEST(SurfaceRolling, facettedBodiesConverge)
{
  // outside a sphere, inside a cone: force against that of the smooth body
  const double r = 0.1, overlap = 0.01;
  Random random;
  double before[2] = {0.0, 0.0};
  for (const int n : {40, 80, 160, 320}) {
    SurfaceMesh sphere = ball(0.5, n);
    SurfaceMesh cone = gridMesh(2 * n, n / 2, [](double a, double b) {
      return Point{b * std::cos(2 * M_PI * a), b * std::sin(2 * M_PI * a), b};
    });
    cleanSurface(sphere);
    cleanSurface(cone);
    const Surface s(sphere, r, SurfaceSide::Outside), c(cone, r, SurfaceSide::Both);
    double worst[2] = {0.0, 0.0};
    for (int k = 0; k < 2000; ++k) {
      Vec3<double> u = random.inCube(-1, 1);
      u = u * (1.0 / length(u));
      const Vec3<double> f = unitForce(contactsAt(s, u * (0.5 + r * (1 - overlap)), r), r);
      worst[0] = std::max(worst[0], length(f - u * (r * overlap)) / (r * overlap));
      const double phi = random.between(0, 2 * M_PI), z = random.between(0.5, 0.7), w = std::sqrt(0.5);
      const Vec3<double> inward{-w * std::cos(phi), -w * std::sin(phi), w};
      const Vec3<double> x = Vec3<double>{z * std::cos(phi), z * std::sin(phi), z} + inward * (r * (1 - overlap));
      worst[1] = std::max(worst[1], length(unitForce(contactsAt(c, x, r), r) - inward * (r * overlap)) / (r * overlap));
    }
    std::printf("n = %d: force outside the sphere wrong by %.2e, inside the cone by %.2e\n", n, worst[0], worst[1]);
    for (int b = 0; b < 2; ++b) {
      if (before[b] > 0.0) {
        EXPECT_LT(worst[b], 0.6 * before[b]);
      }
      before[b] = worst[b];
    }
  }
}

TEST(SurfaceRolling, triangulationDoesNotMatter)
{
  // one polyhedron, its faces cut in different ways: a corner of three faces, an edge and a step
  const auto mesh = [](int n) {
    SurfaceMesh m = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n);
    append(m, rectangle({0, 0, 0}, {0, 1, 0}, {0, 0.1, 1}, n + 1));
    append(m, rectangle({0, 0, 0}, {0, 0.1, 1}, {1, 0, 0}, n + 2));
    append(m, rectangle({0.5, 0.5, 0.03}, {0.5, 0, 0}, {0, 0.5, 0}, n));
    append(m, rectangle({0.5, 0.5, 0}, {0, 0, 0.03}, {0, 0.5, 0}, n));
    append(m, rectangle({0.5, 0.5, 0}, {0.5, 0, 0}, {0, 0, 0.03}, 2 * n));
    tilt(m);
    cleanSurface(m, 1e-9);
    return Surface(m, 0.1, SurfaceSide::Both);
  };
  const Surface coarse = mesh(1), fine = mesh(17);
  Random random;
  int several = 0, shared = 0;
  double worst = 0.0;
  for (int k = 0; k < 200000; ++k) {
    // along the floor, up the slanted walls, and around the step
    Vec3<double> p{random.between(0.0, 0.9), random.between(0.0, 0.9), random.between(0.097, 0.14)};
    if (k % 2) p.x = random.between(0.097, 0.11);
    if (k % 4 == 1) p.y = random.between(0.1, 0.12);
    const Vec3<double> x = tilted(p);
    const SurfaceContacts a = contactsAt(coarse, x, 0.1), b = contactsAt(fine, x, 0.1);
    if (a.count == 0 || a.contact[0].distance < 0.097) continue;
    bool separate = true;
    for (const SurfaceContacts *c : {&a, &b})
      for (int i = 0; i < c->count; ++i) separate = separate && c->contact[i].weight == 1.0;
    const double difference = length(unitForce(a, 0.1) - unitForce(b, 0.1));
    several += a.count > 1;
    shared += !separate;
    if (separate) {
      ASSERT_EQ(a.count, b.count);
      EXPECT_TRUE(near(difference, 0.0, exactly));
    } else {
      worst = std::max(worst, difference / length(unitForce(a, 0.1)));
    }
  }
  std::printf("%d places with several contacts, %d with shared ones, where the cutting changes the force by up to %.2e\n",
              several, shared, worst);
  EXPECT_GT(several, 1000);
}

}  // namespace

}  // namespace gpudem::testing
