// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Closed forms through the whole step: rebound, slip to roll, resting weight, energy.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

SceneSpec base(double dt)
{
  SceneSpec s;
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, 1e5, 2e4, 0.0, 0.0, 0.0, false};
  s.timestep = dt;
  s.halfKick = 0.5 * dt;
  s.skin = 0.1;
  s.largestRadius = 0.5;
  s.integrators.emplace_back();
  return s;
}
Box openBox()
{
  Box b;
  b.lo = {-20.0, -20.0, 0.0};
  b.hi = {20.0, 20.0, 20.0};
  return b;
}
void addFloor(SceneSpec &s, const ContactLaw &law)
{
  WallSpec w;
  w.law = law;
  w.axis = 2;
  w.lo = 0.0;
  s.walls.push_back(w);
  ForceTerm t;
  t.kind = ForceTermKind::Wall;
  t.wall = 0;
  s.terms.push_back(t);
}
void addGravity(SceneSpec &s, const Array3 &g)
{
  ForceTerm t;
  t.kind = ForceTermKind::Gravity;
  t.value = g;
  s.terms.push_back(t);
}

class ClosedForm : public OnBackend {};

/// e = exp(-pi beta/w): spring-dashpot pair with beta = gamma/2, w^2 = k/m* - beta^2.
TEST_P(ClosedForm, RestitutionOfTheSpringDashpotPair)
{
  for (const double gamma : {0.0, 30.0, 100.0}) {
    SceneSpec s = base(1e-6);  // the scheme is of first order in the dashpot
    s.pair.normalDamping = gamma;
    Grains g;
    g.add({-0.5005, 0, 5}, {1, 0, 0}, {0, 0, 0}, 0.5, 1.0);
    g.add({0.5005, 0, 5}, {-1, 0, 0}, {0, 0, 0}, 0.5, 1.0);
    const auto engine = make();
    Driver d(*engine, s, openBox(), g);
    d.run(10000, 64);
    const Grains r = d.read();
    const double beta = gamma / 2, w = std::sqrt(1e5 / 0.5 - beta * beta);
    const double e = std::exp(-std::acos(-1.0) * beta / w);
    EXPECT_TRUE(near((r.v[3] - r.v[0]) / 2.0, e, {1e-4, 1.0})) << gamma;
    EXPECT_TRUE(near(r.v[0], -r.v[3], {fine() ? 0.0 : 2e-5, 1.0})) << "momentum";
  }
}

/// Free fall: v = g t; a rounding error that kept its sign would grow with the number of steps.
TEST_P(ClosedForm, FreeFallDoesNotDrift)
{
  SceneSpec s = base(1e-4);
  addGravity(s, {0.3, 0, -1.7});
  Grains g;
  for (int k = 0; k < 64; ++k)
    g.add({-18.0 + 2.0 * (k % 8), -18.0 + 2.0 * (k / 8), 15.0}, {0.01 * k, 0, 0}, {0, 0, 0}, 0.5, 1.0);
  const auto engine = make();
  Driver d(*engine, s, openBox(), g);
  const int steps = 20000;
  d.run(steps, 64);
  const Grains r = d.read();
  const double t = steps * 1e-4;
  double mean = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    EXPECT_TRUE(near(r.v[3 * i + 2], -1.7 * t, {fine() ? 1e-11 : 2e-5, 1.7 * t})) << i;
    EXPECT_TRUE(near(r.v[3 * i], g.v[3 * i] + 0.3 * t, {fine() ? 1e-11 : 2e-5, 1.7 * t})) << i;
    mean += r.v[3 * i + 2] / r.size();
  }
  EXPECT_TRUE(near(mean, -1.7 * t, {fine() ? 1e-11 : 4e-6, 1.7 * t}));
}

/// An elastic frictionless collision in three dimensions keeps energy and momentum.
TEST_P(ClosedForm, EnergyOfAnElasticCollision)
{
  for (const NormalModel normal : {NormalModel::Hooke, NormalModel::Hertz}) {
    SceneSpec s = base(1e-5);
    s.pair.normal = normal;
    if (normal == NormalModel::Hertz) s.pair.normalStiffness = 1e6;
    Grains g;
    g.add({0, 0, 5}, {1, 0.3, 0}, {0, 0, 0}, 0.5, 1.0);
    g.add({0.93, 0.4, 5.2}, {-1, 0, 0.1}, {0, 0, 0}, 0.4, 0.6);
    const auto energy = [](const Grains &a) {
      double e = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        for (int k = 0; k < 3; ++k) e += 0.5 * a.mass[i] * a.v[3 * i + k] * a.v[3 * i + k];
      return e;
    };
    const auto engine = make();
    Driver d(*engine, s, openBox(), g);
    d.run(12000, 64);
    const Grains r = d.read();
    EXPECT_TRUE(near(energy(r), energy(g), {fine() ? 1e-6 : 1e-4, energy(g)}));
    EXPECT_NE(r.v[0], g.v[0]);
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(near(r.v[k] + 0.6 * r.v[3 + k], g.v[k] + 0.6 * g.v[3 + k], {fine() ? 1e-13 : 2e-6, 1.0}));
  }
}

/// A sphere thrown flat onto a rough floor ends rolling at 5/7 of its speed.
TEST_P(ClosedForm, SlidingBecomesRollingAtFiveSevenths)
{
  SceneSpec s = base(2e-5);
  ContactLaw law = s.pair;
  law.normalDamping = 300.0;
  law.tangentialDamping = 300.0;
  law.friction = 0.5;
  addFloor(s, law);
  addGravity(s, {0, 0, -10});
  Grains g;
  g.add({-5, 0, 0.5 - 1e-4}, {2, 0, 0}, {0, 0, 0}, 0.5, 1.0);
  const auto engine = make();
  Driver d(*engine, s, openBox(), g);
  d.run(40000, 64);
  const Grains r = d.read();
  EXPECT_TRUE(near(r.v[0], 2.0 * 5.0 / 7.0, {1e-3, 2.0}));
  EXPECT_TRUE(near(r.w[1] * 0.5, r.v[0], {1e-3, 2.0}));
}

/// A stack at rest presses its weight on the wall; each contact carries what lies above it.
TEST_P(ClosedForm, RestingStackWeighsOnTheWall)
{
  SceneSpec s = base(1e-4);
  s.pair.normalDamping = 200.0;
  ContactLaw law = s.pair;
  addFloor(s, law);
  s.walls[0].recordContacts = true;
  addGravity(s, {0, 0, -10});
  const int height = 6;
  Grains g;
  for (int k = 0; k < height; ++k) g.add({0, 0, 0.5 + k * 0.9995}, {0, 0, 0}, {0, 0, 0}, 0.5, 2.0);
  const auto engine = make();
  Driver d(*engine, s, openBox(), g);
  d.run(60000, 64);
  const Grains r = d.read();
  std::vector<double> columns(8 * g.size());
  engine->downloadWallContacts(0, columns.data());
  EXPECT_TRUE(near(columns[3], height * 2.0 * 10.0, {fine() ? 1e-9 : 1e-3, height * 20.0}));
  for (int k = 1; k < height; ++k) {
    const double overlap = 1.0 - (r.x[3 * k + 2] - r.x[3 * k - 1]);
    EXPECT_TRUE(near(overlap * 1e5, (height - k) * 20.0, {fine() ? 1e-8 : 1e-3, height * 20.0})) << k;
  }
}

/// Two half kicks around every event give the same path as the fused step, to round-off.
TEST_P(ClosedForm, EventsDoNotDisturbThePath)
{
  Box box;
  box.hi = {7, 7, 7};
  box.periodic = {true, true, true};
  SceneSpec s = base(2e-4);
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  const Grains g = randomCloud(250, box, 0.35, 0.5, 8);
  std::vector<Grains> results;
  for (const int every : {100, 1}) {
    const auto engine = make();
    Driver d(*engine, s, box, g);
    for (int step = every; step <= 100; step += every) d.run(step);
    results.push_back(d.read());
  }
  EXPECT_LT(largestDifference(results[0].x, results[1].x), fine() ? 1e-12 : 1e-5);
  EXPECT_LT(largestDifference(results[0].v, results[1].v), fine() ? 1e-10 : 1e-2);
}

GPUDEM_ON_ALL_BACKENDS(ClosedForm);

}  // namespace
