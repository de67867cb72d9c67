// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Region walls in the engine: the planes that the oracle knows, contacts with several faces, motion, and what is
/// kept across rebuilds and engines.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/model_scenes.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

class RegionEngine : public OnBackend {};

enum class Built { Block, SixPlanes, WithinAnother };

std::vector<RegionPart> boxRegion(const Box &box, Built built)
{
  RegionPart block;
  block.lo = box.lo;
  block.hi = box.hi;
  if (built == Built::Block) return {block};
  RegionPart whole;
  whole.kind = RegionKind::Intersect;
  std::vector<RegionPart> parts{whole};
  if (built == Built::WithinAnother) {
    parts.push_back(block);
    for (std::size_t d = 0; d < 3; ++d) {
      block.lo[d] -= 2.0;
      block.hi[d] += 2.0;
    }
    parts.push_back(block);
  } else {
    for (std::size_t face = 0; face < 6; ++face) {
      RegionPart plane;
      plane.kind = RegionKind::Plane;
      plane.centre = face & 1 ? box.hi : box.lo;
      plane.normal[face / 2] = face & 1 ? -1.0 : 1.0;
      parts.push_back(plane);
    }
  }
  parts[0].size = static_cast<int>(parts.size());
  return parts;
}

/// The scene with one region in the place of its walls, which are at all faces of the box and have one law.
SceneSpec withRegion(SceneSpec s, const std::vector<RegionPart> &region)
{
  WallSpec wall = s.walls.at(0);
  wall.shape = WallShape::Region;
  wall.region = region;
  wall.mostContacts = 3;
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

/// Grains keep clear of the faces of the domain: what leaves it is lost.
Box held(const Box &domain)
{
  Box b = domain;
  for (std::size_t d = 0; d < 3; ++d) {
    b.lo[d] += 0.5;
    b.hi[d] -= 0.5;
  }
  return b;
}

TEST_P(RegionEngine, ABoxIsSixPlanes)
{
  const std::optional<ContactModel> laws[] = {
      {}, asWall(stiffMaterial()), asWall(stickyMaterial(100.0)), asWall(springModel())};
  int law = 0;
  for (const std::optional<ContactModel> &wall : laws)
    for (const Built built : {Built::Block, Built::SixPlanes, Built::WithinAnother}) {
      SCOPED_TRACE(::testing::Message() << "law " << law++ / 3 << " built " << static_cast<int>(built));
      const ModelScene m = closedBox(wall);
      const Box domain = boxOf(m), box = held(domain);
      const SceneSpec planes = specOf(m, box);
      const Grains start = grainsIn(m, box, 150, 5);
      Oracle oracle(planes, box, start);
      oracle.evaluate(0, false);
      const std::unique_ptr<Engine> engine = make();
      Driver driver(*engine, withRegion(planes, boxRegion(box, built)), domain, start);
      for (int event = 1; event <= 2; ++event) {
        for (int k = 1; k <= 100; ++k) oracle.step((event - 1) * 100 + k);
        driver.run(event * 100, 7);
        const Grains g = driver.read();
        EXPECT_TRUE(
            near(largestDifference(g.x, oracle.grains.x), 0.0, alongThePath(GetParam().precision, 1.0, event, 8)));
        EXPECT_TRUE(near(largestDifference(g.v, oracle.grains.v), 0.0,
                         alongThePath(GetParam().precision, largest(g.v), event, 20)));
        EXPECT_TRUE(near(largestDifference(g.w, oracle.grains.w), 0.0,
                         alongThePath(GetParam().precision, largest(g.w), event, 50)));
      }
      EXPECT_GT(engine->neighbors().rebuilds, 2);
    }
}

/// Grains and region fly through the domain together: to the grains nothing has changed.
TEST_P(RegionEngine, MotionIsRelative)
{
  const ModelScene m = closedBox(asWall(stiffMaterial()));
  Box domain = boxOf(m);
  const Box box = held(domain);
  domain.hi[0] += 6.0;
  const SceneSpec spec = withRegion(specOf(m, box), boxRegion(box, Built::Block));
  Box inner = box;  // at the first force the walls are at rest: nothing may touch them yet
  for (std::size_t d = 0; d < 3; ++d) {
    inner.lo[d] += 0.1;
    inner.hi[d] -= 0.1;
  }
  const Grains start = grainsIn(m, inner, 120, 6);
  Grains flying = start;
  const Array3 wind{40.0, 2.0, -3.0};
  for (std::size_t i = 0; i < flying.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) flying.v[3 * i + d] += wind[d];
  SceneSpec moving = spec;
  moving.walls[0].region[0].moves = true;

  const std::unique_ptr<Engine> one = make(), other = make();
  Driver rest(*one, spec, domain, start), carried(*other, moving, domain, flying);
  carried.complete = [&](StepInputs &in) {
    PartMotion p;
    p.velocity = wind;
    for (std::size_t d = 0; d < 3; ++d) p.displacement[d] = wind[d] * spec.timestep * static_cast<double>(in.step);
    in.wallMotion = {{p}};
  };
  const int steps = 150;
  rest.run(steps, 9);
  carried.run(steps, 9);
  const Grains a = rest.read(), b = carried.read();
  const double t = steps * spec.timestep;
  double apart = 0.0, faster = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      apart = std::max(apart, std::abs(b.x[3 * i + d] - a.x[3 * i + d] - wind[d] * t));
      faster = std::max(faster, std::abs(b.v[3 * i + d] - a.v[3 * i + d] - wind[d]));
    }
  EXPECT_TRUE(near(apart, 0.0, alongThePath(GetParam().precision, 10.0, 1.5, 20)));
  EXPECT_TRUE(near(faster, 0.0, alongThePath(GetParam().precision, 40.0, 1.5, 50)));
}

/// What a grain keeps of each face goes with it into another engine.
TEST_P(RegionEngine, ContactsAreCarriedToAnotherEngine)
{
  const ModelScene m = closedBox(asWall(stickyMaterial(100.0)));
  const Box domain = boxOf(m), box = held(domain);
  const SceneSpec spec = withRegion(specOf(m, box), boxRegion(box, Built::Block));
  const std::unique_ptr<Engine> first = make(), second = make();
  Driver driver(*first, spec, domain, grainsIn(m, box, 150, 7));
  driver.run(150);
  const Saved saved = driver.save();
  const std::size_t slot = saved.walls[0].size() / saved.grains.size() / 3;
  int contacts = 0, several = 0;
  for (std::size_t i = 0; i < saved.grains.size(); ++i) {
    int own = 0;
    for (std::size_t k = 0; k < 3; ++k) own += saved.walls[0][(3 * i + k) * slot] != 0.0;
    contacts += own;
    several += own > 1;
  }
  EXPECT_GT(contacts, 15);
  EXPECT_GT(several, 0);
  Driver again(*second, spec, domain, saved, 150);
  EXPECT_EQ(again.save().walls[0], saved.walls[0]);
  driver.run(200);
  again.run(200);
  const Grains a = driver.read(), b = again.read();
  EXPECT_TRUE(near(largestDifference(a.x, b.x), 0.0, alongThePath(GetParam().precision, 1.0, 0.5, 8)));
  EXPECT_TRUE(near(largestDifference(a.w, b.w), 0.0, alongThePath(GetParam().precision, largest(a.w), 0.5, 50)));
}

TEST_P(RegionEngine, AGrainThatTouchesTooManyFacesIsNamed)
{
  const ModelScene m = closedBox({});
  const Box domain = boxOf(m);
  Box slot = held(domain);
  slot.hi[0] = slot.lo[0] + 0.7;  // narrower than a grain
  SceneSpec spec = withRegion(specOf(m, held(domain)), boxRegion(slot, Built::Block));
  spec.walls[0].mostContacts = 1;
  Grains one;
  one.add({slot.lo[0] + 0.35, 0.0, 4.0}, {0, 0, 0}, {0, 0, 0}, 0.5, 1.0);
  const std::unique_ptr<Engine> engine = make();
  try {
    Driver driver(*engine, spec, domain, one);
    FAIL() << "two faces in one slot";
  } catch (const Error &e) {
    EXPECT_NE(std::string(e.what()).find("atom 1 "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("faces of a region wall"), std::string::npos) << e.what();
  }
}

TEST_P(RegionEngine, AnyNumberOfRegionsActs)
{
  const ModelScene m = closedBox({});
  const Box domain = boxOf(m), box = held(domain);
  const SceneSpec planes = specOf(m, box);
  SceneSpec spec = withRegion(planes, boxRegion(box, Built::SixPlanes));
  const WallSpec whole = spec.walls[0];
  const ForceTerm term = spec.terms[0];
  spec.walls.clear();
  spec.terms.erase(spec.terms.begin());
  for (int k = 0; k < 12; ++k) {  // each plane twice, at half the stiffness
    WallSpec one = whole;
    one.region = {whole.region[static_cast<std::size_t>(1 + k % 6)]};
    one.law.normalStiffness *= 0.5;
    one.law.normalDamping *= 0.5;
    one.law.friction = 0.0;
    ForceTerm t = term;
    t.wall = k;
    spec.walls.push_back(one);
    spec.terms.push_back(t);
  }
  SceneSpec smooth = planes;
  for (WallSpec &w : smooth.walls) w.law.friction = 0.0;
  const Grains start = grainsIn(m, box, 150, 8);
  const std::unique_ptr<Engine> one = make(), other = make();
  Driver a(*one, smooth, domain, start), b(*other, spec, domain, start);
  a.run(100);
  b.run(100);
  EXPECT_TRUE(near(largestDifference(a.read().x, b.read().x), 0.0, alongThePath(GetParam().precision, 1.0, 1, 20)));
}

GPUDEM_ON_ALL_BACKENDS(RegionEngine);

}  // namespace
