// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Normal forces with hysteresis: loops and collisions in closed form, branches that meet.

#include "testing/contacting.h"
#include "testing/random_models.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

const double pi = std::acos(-1.0);

TEST(Luding, RestitutionIsTheRootOfTheStiffnessRatio)
{
  EXPECT_TRUE(near(Contacting(luding(0.0, 0.0)).restitution(1.0, 1e-6), 0.5, integrated(1.0)));
  // with a slope that grows: that of the largest overlap, v sqrt(m*/k1)
  const double largest = std::sqrt(0.5 / 1e4), limit = 4.0 / 3.0 * 0.05 * 0.5;
  ASSERT_LT(largest, limit);
  const double slope = 1e4 + 3e4 * largest / limit;
  EXPECT_TRUE(near(Contacting(luding(0.0, 0.05)).restitution(1.0, 1e-6), std::sqrt(1e4 / slope), integrated(1.0)));
}

TEST(Luding, LoopOfLoadingAndUnloading)
{
  const double k1 = 1e4, k2 = 4e4, kc = 5e3, largest = 0.02;
  Contacting c(luding(kc, 0.0));
  const double loss = c.work(0.0, largest) + c.work(largest, 0.0);
  // the plastic overlap, where the force vanishes, and where the adhesive branch begins
  const double rest = (1.0 - k1 / k2) * largest, least = (k2 - k1) / (k2 + kc) * largest;
  const double expected = 0.5 * k1 * largest * largest * (1.0 - k1 / k2) + 0.5 * kc * least * rest;
  EXPECT_TRUE(near(loss, expected, integrated(expected)));
}

TEST(Luding, BranchesMeet)
{
  const double k1 = 1e4, k2 = 4e4, kc = 5e3, largest = 0.02, least = (k2 - k1) / (k2 + kc) * largest, rest = 0.015;
  Contacting c(luding(kc, 0.0));
  EXPECT_TRUE(near(c.push(largest), k1 * largest, exact(200.0)));
  EXPECT_TRUE(near(c.push(largest * (1 - 1e-12)), k1 * largest, {1e-11, 200.0}));
  EXPECT_TRUE(near(c.push(rest), 0.0, exact(200.0)));
  EXPECT_TRUE(near(c.push(least), -kc * least, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * least), -kc * 0.5 * least, exact(200.0)));
  // reloading leaves the adhesive branch with slope k2 and joins that of loading
  EXPECT_TRUE(near(c.push(0.5 * least + 1e-4), -kc * 0.5 * least + k2 * 1e-4, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * largest), k1 * 0.5 * largest, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * largest + 1e-3), k1 * (0.5 * largest + 1e-3), exact(200.0)));
}

/// Where the slope grows, too, the adhesive branch can be left and entered at any overlap.
TEST(Luding, AdhesiveBranchWithGrowingSlope)
{
  const double kc = 5e3;
  Contacting c(luding(kc, 0.05));
  c.push(0.03);
  for (double x = 0.02; x > 0.002; x -= 0.001) {
    const double force = c.push(x);
    if (force > -kc * x * 0.999) continue;
    EXPECT_TRUE(near(c.push(x), -kc * x, exact(300.0))) << x;
    const double largest = c.kept[0], limit = 4.0 / 3.0 * 0.05 * 0.5, slope = 1e4 + 3e4 * largest / limit;
    EXPECT_TRUE(near(slope * (x - largest) + 1e4 * largest, -kc * x, exact(300.0)));
    EXPECT_TRUE(near(c.push(x * 1.01), -kc * x + slope * 0.01 * x, exact(300.0)));
    EXPECT_TRUE(near(c.push(x), -kc * x, exact(300.0)));
  }
  EXPECT_LT(c.kept[0], 0.02) << "the branch must have been met";
}

TEST(Luding, ElasticBeyondTheLimitOverlap)
{
  const double limit = 4.0 / 3.0 * 0.05 * 0.5;
  Contacting c(luding(1e3, 0.05));
  c.push(limit);
  const double loss = c.work(limit, 2.0 * limit) + c.work(2.0 * limit, limit);
  EXPECT_TRUE(near(loss, 0.0, integrated(1e4 * limit * limit)));
  EXPECT_TRUE(near(c.push(2.0 * limit), 1e4 * limit + 4e4 * limit, exact(2e3)));
}

/// The dashpot of a restitution does not follow F/delta, which vanishes and turns negative on unloading.
TEST(PlasticNormals, DashpotAlwaysDissipates)
{
  for (const char *name : {"luding", "eepa", "eepa/linear", "thornton_ning"}) {
    ContactModel m = undamped(name, {1e4, 0.5, 4e4, 5e3, 0.0});
    if (m.normal.name == "thornton_ning") m.normal.parameter = {1e6, 0.5, 0.3, 5e4};
    m.damping.name = "coeff_restitution";
    Contacting c(m);
    c.push(0.02);
    for (double x = 0.0199; x > 0.002; x -= 0.001) {
      const double still = c.push(x);
      EXPECT_GE(still - c.push(x, 1.0), 0.0) << name << x;
      EXPECT_TRUE(std::isfinite(c.push(x, 1.0)));
      EXPECT_TRUE(still == 0.0 || still > c.push(x, 1.0)) << name << x;
    }
  }
  // without hysteresis it is the dashpot of hooke, and returns what was asked for
  ContactModel elastic = undamped("luding", {1e4, 0.7, 1e4, 0.0, 0.0}), hooke = undamped("hooke", {1e4, 0.7});
  elastic.damping.name = hooke.damping.name = "coeff_restitution";
  EXPECT_EQ(Contacting(elastic).push(0.01, -0.3), Contacting(hooke).push(0.01, -0.3));
}

TEST(Eepa, LoopOfLoadingAndUnloading)
{
  const double k1 = 1e4, k2 = 4e4, kadh = 5e3, f0 = 3.0, largest = 0.02;
  for (const double n : {1.0, 1.5}) {
    Contacting c(undamped(n == 1.0 ? "eepa/linear" : "eepa", {k1, 0.0, k2, kadh, f0}));
    const double in = c.work(0.0, largest), out = -c.work(largest, 0.0);
    // integral of k x from zero to delta, x = delta^n
    const auto energy = [&](double k, double x) { return k * std::pow(x, (n + 1.0) / n) / (n + 1.0); };
    const double top = std::pow(largest, n), rest = (1.0 - k1 / k2) * top, least = (k2 - k1) / (k2 + kadh) * top;
    const double unloading =
        energy(k2, top) - energy(k2, least) - k2 * rest * (largest - std::pow(least, 1.0 / n)) - energy(kadh, least);
    EXPECT_TRUE(near(in, energy(k1, top) - f0 * largest, integrated(in))) << n;
    EXPECT_TRUE(near(out, unloading - f0 * largest, integrated(in))) << n;
  }
}

TEST(Eepa, BranchesMeet)
{
  const double k1 = 1e4, k2 = 4e4, kadh = 5e3, f0 = 3.0, top = std::pow(0.02, 1.5);
  const double least = (k2 - k1) / (k2 + kadh) * top;
  Contacting c(undamped("eepa", {k1, 0.0, k2, kadh, f0}));
  EXPECT_TRUE(near(c.push(1e-12), -f0, {1e-9, f0}));
  EXPECT_TRUE(near(c.push(0.02), k1 * top - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(0.75 * top, 2.0 / 3.0)), -f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(least, 2.0 / 3.0)), -kadh * least - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(0.5 * least, 2.0 / 3.0)), -kadh * 0.5 * least - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(0.015), k1 * std::pow(0.015, 1.5) - f0, exact(30.0)));
}

/// With n = 1 and f0 = 0 it is the model of Luding with a constant slope.
TEST(Eepa, LinearIsLuding)
{
  Contacting a(undamped("eepa/linear", {1e4, 0.0, 4e4, 5e3, 0.0})), b(luding(5e3, 0.0));
  Dice dice(3);
  for (int k = 0; k < 1000; ++k) {
    const double x = dice.between(0.0, 0.02);
    ASSERT_TRUE(near(a.push(x), b.push(x), exact(200.0)));
  }
}

/// Restitution of Thornton and Ning; below the yield velocity the collision is elastic.
TEST(ThorntonNing, RestitutionIsTheClosedForm)
{
  const double young = 1e6, yield = 1e5, star = young / (2.0 * (1.0 - 0.09)), radius = 0.25;
  const double strain = pi * yield / (2.0 * star), overlap = strain * strain * radius;
  // energy of Hertz up to the yield overlap: 8/15 E* sqrt(R*) delta^(5/2) = m* v_y^2/2
  const double slowest = std::sqrt(16.0 / 15.0 * star * std::sqrt(radius) * std::pow(overlap, 2.5) / 0.5);
  for (const double factor : {0.9, 1.0, 1.5, 3.0, 10.0}) {
    const double q = std::min(1.0, 1.0 / factor);
    const double expected = std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - q * q / 6.0) *
                            std::pow(q / (q + 2.0 * std::sqrt(1.2 - 0.2 * q * q)), 0.25);
    const double e =
        Contacting(undamped("thornton_ning", {young, 0.0, 0.3, yield})).restitution(factor * slowest, 2e-6);
    EXPECT_TRUE(near(e, expected, {1e-5, 1.0})) << factor;  // the force has a kink in its slope where it yields
  }
}

TEST(ThorntonNing, BranchesMeet)
{
  const double young = 1e6, yield = 1e5, star = young / (2.0 * (1.0 - 0.09)), radius = 0.25;
  const double strain = pi * yield / (2.0 * star), overlap = strain * strain * radius;
  const auto hertz = [&](double r, double x) { return 4.0 / 3.0 * star * std::sqrt(r) * std::pow(x, 1.5); };
  Contacting c(undamped("thornton_ning", {young, 0.0, 0.3, yield}));
  const double force = hertz(radius, overlap);
  EXPECT_TRUE(near(c.push(0.3 * overlap), hertz(radius, 0.3 * overlap), exact(force)));
  EXPECT_TRUE(near(c.push(overlap), force, exact(force)));
  EXPECT_TRUE(near(c.push(0.3 * overlap), hertz(radius, 0.3 * overlap), exact(force))) << "no loss before yield";
  EXPECT_TRUE(near(c.push(overlap * (1.0 + 1e-9)), force, {3e-9, force}));
  EXPECT_TRUE(near(c.push(3.0 * overlap), force + pi * yield * radius * 2.0 * overlap, exact(5.0 * force)));
  // unloading: Hertz of the larger curvature radius, from the same force and contact radius
  const double top = c.push(3.0 * overlap), curvature = radius * hertz(radius, 3.0 * overlap) / top;
  const double part = 3.0 * overlap * (1.0 - radius / curvature);
  EXPECT_GT(curvature, radius);
  EXPECT_TRUE(near(c.push(3.0 * overlap * (1.0 - 1e-12)), top, {1e-10, top}));
  const double half = 0.5 * (3.0 * overlap + part);
  EXPECT_TRUE(near(c.push(half), hertz(curvature, half - part), exact(5.0 * force)));
  EXPECT_EQ(c.push(part * 0.999), 0.0) << "the surfaces part in the dent";
  EXPECT_TRUE(near(c.push(3.0 * overlap), top, exact(top))) << "reloading is elastic";
}

/// Counted from where the attraction is strongest: zero on the adhesive branch, whatever the dashpot adds to the force.
TEST(PlasticNormals, CoulombLimitCountsFromTheAdhesiveBranch)
{
  const auto limit = [](ContactModel m, double pressed, double overlap) {
    m.damping.name = "velocity";
    m.normal.parameter[1] = 10.0;
    m.tangential = {"linear_history", {1e9, 0.0, 0.5}};
    Contacting c(m);
    c.push(pressed);
    ContactState s = c.state(overlap);
    s.relativeVelocity[0] = 1.0;
    s.relativeVelocity[1] = 1.0;
    return -c.evaluate(s).friction[1];
  };
  const ContactModel soft = luding(5e3, 0.0), pasty = undamped("eepa", {1e4, 0.0, 4e4, 5e3, 3.0});
  EXPECT_TRUE(near(limit(soft, 0.0, 0.02), 0.5 * (200.0 + 100.0), exact(200.0)));
  EXPECT_TRUE(near(limit(soft, 0.02, 0.015), 0.5 * 75.0, exact(200.0)));
  EXPECT_TRUE(near(limit(soft, 0.02, 0.005), 0.0, exact(200.0)));
  EXPECT_TRUE(near(limit(pasty, 0.0, 0.02), 0.5 * 1.5e4 * std::pow(0.02, 1.5), exact(200.0)));
  EXPECT_TRUE(near(limit(pasty, 0.02, 0.005), 0.0, exact(200.0)));
  EXPECT_TRUE(near(limit(luding(0.0, 0.0), 0.0, 0.02), 0.5 * 190.0, exact(200.0))) << "no adhesion: the whole force";
}

}  // namespace
