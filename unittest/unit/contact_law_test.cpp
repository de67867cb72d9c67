// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "contact/spring_dashpot.hpp"
#include "testing/tolerance.h"

#include <random>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

template <class Real>
struct Pair {
  Contact<Real> seen, mirrored;
  Vec3<Real> spring;
};

/// The same contact from both sides, with every quantity the step would compute.
template <class Real>
Pair<Real> randomPair(std::mt19937 &random)
{
  const auto u = [&](double lo, double hi) {
    return static_cast<Real>(std::uniform_real_distribution<double>(lo, hi)(random));
  };
  const Real ri = u(0.3, 0.7), rj = u(0.3, 0.7), mi = u(0.1, 2), mj = u(0.1, 2);
  const Vec3<Real> wi{u(-9, 9), u(-9, 9), u(-9, 9)}, wj{u(-9, 9), u(-9, 9), u(-9, 9)};
  Pair<Real> p;
  Contact<Real> &c = p.seen;
  Vec3<Real> n{u(-1, 1), u(-1, 1), u(-1, 1)};
  c.branch = n * ((ri + rj) * u(0.9, 0.999) / squareRoot(dot(n, n)));
  c.distance = squareRoot(dot(c.branch, c.branch));
  c.inverseDistance = Real(1) / c.distance;
  c.overlap = ri + rj - c.distance;
  c.effectiveRadius = ri * rj / (ri + rj);
  c.effectiveMass = mi * mj / (mi + mj);
  c.relativeVelocity = {u(-2, 2), u(-2, 2), u(-2, 2)};
  for (int d = 0; d < 3; ++d) c.surfaceSpin[d] = symmetricSum(ri, wi[d], rj, wj[d]);
  p.spring = {u(-.01, .01), u(-.01, .01), u(-.01, .01)};
  p.mirrored = c;
  p.mirrored.branch = c.branch * Real(-1);
  p.mirrored.relativeVelocity = c.relativeVelocity * Real(-1);
  for (int d = 0; d < 3; ++d) p.mirrored.surfaceSpin[d] = symmetricSum(rj, wj[d], ri, wi[d]);
  return p;
}

template <class Real, NormalModel normal, TangentialModel tangential>
void expectSymmetry()
{
  std::mt19937 random(7);
  const LawCoefficients<Real> law{Real(1e4), Real(3e3), Real(30), Real(15), Real(0.4), Real(1) / Real(3e3), false};
  for (int k = 0; k < 2000; ++k) {
    const Pair<Real> p = randomPair<Real>(random);
    Vec3<Real> s1 = p.spring, s2 = p.spring * Real(-1);
    const auto f1 = springDashpot<normal, tangential>(law, p.seen, s1, Real(1e-4), true);
    const auto f2 = springDashpot<normal, tangential>(law, p.mirrored, s2, Real(1e-4), true);
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(f1.force[d], -f2.force[d]);
      ASSERT_EQ(f1.couple[d], f2.couple[d]);
      if (tangential == TangentialModel::Spring) {
        ASSERT_EQ(s1[d], -s2[d]);
      }
    }
  }
}

TEST(ContactLaw, IsAntisymmetricToTheLastBit)
{
  expectSymmetry<float, NormalModel::Hooke, TangentialModel::None>();
  expectSymmetry<float, NormalModel::Hooke, TangentialModel::Viscous>();
  expectSymmetry<float, NormalModel::Hooke, TangentialModel::Spring>();
  expectSymmetry<float, NormalModel::Hertz, TangentialModel::Spring>();
  expectSymmetry<double, NormalModel::Hooke, TangentialModel::Spring>();
  expectSymmetry<double, NormalModel::Hertz, TangentialModel::Spring>();
}

/// Head-on collision of two equal grains, integrated finely. \return rebound over impact speed
double restitution(NormalModel normal, double gamma, double speed, bool limit)
{
  const LawCoefficients<double> law{1e5, 0, gamma, 0, 0, 0, limit};
  const double r = 0.5, m = 1.0, dt = 1e-7;
  double distance = 2 * r, approach = -speed;  // of the first grain relative to the second
  do {
    Contact<double> c{};
    c.branch = {distance, 0, 0};
    c.distance = distance;
    c.inverseDistance = 1.0 / distance;
    c.overlap = 2 * r - distance;
    c.effectiveRadius = r / 2;
    c.effectiveMass = m / 2;
    c.relativeVelocity = {approach, 0, 0};
    Vec3<double> spring{0, 0, 0};
    const auto f = springDashpot(normal, TangentialModel::Viscous, law, c, spring, dt, true);
    approach += f.force.x / (m / 2) * dt;
    distance += approach * dt;
  } while (distance < 2 * r);
  return approach / speed;
}

/// Linear spring-dashpot: e = exp(-pi beta / w), beta = gamma/2, w^2 = k/m* - beta^2.
TEST(ContactLaw, HookeRestitutionIsThatOfTheDampedOscillator)
{
  for (const double gamma : {0.0, 20.0, 50.0, 200.0}) {
    const double beta = gamma / 2, w = std::sqrt(1e5 / 0.5 - beta * beta);
    const double expected = std::exp(-std::acos(-1.0) * beta / w);
    EXPECT_TRUE(near(restitution(NormalModel::Hooke, gamma, 1.0, false), expected, {2e-4, 1.0})) << gamma;
  }
}

TEST(ContactLaw, HertzWithoutDampingConservesEnergy)
{
  EXPECT_TRUE(near(restitution(NormalModel::Hertz, 0.0, 1.0, false), 1.0, {1e-4, 1.0}));
}

TEST(ContactLaw, LimitedDampingNeverAttracts)
{
  const LawCoefficients<double> law{1e5, 0, 500, 0, 0, 0, true};
  Contact<double> c{};
  c.branch = {0.999, 0, 0};
  c.distance = 0.999;
  c.inverseDistance = 1.0 / 0.999;
  c.overlap = 0.001;
  c.effectiveMass = 0.5;
  c.relativeVelocity = {10, 0, 0};  // separating fast
  Vec3<double> spring{0, 0, 0};
  EXPECT_EQ((springDashpot<NormalModel::Hooke, TangentialModel::None>(law, c, spring, 1e-5, true).force.x), 0.0);
  EXPECT_GT(restitution(NormalModel::Hooke, 200, 1.0, true), restitution(NormalModel::Hooke, 200, 1.0, false));
}

/// Friction never exceeds mu |F_n|, and when clipped equals it, with the spring set to carry exactly that force.
TEST(ContactLaw, FrictionObeysCoulomb)
{
  std::mt19937 random(11);
  const LawCoefficients<double> law{1e4, 3e3, 30, 15, 0.3, 1.0 / 3e3, false};
  int sliding = 0;
  for (int k = 0; k < 2000; ++k) {
    const Pair<double> p = randomPair<double>(random);
    Vec3<double> spring = p.spring;
    const auto f = springDashpot<NormalModel::Hooke, TangentialModel::Spring>(law, p.seen, spring, 1e-5, true);
    const double fn = dot(f.force, p.seen.branch) / p.seen.distance;
    const Vec3<double> ft = f.force - p.seen.branch * (fn / p.seen.distance);
    const double magnitude = std::sqrt(dot(ft, ft));
    ASSERT_LE(magnitude, law.friction * std::abs(fn) * (1 + 1e-9));
    if (magnitude > law.friction * std::abs(fn) * (1 - 1e-9)) {
      ++sliding;
      Vec3<double> again = spring;
      const auto same = springDashpot<NormalModel::Hooke, TangentialModel::Spring>(law, p.seen, again, 0.0, false);
      for (int d = 0; d < 3; ++d) ASSERT_TRUE(near(same.force[d], f.force[d], {1e-9, std::abs(fn)}));
    }
  }
  EXPECT_GT(sliding, 100);
}

}  // namespace
