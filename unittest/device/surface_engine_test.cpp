// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Walls of triangles in the engine: the planes that the oracle knows, motion, sums, and what is kept across
/// rebuilds and engines.

#include "gpudem/body_motion.h"
#include "gpudem/surface_wall.h"
#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/meshes.h"
#include "testing/model_scenes.h"
#include "testing/tolerance.h"

#include <set>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

class SurfaceEngine : public OnBackend {};

std::shared_ptr<const SurfaceMesh> boxMesh(const Box &box, int n)
{
  SurfaceMesh m = cube(1.0, n);
  for (Point &p : m.vertex)
    for (std::size_t d = 0; d < 3; ++d) p[d] = box.lo[d] + p[d] * (box.hi[d] - box.lo[d]);
  cleanSurface(m);
  return std::make_shared<const SurfaceMesh>(m);
}

/// The scene with one surface in the place of its walls, which have one law.
SceneSpec withSurface(SceneSpec s, std::shared_ptr<const SurfaceMesh> mesh, SurfaceSide side)
{
  WallSpec wall = s.walls.at(0);
  wall.shape = WallShape::Surface;
  wall.surface = std::move(mesh);
  wall.surfaceSide = side;
  wall.mostContacts = 6;
  s.walls = {wall};
  ForceTerm term;
  term.kind = ForceTermKind::RegionWall;
  term.wall = 0;
  std::vector<ForceTerm> terms{term};
  for (const ForceTerm &t : s.terms)
    if (t.kind != ForceTermKind::Wall) terms.push_back(t);
  s.terms = terms;
  return s;
}

ModelScene closedBox(std::optional<ContactModel> wall)
{
  return {"closed box", {}, std::move(wall), {false, false, false}};
}

/// Within \p domain by \p room: what leaves the domain is lost.
Box within(const Box &domain, double room)
{
  Box b = domain;
  for (std::size_t d = 0; d < 3; ++d) {
    b.lo[d] += room;
    b.hi[d] -= room;
  }
  return b;
}

TEST_P(SurfaceEngine, ABoxIsSixPlanes)
{
  const std::optional<ContactModel> laws[] = {
      {}, asWall(stiffMaterial()), asWall(stickyMaterial(100.0)), asWall(springModel()), dustModel()};
  int law = 0;
  for (const std::optional<ContactModel> &wall : laws)
    for (const SurfaceSide side : {SurfaceSide::Both, SurfaceSide::Inside}) {
      SCOPED_TRACE(::testing::Message() << "law " << law++ / 2 << " side " << static_cast<int>(side));
      const ModelScene m = closedBox(wall);
      const Box domain = boxOf(m), box = within(domain, 0.5);
      const SceneSpec planes = specOf(m, box);
      const Grains start = grainsIn(m, box, 120, 5);
      Oracle oracle(planes, box, start);
      oracle.evaluate(0, false);
      const std::unique_ptr<Engine> engine = make();
      Driver driver(*engine, withSurface(planes, boxMesh(box, 4), side), domain, start);
      for (int k = 1; k <= 150; ++k) oracle.step(k);
      driver.run(150, 7);
      const Grains g = driver.read();
      EXPECT_TRUE(
          near(largestDifference(g.x, oracle.grains.x), 0.0, alongThePath(GetParam().precision, 1.0, 1.5, 8)));
      EXPECT_TRUE(near(largestDifference(g.v, oracle.grains.v), 0.0,
                       alongThePath(GetParam().precision, largest(g.v), 1.5, 20)));
      EXPECT_TRUE(near(largestDifference(g.w, oracle.grains.w), 0.0,
                       alongThePath(GetParam().precision, largest(g.w), 1.5, 50)));
      EXPECT_GT(engine->neighbors().rebuilds, 1);
    }
}

/// A body that turns and shakes, at one step: forces, torques and sums are those of the same functions on the host.
TEST_P(SurfaceEngine, AMovingBodyPushesAsOnTheHost)
{
  const ModelScene m = closedBox({});
  const Box domain = boxOf(m), box = within(domain, 1.2);
  SceneSpec spec = withSurface(specOf(m, box), boxMesh(box, 3), SurfaceSide::Inside);
  spec.walls[0].recordTouches = true;
  const Grains start = grainsIn(m, within(domain, 1.25), 60, 8);
  const std::array<double, 3> middle{0.0, 0.0, 4.25};
  const auto motionAt = [&](std::int64_t step) {
    const double t = spec.timestep * static_cast<double>(step);
    return composed(displaced({2.0 * t, -3.0 * t, t}, {2.0, -3.0, 1.0}),
                    turned(middle, {0.0, 0.6, 0.8}, 8.0 * t, 8.0));
  };
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, spec, domain, start);
  driver.complete = [&](StepInputs &in) { in.bodyMotion = {motionAt(in.step)}; };
  int touching = 0;
  for (const std::int64_t event : {100, 101, 300}) {
    driver.run(event, 5);
    const Saved state = driver.save();
    StepInputs in;
    in.step = event;
    in.bodyMotion = {motionAt(event)};
    engine->evaluateForce(in, {});  // as at the setup of a run: springs do not grow
    Grains g = state.grains;
    std::vector<double> kept = state.walls[0];
    SurfaceWall wall(spec.walls[0]);
    const WallSums sums = wall.apply(g.view(), motionAt(event), spec.timestep, false, kept.data(), nullptr);
    const WallSums &device = engine->observables().wall.at(0);
    touching += static_cast<int>(device.contacts);
    EXPECT_EQ(sums.contacts, device.contacts);
    const double scale = largest(g.f);
    ASSERT_EQ(device.touches.size(), static_cast<std::size_t>(device.contacts));
    ASSERT_EQ(sums.touches.size(), device.touches.size());
    const auto zone = zoneSums(*spec.walls[0].surface, device.touches, motionAt(event).displacement).at(0);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_TRUE(near(zone[d], sums.force[d], alongThePath(GetParam().precision, scale, 1.0, 50)));
      EXPECT_TRUE(near(zone[3 + d], sums.torque[d], alongThePath(GetParam().precision, 5.0 * scale, 1.0, 50)));
    }
    std::set<std::pair<int, std::uint32_t>> onHost;
    for (const SurfaceTouch &t : sums.touches) onHost.emplace(t.tag, t.triangle);
    for (const SurfaceTouch &t : device.touches) EXPECT_EQ(onHost.count({t.tag, t.triangle}), 1u);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_TRUE(near(device.force[d], sums.force[d], alongThePath(GetParam().precision, scale, 1.0, 50)));
      EXPECT_TRUE(near(device.torque[d], sums.torque[d], alongThePath(GetParam().precision, 5.0 * scale, 1.0, 50)));
    }
  }
  EXPECT_GT(touching, 10);
}

/// What a grain keeps of each contact goes with it into another engine.
TEST_P(SurfaceEngine, ContactsAreCarriedToAnotherEngine)
{
  const ModelScene m = closedBox(asWall(stickyMaterial(100.0)));
  const Box domain = boxOf(m), box = within(domain, 0.5);
  const SceneSpec spec = withSurface(specOf(m, box), boxMesh(box, 3), SurfaceSide::Inside);
  const std::unique_ptr<Engine> first = make(), second = make();
  Driver driver(*first, spec, domain, grainsIn(m, box, 150, 7));
  driver.run(150);
  const Saved saved = driver.save();
  Driver again(*second, spec, domain, saved, 150);
  EXPECT_EQ(again.save().walls[0], saved.walls[0]);
  driver.run(200);
  again.run(200);
  const Grains a = driver.read(), b = again.read();
  EXPECT_TRUE(near(largestDifference(a.x, b.x), 0.0, alongThePath(GetParam().precision, 1.0, 0.5, 8)));
  EXPECT_TRUE(near(largestDifference(a.w, b.w), 0.0, alongThePath(GetParam().precision, largest(a.w), 0.5, 50)));
}

/// Grains that fly together wear out no row among them; the floor must be found in time all the same, also where a GPU
/// widens the skin of rows that last for few steps.
TEST_P(SurfaceEngine, GrainsThatFlyTogetherMeetTheFloor)
{
  const ModelScene m = closedBox({});
  const Box domain = boxOf(m), box = within(domain, 0.5);
  const SceneSpec planes = specOf(m, box);
  const double step = planes.skin / 30.0;  // distance in a timestep: the frame of the grains lasts for 60 steps
  for (int place = 0; place < 8; ++place) {
    SCOPED_TRACE(place);
    Grains start;
    const double height = box.lo[2] + 0.5 + 12.0 * planes.skin + 0.25 * place * planes.skin;
    for (int x = -1; x < 2; ++x)
      for (int y = -1; y < 2; ++y)
        start.add({1.3 * x, 1.3 * y, height}, {0.0, 0.0, -step / planes.timestep}, {0, 0, 0}, 0.5, 1.0);
    Oracle oracle(planes, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, withSurface(planes, boxMesh(box, 4), SurfaceSide::Inside), domain, start);
    for (int k = 1; k <= 500; ++k) oracle.step(k);
    driver.run(500, 500);
    const Grains g = driver.read();
    EXPECT_TRUE(near(largestDifference(g.x, oracle.grains.x), 0.0, alongThePath(GetParam().precision, 1.0, 1.5, 8)));
    EXPECT_TRUE(near(largestDifference(g.v, oracle.grains.v), 0.0,
                     alongThePath(GetParam().precision, largest(g.v), 1.5, 20)));
    EXPECT_GT(engine->neighbors().rebuilds, 1);
  }
}

TEST_P(SurfaceEngine, AGrainThatGoesThroughASheetIsNamed)
{
  const ModelScene m = closedBox({});
  const Box domain = boxOf(m);
  auto sheet = std::make_shared<SurfaceMesh>(rectangle({-5, -5, 4}, {10, 0, 0}, {0, 10, 0}, 3));
  cleanSurface(*sheet);
  SceneSpec spec = withSurface(specOf(m, domain), sheet, SurfaceSide::Both);
  Grains one;
  one.add({0.0, 0.0, 4.4}, {0, 0, -400.0}, {0, 0, 0}, 0.5, 1.0);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, spec, domain, one);
  try {
    driver.run(200);
    FAIL() << "through the sheet";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("centre of atom 1 went through"), std::string::npos) << e.what();
  }
}

GPUDEM_ON_ALL_BACKENDS(SurfaceEngine);

}  // namespace
