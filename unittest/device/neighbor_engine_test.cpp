// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Grains of many sizes in the engine: sizes that come and change, boxes that move, rows of any length.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

Box cube(double edge, std::array<bool, 3> periodic)
{
  Box box;
  for (int d = 0; d < 3; ++d) box.hi[d] = edge;
  box.periodic = periodic;
  return box;
}

SceneSpec springScene(double largest, int levels)
{
  SceneSpec s;
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  s.timestep = 1e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.1;
  s.largestRadius = largest;
  s.levels = levels;
  s.integrators.push_back({});
  return s;
}

/// Grains that overlap as they like, for forces of one moment.
Grains crowd(std::size_t count, const Box &box, double smallest, double largest, unsigned seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  Grains g;
  for (std::size_t i = 0; i < count; ++i) {
    Array3 x{}, v{};
    for (int d = 0; d < 3; ++d) {
      x[d] = uniform(box.lo[d], box.hi[d]);
      v[d] = uniform(-1.0, 1.0);
    }
    g.add(x, v, {0, 0, 0}, uniform(smallest, largest), 1.0);
  }
  return g;
}

class NeighborEngineTest : public OnBackend {
 protected:
  /// Forces of the engine at its present state against those of all pairs.
  void expectForces(Driver &driver, const SceneSpec &scene, const Box &box, const Oracle &springs, std::int64_t step)
  {
    const Grains g = driver.read();
    Oracle oracle(scene, box, g);
    oracle.kept = springs.kept;
    oracle.evaluate(step, false);
    EXPECT_GT(oracle.contacts, 20u) << "the case must have contacts to mean anything";
    EXPECT_LT(largestDifference(g.f, oracle.grains.f), (fine() ? 1e-9 : 2e-3) * largest(oracle.grains.f));
  }
  std::string message(const SceneSpec &scene, const Box &box, const Grains &grains) const
  {
    try {
      const std::unique_ptr<Engine> engine = make();
      Driver driver(*engine, scene, box, grains);
    } catch (const Error &e) {
      return e.what();
    }
    return "";
  }
};

/// A grain larger and one smaller than all others come in the middle of a run; the springs of the others stay.
TEST_P(NeighborEngineTest, InsertionOfALargestAndASmallestGrain)
{
  const Box box = cube(12.0, {true, true, false});
  SceneSpec scene = springScene(0.6, 0);
  Grains start = randomCloud(700, box, 0.2, 0.6, 5);
  Oracle oracle(scene, box, start);
  oracle.evaluate(0, false);
  const std::unique_ptr<Engine> engine = make();
  Driver before(*engine, scene, box, start);
  for (int k = 1; k <= 60; ++k) oracle.step(k);
  before.run(60);
  const std::size_t levels = engine->neighbors().levelRadii.size();

  Saved saved = before.save();
  const auto insert = [&](const Array3 &x, double radius) {
    saved.grains.add(x, {0, 0, 0}, {0, 0, 0}, radius, radius);
    saved.history.offset.push_back(saved.history.offset.back());
    oracle.grains.add(x, {0, 0, 0}, {0, 0, 0}, radius, radius);
  };
  insert({6.0, 6.0, 6.0}, 1.9);
  insert({4.0, 6.0, 6.0}, 0.02);
  scene.largestRadius = 1.9;
  Driver after(*engine, scene, box, saved, 60);
  engine->evaluateForce({}, {});
  EXPECT_GT(engine->neighbors().levelRadii.size(), levels);
  expectForces(after, scene, box, oracle, 60);
}

/// Radii that grow beyond the largest the scene announced, and shrink, between two rebuilds; the windows of the coordinates
/// grow with them.
TEST_P(NeighborEngineTest, RadiiThatChange)
{
  for (const int levels : {0, 1, 5}) {
    const Box box = cube(12.0, {true, false, true});
    SceneSpec scene = springScene(0.4, levels);
    Grains start = randomCloud(900, box, 0.2, 0.4, 6);
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    for (int k = 1; k <= 30; ++k) oracle.step(k);
    driver.run(30);

    for (const double factor : {4.0, 0.1, 2.0}) {
      for (std::size_t i = 0; i < start.size(); i += 97) start.radius[i] *= factor;
      engine->uploadFields(start.view(), fieldShape);
      engine->rebuild(box);
      engine->evaluateForce({}, {});
      Grains now = driver.read();
      now.radius = start.radius;
      Oracle grown(scene, box, now);
      grown.kept = oracle.kept;
      grown.evaluate(30, false);
      EXPECT_LT(largestDifference(now.f, grown.grains.f), (fine() ? 1e-9 : 2e-3) * largest(grown.grains.f)) << factor << ", levels " << levels;
    }
    start.radius[3] = 3.5;  // reach 7.1 of a box of 12
    EXPECT_THROW(engine->uploadFields(start.view(), fieldShape), Error);
  }
}

/// Faces that follow the grains, as a shrink-wrapped box does.
TEST_P(NeighborEngineTest, FacesThatMove)
{
  Box box = cube(10.0, {false, false, false});
  const SceneSpec scene = springScene(0.9, 3);
  const Grains start = randomCloud(500, box, 0.1, 0.9, 7);
  Oracle oracle(scene, box, start);
  oracle.evaluate(0, false);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  for (int k = 1; k <= 20; ++k) oracle.step(k);
  driver.run(20);
  for (int k = 1; k <= 6; ++k) {
    for (int d = 0; d < 3; ++d) {
      box.lo[d] -= 0.37 * k * (d + 1);
      box.hi[d] += (d == 1 ? 60.0 : 0.05) * k;
    }
    engine->rebuild(box);
    engine->evaluateForce({}, {});
    expectForces(driver, scene, box, oracle, 20);
  }
}

/// A periodic box of just twice the interaction range is right, a shorter one is refused.
TEST_P(NeighborEngineTest, ShortestPeriodicBox)
{
  for (const int levels : {1, 4})
    for (const double radius : {0.5, 1.7}) {
      SceneSpec scene = springScene(radius, levels);
      const double least = 2.0 * (2.0 * radius + scene.skin);
      Box box = cube(least * (1.0 + 1e-12), {true, true, true});
      const Grains grains = crowd(80, box, 0.15 * radius, radius, 8);
      {
        const std::unique_ptr<Engine> engine = make();
        Driver driver(*engine, scene, box, grains);
        expectForces(driver, scene, box, Oracle(scene, box, grains), 0);
      }
      for (int d = 0; d < 3; ++d) {
        Box small = box;
        small.hi[d] = least * (1.0 - 1e-6);
        EXPECT_NE(message(scene, small, grains).find("shorter than twice the interaction range"), std::string::npos);
        small.periodic[d] = false;
        EXPECT_EQ(message(scene, small, grains), "");
      }
    }
}

/// Sizes too far apart for one set of coordinates are refused with the numbers.
TEST_P(NeighborEngineTest, SizesBeyondTheResolution)
{
  const Box box = cube(20.0, {false, false, false});
  Grains grains = randomCloud(50, box, 0.3, 0.5, 9);
  SceneSpec scene = springScene(0.5, 0);
  grains.radius[10] = 0.5e-4;
  EXPECT_EQ(message(scene, box, grains), "");
  grains.radius[10] = 0.5e-8;
  const std::string refused = message(scene, box, grains);
  for (const char *phrase : {"radii from 5e-09 to 0.5", "a ratio of 1e+08", "resolve no radius below"})
    EXPECT_NE(refused.find(phrase), std::string::npos) << refused;
}

/// One body touches many: springs survive rebuilds to the last bit, in a row of any length.
TEST_P(NeighborEngineTest, OneBodyTouchesAHundredThousand)
{
  const std::size_t touching = GetParam().emulated ? 2000 : 100000;
  const double small = 0.05, large = small * std::sqrt(static_cast<double>(touching)) * 0.6;
  const Box box = cube(5.0 * large, {true, true, true});
  Grains start;
  const double centre = 2.5 * large, away = large + 0.99 * small;
  start.add({centre, centre, centre}, {0, 0, 0}, {0, 0, 0.1}, large, 1e3);
  for (std::size_t k = 0; k < touching; ++k) {  // Fibonacci's lattice on the sphere
    const double z = 1.0 - (2.0 * k + 1.0) / touching, r = std::sqrt(1.0 - z * z), a = 2.399963229728653 * k;
    start.add({centre + away * r * std::cos(a), centre + away * r * std::sin(a), centre + away * z}, {0, 0, 0}, {0, 0, 0},
              small, 0.01);
  }
  SceneSpec scene = springScene(large, 0);
  scene.skin = 0.02;
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  driver.run(5);
  const auto springs = [&] {
    ContactHistory h;
    engine->downloadHistory(h);
    std::vector<std::array<double, 4>> body;
    for (std::uint32_t m = h.offset[0]; m < h.offset[1]; ++m)
      body.push_back({static_cast<double>(h.partner[m]), h.spring[3 * m], h.spring[3 * m + 1], h.spring[3 * m + 2]});
    std::sort(body.begin(), body.end());
    return body;
  };
  const auto before = springs();
  EXPECT_GE(before.size(), touching);
  for (int k = 0; k < 3; ++k) engine->rebuild(box);
  EXPECT_EQ(springs(), before);
}

/// Bodies that press into many grains each: force, torque, virial and springs of rows of any length, whoever adds them up.
/// Chunks of pairs know no long rows; they are the reference, in the same precision, as grains begin to slip here and there.
TEST_P(NeighborEngineTest, ForcesOnBodiesThatManyTouch)
{
  // rows of two segments or three, and of more than a warp has lanes
  for (const std::size_t touching : {std::size_t(80), std::size_t(600), std::size_t(9000)}) {
    SCOPED_TRACE(touching);
    const double small = 0.05, large = small * std::sqrt(static_cast<double>(touching)) * 0.6;
    Box box;
    box.hi = {10.0 * large, 5.0 * large, 5.0 * large};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    Grains start;
    for (int body = 0; body < 2; ++body) {
      const double centre[3] = {(2.5 + 5.0 * body) * large, 2.5 * large, 2.5 * large};
      start.add({centre[0], centre[1], centre[2]}, {0.3, 0, 0}, {0, 0, 2.0}, large, 1e3);
      for (std::size_t k = 0; k < touching; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / touching, r = std::sqrt(1.0 - z * z), a = 2.399963229728653 * k;
        const double away = large + small * (0.97 + 0.05 * even(random));
        start.add({centre[0] + away * r * std::cos(a), centre[1] + away * r * std::sin(a), centre[2] + away * z},
                  {even(random), even(random), even(random)}, {0, 0, 0}, small, 0.01);
      }
    }
    SceneSpec scene = springScene(large, 0);
    scene.skin = 0.02;
    const std::unique_ptr<Engine> engine = make(), reference = makeEngine({DeviceKind::Cpu, GetParam().precision, 1});
    Driver driver(*engine, scene, box, start), expected(*reference, scene, box, start);
    const std::int64_t steps = touching > 1000 ? 8 : 40;
    driver.run(steps, 16, true);
    expected.run(steps, 16, true);
    const Grains g = driver.read(), e = expected.read();
    const double tolerance = fine() ? 1e-9 : 2e-3;
    EXPECT_LT(largestDifference(g.f, e.f), tolerance * largest(e.f));
    EXPECT_LT(largestDifference(g.t, e.t), tolerance * largest(e.t));
    EXPECT_LT(largestDifference(g.w, e.w), tolerance * largest(e.w));
    for (int d = 0; d < 6; ++d)
      EXPECT_NEAR(engine->observables().virial[d], reference->observables().virial[d],
                  tolerance * std::abs(reference->observables().virial[0]));
  }
}

GPUDEM_ON_ALL_BACKENDS(NeighborEngineTest);

}  // namespace
