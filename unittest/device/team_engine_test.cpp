// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file One warp or four to 32 grains: the same bits.

#include "testing/backends.h"
#include "testing/driver.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

class TeamEngineTest : public OnBackend {
 protected:
  std::unique_ptr<Engine> makeWith(int warps) const
  {
    if (GetParam().emulated) return makeEmulatedEngine(GetParam().precision, warps);
    return makeEngine({GetParam().device, GetParam().precision, 1, 0, warps});
  }
  void expectSameBits(const SceneSpec &scene, const Box &box, const Grains &start, int steps)
  {
    std::vector<Grains> results;
    for (const int warps : {1, 4, 0}) {
      const std::unique_ptr<Engine> engine = makeWith(warps);
      Driver driver(*engine, scene, box, start);
      driver.run(steps, 7);
      results.push_back(driver.read());
    }
    double moved = 0.0;
    for (std::size_t k = 0; k < start.x.size(); ++k) moved = std::max(moved, std::abs(results[0].v[k] - start.v[k]));
    EXPECT_GT(moved, 0.0);
    for (const Grains &g : results) {
      EXPECT_EQ(g.x, results[0].x);
      EXPECT_EQ(g.v, results[0].v);
      EXPECT_EQ(g.w, results[0].w);
      EXPECT_EQ(g.f, results[0].f);
    }
  }
};

SceneSpec walledScene(const Box &box, NormalModel normal, TangentialModel tangential, double largest)
{
  SceneSpec s;
  s.pair = {normal, tangential, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  s.timestep = 2e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.2;
  s.largestRadius = largest;
  WallSpec floor;
  floor.law = s.pair;
  floor.axis = 2;
  floor.lo = box.lo[2];
  floor.hi = box.hi[2];
  s.walls.push_back(floor);
  ForceTerm wall, gravity;
  wall.kind = ForceTermKind::Wall;
  gravity.kind = ForceTermKind::Gravity;
  gravity.value = {1.0, 0.0, -5.0};
  s.terms = {wall, gravity};
  s.integrators.push_back({});
  return s;
}

TEST_P(TeamEngineTest, GrainsInABox)
{
  Box box;
  box.hi = {8.0, 8.0, 9.0};
  box.periodic = {true, true, false};
  const Grains start = randomCloud(701, box, 0.35, 0.5, 4);  // the last warp is not full
  for (const NormalModel normal : {NormalModel::Hooke, NormalModel::Hertz})
    expectSameBits(walledScene(box, normal, TangentialModel::Spring, 0.5), box, start, 120);
}

/// Rows of several words, and more contacts of 32 grains than a team has lanes.
TEST_P(TeamEngineTest, RowsOfManyContacts)
{
  Box box;
  box.hi = {6.0, 6.0, 6.0};
  box.periodic = {true, true, false};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> even(0.5, 5.5);
  Grains start;
  for (int k = 0; k < 420; ++k)
    start.add({even(random), even(random), even(random)}, {even(random) - 3.0, 0.1, 0.0}, {0, 0, 0}, 0.8, 1.0);
  SceneSpec scene = walledScene(box, NormalModel::Hooke, TangentialModel::Spring, 0.8);
  scene.pair.normalStiffness = 20.0;
  scene.pair.tangentialStiffness = 6.0;
  const std::unique_ptr<Engine> engine = makeWith(1);
  Driver driver(*engine, scene, box, start);
  driver.read();
  ASSERT_GT(engine->neighbors().entriesPerGrain, 34.0);
  expectSameBits(scene, box, start, 30);
}

INSTANTIATE_TEST_SUITE_P(All, TeamEngineTest,
                         ::testing::Values(Backend{DeviceKind::Cpu, Precision::Double, true},
                                           Backend{DeviceKind::Cpu, Precision::Mixed, true},
                                           Backend{DeviceKind::Gpu, Precision::Double},
                                           Backend{DeviceKind::Gpu, Precision::Mixed}),
                         backendName);

}  // namespace
