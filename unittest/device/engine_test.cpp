// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The resident step against the brute-force oracle, on every backend and in every precision.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/tolerance.h"

#include <map>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

struct Case {
  const char *name;
  NormalModel normal;
  TangentialModel tangential;
  std::array<bool, 3> periodic;
  int dimension;
  int levels = 0;    ///< of the neighbour search
  Array3 common{};  ///< velocity that all grains share at the start (distance/time)
};

const Case cases[] = {
    {"hooke, periodic", NormalModel::Hooke, TangentialModel::Viscous, {true, true, true}, 3},
    {"hooke springs, periodic", NormalModel::Hooke, TangentialModel::Spring, {true, true, true}, 3},
    {"hertz springs, walls in z", NormalModel::Hertz, TangentialModel::Spring, {true, true, false}, 3},
    {"hooke frictionless, closed box", NormalModel::Hooke, TangentialModel::None, {false, false, false}, 3},
    {"hooke springs, closed box", NormalModel::Hooke, TangentialModel::Spring, {false, false, false}, 3},
    {"hooke springs, two dimensions", NormalModel::Hooke, TangentialModel::Spring, {true, false, true}, 2},
    {"hooke springs, three levels", NormalModel::Hooke, TangentialModel::Spring, {true, true, false}, 3, 3},
    {"hertz springs, four levels, two dimensions", NormalModel::Hertz, TangentialModel::Spring, {false, true, true}, 2, 4},
    {"hooke springs, in common motion along the walls", NormalModel::Hooke, TangentialModel::Spring,
     {true, true, false}, 3, 0, {40.0, -15.0, 0.0}},
    {"hertz springs, in common motion against a wall", NormalModel::Hertz, TangentialModel::Spring,
     {false, true, true}, 3, 0, {-25.0, 0.0, 3.0}},
};

SceneSpec makeScene(const Case &c, const Box &box, double largest)
{
  SceneSpec s;
  s.pair = {c.normal, c.tangential, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  s.timestep = 2e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.2;
  s.largestRadius = largest;
  s.levels = c.levels;
  s.types = 2;
  for (int d = 0; d < 3; ++d) {
    if (box.periodic[d] || (d == 2 && box.dimension == 2)) continue;
    WallSpec w;
    w.law = s.pair;
    if (w.law.tangential == TangentialModel::None) w.law.tangential = TangentialModel::Viscous;
    w.axis = d;
    w.lo = box.lo[d];
    w.hi = box.hi[d];
    ForceTerm t;
    t.kind = ForceTermKind::Wall;
    t.wall = static_cast<int>(s.walls.size());
    s.walls.push_back(w);
    s.terms.push_back(t);
  }
  ForceTerm gravity;
  gravity.kind = ForceTermKind::Gravity;
  gravity.value = {1.0, 0.0, box.dimension == 2 ? 0.0 : -5.0};
  s.terms.push_back(gravity);
  IntegratorSpec all;
  all.inertia = box.dimension == 2 ? 0.5 : 0.4;
  s.integrators.push_back(all);
  return s;
}

class EngineTest : public OnBackend {};

TEST_P(EngineTest, FollowsTheOracleThroughRebuilds)
{
  for (const Case &c : cases) {
    SCOPED_TRACE(c.name);
    Box box;
    box.lo = {-2.0, 1.0, c.dimension == 2 ? -0.5 : 0.0};
    box.hi = {6.0, 8.5, c.dimension == 2 ? 0.5 : 7.0};
    box.periodic = c.periodic;
    box.dimension = c.dimension;
    Grains start = randomCloud(c.dimension == 2 ? 45 : 260, box, 0.3, 0.5, 42);
    for (std::size_t k = 0; k < start.v.size(); ++k) start.v[k] += c.common[k % 3];
    const SceneSpec scene = makeScene(c, box, 0.5);
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    std::size_t contactSteps = 0;
    for (int event = 1; event <= 4; ++event) {
      const int steps = 100;
      for (int k = 1; k <= steps; ++k) {
        oracle.step((event - 1) * steps + k);
        contactSteps += oracle.contacts;
      }
      driver.run(event * steps, 7, true);
      const Grains g = driver.read();
      // the system is chaotic: round-off grows about tenfold in a hundred steps here
      const double growth = std::pow(10.0, event);
      const double eps = fine() ? 1e-14 : 2e-7;
      EXPECT_LT(largestDifference(g.x, oracle.grains.x), growth * eps * 8.0) << event;
      EXPECT_LT(largestDifference(g.v, oracle.grains.v), growth * eps * 20.0 * largest(g.v)) << event;
      EXPECT_LT(largestDifference(g.w, oracle.grains.w), growth * eps * 50.0 * largest(g.w)) << event;
      if (fine()) {
        EXPECT_LT(largestDifference(g.f, oracle.grains.f), growth * eps * 1e4 * largest(g.f)) << event;
        for (int k = 0; k < 6; ++k)
          EXPECT_TRUE(near(engine->observables().virial[k], oracle.virial[k], {growth * 1e-11, 1e3})) << k;
      }
    }
    EXPECT_GT(contactSteps, 200u) << "the case must have contacts to mean anything";
    EXPECT_GT(engine->neighbors().rebuilds, 1) << "the case must rebuild to mean anything";
    EXPECT_GE(engine->neighbors().levelRadii.size(), c.levels ? 3u : 1u);
  }
}

/// Rows wear out by motion against each other only.
TEST_P(EngineTest, CommonMotionAsksForNoRebuild)
{
  Box box;
  box.hi = {9.0, 10.0, 9.5};
  box.periodic = {true, true, true};
  SceneSpec scene = makeScene(cases[0], box, 0.5);
  scene.terms.clear();
  const auto rebuilds = [&](double common) {
    Grains start = randomCloud(300, box, 0.3, 0.5, 3);
    for (std::size_t k = 0; k < start.v.size(); ++k) start.v[k] = 0.1 * start.v[k] + (k % 3 == 0 ? common : 0.0);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    driver.run(300, 16);
    return engine->neighbors().rebuilds;
  };
  EXPECT_LE(rebuilds(50.0), rebuilds(0.0) + 10);  // the frame may run ahead of the grains by twice the skin: 0.4 of 3.0
}

/// The last grain may have gone while all moved together.
TEST_P(EngineTest, StepsWithoutGrainsGoOn)
{
  Box box;
  box.hi = {9.0, 10.0, 9.5};
  SceneSpec scene = makeScene(cases[0], box, 0.5);
  Grains start = randomCloud(30, box, 0.3, 0.5, 3);
  for (std::size_t k = 0; k < start.v.size(); ++k) start.v[k] = k % 3 == 0 ? 50.0 : 0.0;
  const std::unique_ptr<Engine> engine = make();
  Driver(*engine, scene, box, start).run(60, 16);
  HostParticles none;
  engine->upload(none, box, nullptr);
  engine->rebuild(box);
  engine->evaluateForce({}, {});
  engine->beginStep({});
  engine->queueStep({});
  const Progress p = engine->flush();
  EXPECT_EQ(p.executed, 1);
  EXPECT_FALSE(p.needsRebuild);
}

TEST_P(EngineTest, SetupForceAgreesWithTheOracle)
{
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    Box box;
    box.hi = {9.0, 10.0, 9.5};
    box.periodic = {true, true, true};
    const Grains start = randomCloud(1400, box, 0.1, 0.5, seed);  // several chunks of the CPU
    Case c{"", NormalModel::Hooke, TangentialModel::Viscous, box.periodic, 3};
    SceneSpec scene = makeScene(c, box, 0.5);
    scene.exclusions.types.emplace_back(2, 2);
    scene.frozenMask = 2;
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    const Grains g = driver.read();
    const double eps = fine() ? 1e-12 : 2e-5;
    EXPECT_GT(oracle.contacts, 10u);
    EXPECT_LT(largestDifference(g.f, oracle.grains.f), eps * largest(g.f)) << seed;
    EXPECT_LT(largestDifference(g.t, oracle.grains.t), eps * largest(g.t)) << seed;
  }
}

/// Newton's third law to the last bit: two grains alone get exactly opposite forces.
TEST_P(EngineTest, PairForcesAreOppositeToTheLastBit)
{
  Box box;
  box.hi = {20.0, 20.0, 20.0};
  box.periodic = {true, true, true};
  Grains start;
  std::mt19937 random(13);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 150; ++k) {
    const Array3 at{2.0 + 4.0 * (k % 5), 2.0 + 4.0 * (k / 5 % 5), 0.01 + 3.1 * (k / 25)};
    start.add(at, {u(random), u(random), u(random)}, {u(random), u(random), u(random)}, 0.5, 1.0);
    start.add({at[0] + 0.5 * u(random), at[1] + 0.5 * u(random), at[2] - 0.6}, {u(random), u(random), u(random)},
              {u(random), u(random), u(random)}, 0.4, 0.7);
  }
  Case c{"", NormalModel::Hertz, TangentialModel::Spring, box.periodic, 3};
  SceneSpec scene = makeScene(c, box, 0.5);
  scene.terms.clear();
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  for (const int step : {1, 20}) {
    driver.run(step);
    const Grains g = driver.read();
    int touching = 0;
    for (std::size_t i = 0; i < g.size(); i += 2)
      for (int d = 0; d < 3; ++d) {
        ASSERT_EQ(g.f[3 * i + d], -g.f[3 * i + 3 + d]);
        if (g.f[3 * i + d] != 0.0) ++touching;
      }
    EXPECT_GT(touching, 100);
  }
}

TEST_P(EngineTest, TwoRunsAreBitwiseEqualWhateverTheThreadsAndBatches)
{
  Box box;
  box.hi = {14.0, 14.0, 14.0};
  box.periodic = {true, true, false};
  const Grains start = randomCloud(3100, box, 0.35, 0.5, 4);  // enough for three threads
  Case c{"", NormalModel::Hooke, TangentialModel::Spring, box.periodic, 3};
  const SceneSpec scene = makeScene(c, box, 0.5);
  std::vector<Grains> results;
  for (const auto &[threads, batch] : {std::pair{1, 5}, std::pair{2, 64}, std::pair{3, 1}}) {
    const std::unique_ptr<Engine> engine = make(threads);
    Driver driver(*engine, scene, box, start);
    driver.run(300, batch);
    results.push_back(driver.read());
  }
  for (const Grains &g : results) {
    EXPECT_EQ(g.x, results[0].x);
    EXPECT_EQ(g.v, results[0].v);
    EXPECT_EQ(g.w, results[0].w);
    EXPECT_EQ(g.f, results[0].f);
  }
}

using Springs = std::map<std::pair<int, int>, std::array<double, 3>>;

Springs springsOf(Engine &engine, const Grains &g)
{
  ContactHistory h;
  engine.downloadHistory(h);
  Springs s;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::uint32_t m = h.offset[i]; m < h.offset[i + 1]; ++m)
      s[{g.tag[i], h.partner[m]}] = {h.spring[3 * m], h.spring[3 * m + 1], h.spring[3 * m + 2]};
  return s;
}

TEST_P(EngineTest, SpringsSurviveRebuildsAndUploadsExactly)
{
  Box box;
  box.hi = {10.0, 10.0, 10.0};
  box.periodic = {true, false, true};
  const Grains start = randomCloud(1200, box, 0.3, 0.5, 6);
  Case c{"", NormalModel::Hertz, TangentialModel::Spring, box.periodic, 3};
  const SceneSpec scene = makeScene(c, box, 0.5);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  driver.run(200);
  const Springs before = springsOf(*engine, start);
  ASSERT_GT(before.size(), 50u);
  for (const auto &[key, spring] : before) {  // both sides of a contact hold opposite springs
    const auto other = before.find({key.second, key.first});
    ASSERT_NE(other, before.end());
    for (int d = 0; d < 3; ++d) ASSERT_EQ(spring[d], -other->second[d]);
  }
  engine->rebuild(box);
  EXPECT_EQ(springsOf(*engine, start), before);
  engine->rebuild(box);
  EXPECT_EQ(springsOf(*engine, start), before);

  ContactHistory h;
  engine->downloadHistory(h);
  Grains g = driver.read();
  for (std::size_t i = 0; i < g.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      const int image = ((g.image[i] >> (10 * d)) & 1023) - 512;
      g.x[3 * i + d] -= image * (box.hi[d] - box.lo[d]);
    }
  const std::unique_ptr<Engine> second = make();
  second->setScene(scene);
  second->upload(g.view(), box, &h);
  second->rebuild(box);
  EXPECT_EQ(springsOf(*second, g), before);
}

/// More groups than the word of a grain has room for beside the lower bits of its position, and back to few.
TEST_P(EngineTest, ManyGroupsActOnTheirOwnGrains)
{
  Box box;
  box.hi = {5.0, 5.0, 5.0};
  box.periodic = {true, true, true};
  Grains start = randomCloud(200, box, 0.3, 0.5, 8);
  std::mt19937 random(5);
  for (int &mask : start.mask) mask = 1 | static_cast<int>(random() & 0xffffu) << 1;
  Case c{"", NormalModel::Hooke, TangentialModel::Spring, box.periodic, 3};
  const std::unique_ptr<Engine> engine = make();
  for (const int groups : {14, 3}) {
    SCOPED_TRACE(groups);
    SceneSpec scene = makeScene(c, box, 0.5);
    scene.frozenMask = 0;
    for (int k = 0; k < groups; ++k) {
      ForceTerm pull;
      pull.groupMask = 2u << k;
      pull.value = {0.5 * k, 3.0 - k, 1.0};
      scene.terms.push_back(pull);
    }
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    Driver driver(*engine, scene, box, start);
    for (int k = 1; k <= 60; ++k) oracle.step(k);
    driver.run(60);
    const Grains g = driver.read();
    const double eps = fine() ? 1e-11 : groups > 8 ? 3e-5 : 1e-5;
    EXPECT_LT(largestDifference(g.v, oracle.grains.v), eps * largest(g.v));
    EXPECT_GT(oracle.contacts, 10u);
  }
}

/// A box that becomes 10^5 times longer takes larger cells and larger windows; the grains do not notice.
TEST_P(EngineTest, BoxMayOutgrowItsWindows)
{
  Box box;
  box.hi = {5.0, 5.0, 5.0};
  const Grains start = randomCloud(100, box, 0.3, 0.5, 3);
  Case c{"", NormalModel::Hooke, TangentialModel::Spring, {true, true, true}, 3};  // no walls
  const SceneSpec scene = makeScene(c, box, 0.5);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  driver.run(20);
  const Springs springs = springsOf(*engine, start);
  StepInputs in;
  in.step = 20;
  engine->evaluateForce(in, {});  // with the velocities at the step, as below
  const Grains before = driver.read();
  Box grown = box;
  grown.hi = {5.0e5, 5.0e5, 5.0e5};
  grown.lo = {-1.0e4, 0.0, 0.0};
  engine->rebuild(grown);
  engine->evaluateForce(in, {});
  const Grains after = driver.read();
  const double unit = fine() ? 1e-11 : 1e-6;  // window/2^53 and window/2^40 of windows of some 10^5
  EXPECT_LT(largestDifference(after.x, before.x), unit);
  EXPECT_EQ(after.v, before.v);
  EXPECT_LT(largestDifference(after.f, before.f), unit * 2.0 * scene.pair.normalStiffness + 1e-5 * largest(before.f));
  EXPECT_EQ(springsOf(*engine, start), springs);
  ASSERT_GT(springs.size(), 5u);
}

/// The same cloud 10^4 diameters away from the origin of its box behaves the same.
TEST_P(EngineTest, AccuracyDoesNotDependOnWhereTheGrainsAre)
{
  Case c{"", NormalModel::Hooke, TangentialModel::Spring, {false, false, false}, 3};
  std::vector<Grains> results;
  for (const double far : {0.0, 8192.0}) {
    Box inner;
    inner.hi = {6.0, 6.0, 6.0};
    Grains start = randomCloud(150, inner, 0.3, 0.5, 21);
    Box box;
    box.lo = {-10.0, -10.0, -10.0};
    box.hi = {far + 20.0, 20.0, 20.0};
    for (std::size_t i = 0; i < start.size(); ++i) start.x[3 * i] += far;
    SceneSpec scene = makeScene(c, inner, 0.5);
    scene.walls.clear();
    scene.terms.clear();
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    driver.run(100);
    results.push_back(driver.read());
    for (std::size_t i = 0; i < start.size(); ++i) results.back().x[3 * i] -= far;
  }
  // double: the round-off of the far input coordinates (1e-12); mixed: the 2e-9 unit of the coordinates
  const double eps = fine() ? 1e-9 : 2e-5;
  EXPECT_LT(largestDifference(results[0].x, results[1].x), 0.1 * eps);
  EXPECT_LT(largestDifference(results[0].v, results[1].v), 100 * eps);
}

TEST_P(EngineTest, BadInputIsNamed)
{
  Box box;
  box.hi = {8.0, 8.0, 8.0};
  box.periodic = {true, true, true};
  Case c{"", NormalModel::Hooke, TangentialModel::Viscous, box.periodic, 3};
  const SceneSpec scene = makeScene(c, box, 0.5);
  const std::unique_ptr<Engine> engine = make();
  const auto message = [&](Grains g, const Box &b, int steps) -> std::string {
    try {
      Driver driver(*engine, scene, b, std::move(g));
      if (steps) driver.run(steps);
    } catch (const Error &e) {
      return e.what();
    }
    return "";
  };
  Grains g = randomCloud(20, box, 0.4, 0.5, 1);
  g.radius[7] = 0.0;
  EXPECT_NE(message(g, box, 0).find("atom 8 has radius 0"), std::string::npos);
  g = randomCloud(20, box, 0.4, 0.5, 1);
  g.mass[3] = std::nan("");
  EXPECT_NE(message(g, box, 0).find("atom 4 has radius"), std::string::npos);
  g = randomCloud(20, box, 0.4, 0.5, 1);
  g.v[3 * 5] = std::nan("");
  EXPECT_NE(message(g, box, 10).find("atom 6"), std::string::npos);
  g = randomCloud(20, box, 0.4, 0.5, 1);
  g.v[3 * 9 + 1] = 1e9;
  EXPECT_NE(message(g, box, 10).find("atom 10"), std::string::npos);
  Box small = box;
  small.hi[1] = 2.0;
  EXPECT_NE(message(Grains(), small, 0).find("shorter than twice"), std::string::npos);
}

/// Grains placed exactly side by side do not touch: no damping, no friction, whatever their velocities.
TEST_P(EngineTest, ExactNeighboursOnALatticeAreNoContacts)
{
  Box box;
  box.lo = {0.1, 0.2, 0.3};
  box.hi = {10.1, 10.2, 10.3};
  box.periodic = {true, true, true};
  Grains start;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k)
    start.add({0.1 + k % 10, 0.2 + k / 10 % 10, 0.3 + k / 100}, {u(random), u(random), u(random)},
              {u(random), u(random), u(random)}, 0.5, 1.0);
  Case c{"", NormalModel::Hooke, TangentialModel::Viscous, box.periodic, 3};
  SceneSpec scene = makeScene(c, box, 0.5);
  scene.terms.clear();
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  EXPECT_EQ(largest(driver.read().f), 0.0);
}

/// A big grain among small ones: rows of any length are kept.
TEST_P(EngineTest, LongRowsLoseNothing)
{
  Box box;
  box.hi = {10.0, 10.0, 10.0};
  box.periodic = {true, true, true};
  Grains start = randomCloud(1, box, 2.0, 2.0, 1);
  start.x = {5.0, 5.0, 5.0};
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 900; ++k) {
    double a[3] = {normal(random), normal(random), normal(random)};
    const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (double &x : a) x *= 2.09 / length;
    start.add({5.0 + a[0], 5.0 + a[1], 5.0 + a[2]}, {a[1], -a[0], 0.1}, {0, 0, 0}, 0.1, 0.01);
  }
  Case c{"", NormalModel::Hooke, TangentialModel::Spring, box.periodic, 3};
  SceneSpec scene = makeScene(c, box, 2.0);
  scene.pair.normalStiffness = 100.0;
  scene.pair.tangentialStiffness = 30.0;
  scene.exclusions.groups.clear();
  Oracle oracle(scene, box, start);
  oracle.evaluate(0, false);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  for (int k = 1; k <= 20; ++k) oracle.step(k);
  driver.run(20);
  const Grains g = driver.read();
  const double eps = fine() ? 1e-11 : 3e-5;
  EXPECT_LT(largestDifference(g.v, oracle.grains.v), eps * largest(g.v));
  EXPECT_GE(springsOf(*engine, start).size(), 1800u);
}

GPUDEM_ON_ALL_BACKENDS(EngineTest);

}  // namespace
