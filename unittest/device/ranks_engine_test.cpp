// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Engines of several ranks against one engine with all grains, on every backend and in every precision.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/rank_team.h"
#include "testing/tolerance.h"

#include <map>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

enum class Sharing { Slabs, ThinSlabs, Anyhow, OneHasAll };

struct Case {
  const char *name;
  int ranks;
  Sharing sharing;
  std::array<bool, 3> periodic;
  int dimension = 3;
  int levels = 1;
  double smallest = 0.3;  ///< radius (distance)
  Array3 common{};        ///< velocity that all share at the start (distance/time)
};

const Case cases[] = {
    {"slabs, periodic", 3, Sharing::Slabs, {true, true, true}},
    {"slabs, walls", 2, Sharing::Slabs, {false, true, false}},
    {"slabs thinner than a grain", 16, Sharing::ThinSlabs, {true, true, false}},
    {"grains dealt out anyhow", 4, Sharing::Anyhow, {true, false, true}},
    {"ranks without grains", 3, Sharing::OneHasAll, {true, true, false}},
    {"two dimensions", 5, Sharing::Slabs, {true, true, true}, 2},
    {"levels of sizes", 5, Sharing::Slabs, {true, true, false}, 3, 3, 0.12},
    {"levels, grains dealt out anyhow", 3, Sharing::Anyhow, {true, true, false}, 3, 3, 0.12},
    {"common motion", 4, Sharing::Slabs, {true, true, false}, 3, 1, 0.3, {40.0, -15.0, 0.0}},
};

Box makeBox(const Case &c)
{
  Box box;
  box.lo = {-2.0, 1.0, c.dimension == 2 ? -0.5 : 0.0};
  box.hi = {6.0, 8.5, c.dimension == 2 ? 0.5 : 7.0};
  box.periodic = c.periodic;
  box.dimension = c.dimension;
  return box;
}

SceneSpec makeScene(const Case &c, const Box &box)
{
  SceneSpec s;
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  s.timestep = 2e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.2;
  s.largestRadius = 0.5;
  s.levels = c.levels;
  s.types = 2;
  for (int d = 0; d < 3; ++d) {
    if (box.periodic[d]) continue;
    WallSpec w;
    w.law = s.pair;
    w.axis = d;
    w.lo = box.lo[d];
    w.hi = box.hi[d];
    ForceTerm t;
    t.kind = ForceTermKind::Wall;
    t.wall = static_cast<int>(s.walls.size());
    s.walls.push_back(w);
    s.terms.push_back(t);
  }
  IntegratorSpec all;
  all.inertia = box.dimension == 2 ? 0.5 : 0.4;
  s.integrators.push_back(all);
  return s;
}

Grains makeGrains(const Case &c, const Box &box)
{
  Grains g = randomCloud(c.dimension == 2 ? 60 : 380, box, c.smallest, 0.5, 42);
  for (std::size_t k = 0; k < g.v.size(); ++k) g.v[k] = 3.0 * g.v[k] + c.common[k % 3];
  return g;
}

int ownerOf(const Case &c, const Box &box, const Grains &g, std::size_t i)
{
  const double share = (g.x[3 * i] - box.lo[0]) / (box.hi[0] - box.lo[0]);
  switch (c.sharing) {
    case Sharing::Slabs:
      return std::min(c.ranks - 1, static_cast<int>(share * c.ranks));
    case Sharing::ThinSlabs:  // of half a largest radius, the last takes what remains
      return std::min(c.ranks - 1, static_cast<int>((g.x[3 * i] - box.lo[0]) / 0.25));
    case Sharing::Anyhow:
      return g.tag[i] * 7 % c.ranks;
    case Sharing::OneHasAll:
      return 1;
  }
  return 0;
}

Grains shareOf(const Case &c, const Box &box, const Grains &all, int rank)
{
  Grains g;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (ownerOf(c, box, all, i) != rank) continue;
    g.add(all.at(all.x, i), all.at(all.v, i), all.at(all.w, i), all.radius[i], all.mass[i], all.mask[i], all.type[i]);
    g.tag.back() = all.tag[i];
  }
  return g;
}

struct Final {
  std::map<int, std::array<double, 12>> grains;                  ///< x, v, omega, f by tag
  std::map<std::pair<int, int>, std::array<double, 3>> springs;  ///< as the first tag sees them
  std::array<double, 6> virial{};
  std::int64_t ghosts = 0, rebuilds = 0;

  void add(Engine &engine, const Grains &g, const ContactHistory &history)
  {
    for (std::size_t i = 0; i < g.size(); ++i) {
      std::array<double, 12> &a = grains[g.tag[i]];
      for (int d = 0; d < 3; ++d) {
        a[d] = g.x[3 * i + d];
        a[3 + d] = g.v[3 * i + d];
        a[6 + d] = g.w[3 * i + d];
        a[9 + d] = g.f[3 * i + d];
      }
      for (std::size_t k = history.offset[i]; k < history.offset[i + 1]; ++k)
        springs[{g.tag[i], history.partner[k]}] = {history.spring[3 * k], history.spring[3 * k + 1],
                                                   history.spring[3 * k + 2]};
    }
    for (int k = 0; k < 6; ++k) virial[k] += engine.observables().virial[k];
    ghosts += engine.neighbors().ghosts;
    rebuilds = engine.neighbors().rebuilds;
  }
};

constexpr int steps = 200;

class RanksEngine : public OnBackend {
 protected:
  Final runOne(const Case &c) const
  {
    const Box box = makeBox(c);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, makeScene(c, box), box, makeGrains(c, box));
    return finish(*engine, driver);
  }
  Final runRanks(const Case &c) const
  {
    const Box box = makeBox(c);
    const Grains all = makeGrains(c, box);
    Final total;
    std::mutex mutex;
    RankTeam(c.ranks).run([&](RankExchange &exchange) {
      const std::unique_ptr<Engine> engine = make(1);
      Home home;
      home.middle = {box.lo[0] + (exchange.rank() + 0.5) / c.ranks * (box.hi[0] - box.lo[0]), 4.0, 3.0};
      engine->joinRanks(&exchange);
      engine->setHome(home);
      const Grains mine = shareOf(c, box, all, exchange.rank());
      Driver driver(*engine, makeScene(c, box), box, mine);
      driver.run(steps, 7, true);
      const Grains g = driver.read();
      ContactHistory history;
      engine->downloadHistory(history);
      const std::lock_guard<std::mutex> lock(mutex);
      total.add(*engine, g, history);
    });
    return total;
  }

 private:
  Final finish(Engine &engine, Driver &driver) const
  {
    driver.run(steps, 7, true);
    ContactHistory history;
    engine.downloadHistory(history);
    Final f;
    f.add(engine, driver.read(), history);
    return f;
  }
};

TEST_P(RanksEngine, GiveTheAnswerOfOne)
{
  for (const Case &c : cases) {
    SCOPED_TRACE(c.name);
    const Final one = runOne(c), many = runRanks(c);
    ASSERT_EQ(many.grains.size(), one.grains.size());
    double magnitude[4] = {8.0, 0.0, 0.0, 0.0}, difference[4] = {};
    for (const auto &[tag, a] : one.grains) {
      const auto &b = many.grains.at(tag);
      for (int k = 0; k < 12; ++k) {
        if (k >= 3) magnitude[k / 3] = std::max(magnitude[k / 3], std::abs(a[k]));
        difference[k / 3] = std::max(difference[k / 3], std::abs(a[k] - b[k]));
      }
    }
    const double operations[4] = {10.0, 50.0, 100.0, 1e4};
    for (int k = 0; k < 4; ++k)
      EXPECT_TRUE(near(difference[k], 0.0, alongThePath(GetParam().precision, magnitude[k], 2.0, operations[k]))) << k;
    for (int k = 0; k < 6; ++k)
      EXPECT_TRUE(near(many.virial[k], one.virial[k], alongThePath(GetParam().precision, 1e3, 2.0, 1e3))) << k;
    EXPECT_EQ(many.springs.size(), one.springs.size());
    EXPECT_GT(one.springs.size(), 6u) << "the case must have contacts to mean anything";
    EXPECT_GT(many.rebuilds, 3) << "the case must rebuild to mean anything";
    EXPECT_EQ(many.ghosts > 0, c.sharing != Sharing::OneHasAll);
  }
}

/// Two ranks hold a spring across their border, and both hold the same bits.
TEST_P(RanksEngine, SpringsAcrossABorderAreOpposite)
{
  for (const Case &c : cases) {
    SCOPED_TRACE(c.name);
    const Final many = runRanks(c);
    for (const auto &[pair, spring] : many.springs) {
      const auto other = many.springs.find({pair.second, pair.first});
      ASSERT_NE(other, many.springs.end()) << pair.first << " and " << pair.second;
      for (int d = 0; d < 3; ++d) ASSERT_EQ(spring[d], -other->second[d]) << pair.first << " and " << pair.second;
    }
  }
}

/// No force acts from outside: whatever a rank adds to a grain another takes away.
TEST_P(RanksEngine, MomentumIsKept)
{
  Case c = cases[3];
  c.periodic = {true, true, true};
  const Final many = runRanks(c);
  double sum[3] = {}, largest = 0.0;
  for (const auto &[tag, a] : many.grains)
    for (int d = 0; d < 3; ++d) {
      sum[d] += a[9 + d];
      largest = std::max(largest, std::abs(a[9 + d]));
    }
  ASSERT_GT(largest, 0.0);
  for (const double s : sum) EXPECT_TRUE(near(s, 0.0, alongThePath(GetParam().precision, largest, 0.0, 100.0)));
}

/// A grain that breaks ends the run of all ranks with its name.
TEST_P(RanksEngine, AnErrorOfOneRankEndsAll)
{
  const Case &c = cases[0];
  const Box box = makeBox(c);
  Grains all = makeGrains(c, box);
  all.v[3 * 17] = 1e9;
  try {
    RankTeam(c.ranks).run([&](RankExchange &exchange) {
      const std::unique_ptr<Engine> engine = make(1);
      engine->joinRanks(&exchange);
      Driver driver(*engine, makeScene(c, box), box, shareOf(c, box, all, exchange.rank()));
      driver.run(10);
    });
    FAIL() << "nothing was noticed";
  } catch (const UnstableState &e) {
    EXPECT_NE(std::string(e.what()).find("atom " + std::to_string(all.tag[17])), std::string::npos) << e.what();
  }
}

GPUDEM_ON_ALL_BACKENDS(RanksEngine);

}  // namespace
