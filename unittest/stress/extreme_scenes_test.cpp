// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Scenes at the edges of what numbers hold: the answer of the oracle, or an error that names atom and step.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/tolerance.h"

#include <cmath>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

SceneSpec sceneOf(double stiffness, double friction, double timestep, double largest)
{
  SceneSpec s;
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, stiffness, 0.3 * stiffness, 20.0, 10.0, friction, false};
  s.timestep = timestep;
  s.halfKick = 0.5 * timestep;
  s.skin = 0.4 * largest;
  s.largestRadius = largest;
  s.types = 2;
  IntegratorSpec all;
  all.inertia = 0.4;
  s.integrators.push_back(all);
  return s;
}

/// Largest difference of positions after \p steps, in units of \p length; the oracle's contact evaluations are counted.
double strayOf(Engine &engine, const SceneSpec &scene, const Box &box, const Grains &start, int steps, double length,
               std::size_t &contacts)
{
  Oracle oracle(scene, box, start);
  oracle.evaluate(0, false);
  Driver driver(engine, scene, box, start);
  for (int k = 1; k <= steps; ++k) {
    oracle.step(k);
    contacts += oracle.contacts;
  }
  driver.run(steps, 7);
  const Grains g = driver.read();
  for (std::size_t k = 0; k < g.x.size(); ++k)
    if (!std::isfinite(g.x[k]) || !std::isfinite(g.v[k])) return INFINITY;
  return largestDifference(g.x, oracle.grains.x) / length;
}

Box cubeBox(double edge)
{
  Box box;
  box.hi = {edge, edge, edge};
  box.periodic = {true, true, true};
  return box;
}

class ExtremeScenes : public OnBackend {
 protected:
  /// Of a position in diameters: round-off (2^-40 of a window in mixed) over a hundred steps of contacts.
  double stray() const { return fine() ? 1e-9 : 2e-4; }
};

TEST_P(ExtremeScenes, MassesOverTwelveDecades)
{
  const Box box = cubeBox(6.0);
  Grains start = randomCloud(150, box, 0.3, 0.5, 11);
  for (std::size_t i = 0; i < start.size(); ++i) start.mass[i] = std::pow(10.0, static_cast<double>(i % 13) - 6.0);
  SceneSpec scene = sceneOf(1e2, 0.5, 1e-5, 0.5);
  scene.pair.normalDamping = scene.pair.tangentialDamping = 0.0;
  std::size_t contacts = 0;
  EXPECT_LT(strayOf(*make(), scene, box, start, 150, 1.0, contacts), stray());
  EXPECT_GT(contacts, 1000u);
}

TEST_P(ExtremeScenes, StiffnessOverTwelveDecades)
{
  for (const double stiffness : {1e-2, 1e2, 1e6, 1e10}) {
    SCOPED_TRACE(stiffness);
    const Box box = cubeBox(5.0);
    const Grains start = randomCloud(120, box, 0.3, 0.5, 12);
    std::size_t contacts = 0;
    const double dt = std::min(1e-3, 0.02 / std::sqrt(stiffness));
    EXPECT_LT(strayOf(*make(), sceneOf(stiffness, 0.5, dt, 0.5), box, start, 100, 1.0, contacts), stray());
    EXPECT_GT(contacts, 300u);
  }
}

TEST_P(ExtremeScenes, SizesOneToAHundred)
{
  const Box box = cubeBox(4.2);
  Grains start;
  start.add({2.0, 2.0, 2.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1.0, 4.0);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 400; ++k) {  // a coat of small grains that touch the large one
    Array3 n{normal(random), normal(random), normal(random)};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double r = 0.01 * (1.0 + 0.5 * (k % 3));
    Array3 at{}, v{};
    for (int d = 0; d < 3; ++d) {
      at[d] = 2.0 + (1.0 + 0.9 * r) * n[d] / length;
      v[d] = -0.2 * n[d] / length;
    }
    start.add(at, v, {}, r, 4.0 * r * r * r);
  }
  for (const int levels : {0, 1, 6}) {
    SCOPED_TRACE(levels);
    SceneSpec scene = sceneOf(1e3, 0.5, 1e-5, 1.0);
    scene.pair.normalDamping = 1.0;
    scene.skin = 0.01;
    scene.levels = levels;
    std::size_t contacts = 0;
    EXPECT_LT(strayOf(*make(), scene, box, start, 100, 0.01, contacts), 10.0 * stray());
    EXPECT_GT(contacts, 5000u);
  }
}

TEST_P(ExtremeScenes, OverlapsUpToARadius)
{
  const Box box = cubeBox(8.0);
  Grains start;
  for (int k = 0; k < 64; ++k) {
    const Array3 at{1.0 + 2.0 * (k % 4), 1.0 + 2.0 * (k / 4 % 4), 1.0 + 2.0 * (k / 16)};
    start.add(at, {}, {0.0, 0.0, 1.0}, 0.5, 1.0);
    const double apart = 0.5 + 0.5 * k / 64.0;  // of the centres: overlaps of 0.5 to 0 diameters
    start.add({at[0] + apart, at[1], at[2]}, {}, {}, 0.5, 1.0);
  }
  std::size_t contacts = 0;
  EXPECT_LT(strayOf(*make(), sceneOf(1e3, 0.5, 1e-4, 0.5), box, start, 100, 1.0, contacts), stray());
  EXPECT_GT(contacts, 3000u);
}

TEST_P(ExtremeScenes, FrictionAndDampingFromNothingToMuch)
{
  for (const double friction : {0.0, 0.01, 10.0})
    for (const double damping : {0.0, 1.0, 300.0}) {
      SCOPED_TRACE(::testing::Message() << friction << ' ' << damping);
      const Box box = cubeBox(5.0);
      SceneSpec scene = sceneOf(2e4, friction, 1e-4, 0.5);
      scene.pair.normalDamping = damping;
      scene.pair.tangentialDamping = 0.5 * damping;
      std::size_t contacts = 0;
      EXPECT_LT(strayOf(*make(), scene, box, randomCloud(120, box, 0.3, 0.5, 14), 100, 1.0, contacts), stray());
      EXPECT_GT(contacts, 300u);
    }
}

/// A grain that crosses its radius in one step.
TEST_P(ExtremeScenes, ImpactsFasterThanARadiusAStep)
{
  for (const double speed : {100.0, 500.0, 1100.0}) {  // 0.1 to 1.1 diameters a step
    SCOPED_TRACE(speed);
    const Box box = cubeBox(10.0);
    Grains start = randomCloud(80, box, 0.3, 0.5, 15);
    for (std::size_t i = 0; i < start.size(); i += 4) start.v[3 * i] = i % 8 ? -speed : speed;
    SceneSpec scene = sceneOf(1e4, 0.5, 1e-3, 0.5);
    scene.pair.normalDamping = 5.0;
    std::size_t contacts = 0;
    // a contact that begins half a grain deep amplifies round-off more than a slow one
    EXPECT_LT(strayOf(*make(), scene, box, start, 20, 1.0, contacts), fine() ? 1e-8 : 1e-2);
    EXPECT_GT(contacts, 20u);
  }
}

TEST_P(ExtremeScenes, GrainsThatPassOthersInOneStepAreNamed)
{
  const Box box = cubeBox(10.0);
  Grains start = randomCloud(80, box, 0.3, 0.5, 15);
  start.v[3 * 40] = 3000.0;
  const std::unique_ptr<Engine> engine = make();
  try {
    Driver driver(*engine, sceneOf(1e4, 0.5, 1e-3, 0.5), box, start);
    driver.run(20);
    ADD_FAILURE() << "three diameters in one step pass unnoticed";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("atom 41 at step 1 "), std::string::npos) << e.what();
  }
}

TEST_P(ExtremeScenes, AMillionDiametersFromTheOrigin)
{
  Box box;
  box.lo = {1e6, -2e6, 3e6};
  box.hi = {1e6 + 5.0, -2e6 + 5.0, 3e6 + 5.0};
  box.periodic = {true, true, true};
  std::size_t contacts = 0;
  // the host's own coordinates have a unit of 5e-10 there
  EXPECT_LT(strayOf(*make(), sceneOf(2e4, 0.5, 1e-4, 0.5), box, randomCloud(120, box, 0.3, 0.5, 16), 100, 1.0, contacts),
            fine() ? 1e-7 : stray());
  EXPECT_GT(contacts, 300u);
}

TEST_P(ExtremeScenes, ABoxAHundredThousandTimesLongerThanWide)
{
  for (const bool periodic : {true, false}) {
    SCOPED_TRACE(periodic);
    Box box;
    box.hi = {3e5, 3.0, 3.0};
    box.periodic = {periodic, true, true};
    Grains start;
    std::mt19937 random(17);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 60; ++k) {
      const double x = 0.5 + (3e5 - 2.0) * k / 59.0;
      start.add({x, 1.0, 1.0}, {3.0, 0.0, 0.0}, {}, 0.5, 1.0);
      start.add({x + 1.05, 1.0 + 0.2 * u(random), 1.0}, {-3.0, 0.0, 0.0}, {}, 0.5, 1.0);
    }
    std::size_t contacts = 0;
    EXPECT_LT(strayOf(*make(), sceneOf(2e4, 0.5, 1e-4, 0.5), box, start, 300, 1.0, contacts), fine() ? 1e-7 : stray());
    EXPECT_GT(contacts, 300u);
  }
}

/// Coordinates on the faces of cells and of the box, where rounding decides to which cell a grain belongs.
TEST_P(ExtremeScenes, GrainsOnTheFacesOfCells)
{
  for (const double radius : {0.5, 0.505}) {
    SCOPED_TRACE(radius);
    const Box box = cubeBox(6.0);
    Grains start;
    for (int k = 0; k < 216; ++k)
      start.add({1.0 * (k % 6), 1.0 * (k / 6 % 6), 1.0 * (k / 36)}, {}, {}, radius, 1.0, 1, 1);
    start.v[3 * 100] = 1.0;
    SceneSpec scene = sceneOf(1e4, 0.5, 1e-4, radius);
    scene.skin = 1.5 - 2.0 * radius;  // cells of 1.5: every third grain on a face
    std::size_t contacts = 0;
    EXPECT_LT(strayOf(*make(), scene, box, start, 200, 1.0, contacts), stray());
    if (radius > 0.5) EXPECT_GT(contacts, 216u * 3 * 200 / 2);
  }
}

/// Two centres at one place have no direction to part: the run must end, or carry on with numbers.
TEST_P(ExtremeScenes, CoincidentCentresAreNamed)
{
  const Box box = cubeBox(5.0);
  Grains start = randomCloud(50, box, 0.3, 0.5, 18);
  for (int d = 0; d < 3; ++d) start.x[3 * 31 + d] = start.x[3 * 7 + d];
  const std::unique_ptr<Engine> engine = make();
  try {
    Driver driver(*engine, sceneOf(1e3, 0.5, 1e-4, 0.5), box, start);
    driver.run(50);
    const Grains g = driver.read();
    for (std::size_t k = 0; k < g.x.size(); ++k) ASSERT_TRUE(std::isfinite(g.x[k]) && std::isfinite(g.v[k])) << k / 3;
  } catch (const Error &e) {
    const std::string what = e.what();
    EXPECT_TRUE(what.find("atom 8") != std::string::npos || what.find("atom 32") != std::string::npos) << what;
  }
}

/// Beyond the stability limit the energy grows until grains are too fast for any neighbour search.
TEST_P(ExtremeScenes, UnstableTimestepsAreNamed)
{
  for (const double dt : {2.0, 1e3}) {  // of 1/sqrt(k/m)
    SCOPED_TRACE(dt);
    const Box box = cubeBox(5.0);
    const std::unique_ptr<Engine> engine = make();
    SceneSpec scene = sceneOf(1e6, 0.5, 3e-3 * dt, 0.5);
    scene.pair.normalDamping = scene.pair.tangentialDamping = 0.0;
    try {
      Driver driver(*engine, scene, box, randomCloud(120, box, 0.3, 0.5, 19));
      driver.run(20000);
      const Grains g = driver.read();
      for (std::size_t k = 0; k < g.x.size(); ++k) ASSERT_TRUE(std::isfinite(g.x[k]) && std::isfinite(g.v[k])) << k / 3;
    } catch (const Error &e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("atom"), std::string::npos) << what;
      EXPECT_NE(what.find("step"), std::string::npos) << what;
    }
  }
}

/// Any number of stops and continuations from what was saved: the run without them.
TEST_P(ExtremeScenes, HundredsOfContinuations)
{
  const Box box = cubeBox(5.0);
  const Grains start = randomCloud(120, box, 0.3, 0.5, 20);
  const SceneSpec scene = sceneOf(2e4, 0.5, 1e-4, 0.5);
  const std::unique_ptr<Engine> straight = make();
  Driver whole(*straight, scene, box, start);
  whole.run(400);
  const Grains expected = whole.read();

  const std::unique_ptr<Engine> engine = make();
  Saved saved;
  std::vector<double> unwrapped;
  {
    Driver first(*engine, scene, box, start);
    first.run(2);
    saved = first.save();
  }
  for (int step = 4; step <= 400; step += 2) {
    Driver next(*engine, scene, box, saved, step - 2);
    next.run(step);
    if (step == 400) unwrapped = next.read().x;
    saved = next.save();
  }
  EXPECT_LT(largestDifference(unwrapped, expected.x), fine() ? 1e-10 : 2e-5);
}

/// A pulse along a chain of touching grains runs at d sqrt(k/m) for long waves (Nesterenko, Dynamics of Heterogeneous
/// Materials, Springer 2001, chapter 1) and keeps momentum and energy.
TEST_P(ExtremeScenes, ShockAlongAChain)
{
  const int n = GetParam().emulated ? 2000 : 100000;
  const double overlap = 0.01, stiffness = 1e4, radius = 0.5 * (1.0 + overlap);
  Box box;
  box.hi = {1.0 * n, 3.0, 3.0};
  box.periodic = {true, true, true};
  Grains start;
  for (int k = 0; k < n; ++k) start.add({k + 0.5, 1.5, 1.5}, {k < n / 2 && k >= n / 2 - 40 ? 0.2 : 0.0, 0.0, 0.0}, {}, radius, 1.0);
  SceneSpec scene = sceneOf(stiffness, 0.5, 5e-4, radius);
  scene.pair.normalDamping = scene.pair.tangentialDamping = 0.0;
  scene.skin = 0.1;
  const int steps = 1000;
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  driver.run(steps);
  const Grains g = driver.read();
  double momentum = 0.0;
  int front = 0;
  for (int k = 0; k < n; ++k) {
    momentum += g.v[3 * k];
    if (k >= n / 2 && g.v[3 * k] > 0.05) front = k;
  }
  const double expected = n / 2 + std::sqrt(stiffness) * steps * scene.timestep;  // half of the pulse runs ahead
  EXPECT_NEAR(front, expected, 3.0);
  EXPECT_NEAR(momentum, 40 * 0.2, fine() ? 1e-10 : 1e-4);
}

}  // namespace

GPUDEM_ON_ALL_BACKENDS(ExtremeScenes);
