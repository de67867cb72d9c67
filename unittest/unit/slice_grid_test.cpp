// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Slice grid: properties that hold for every number of ranks and every distribution.
#include "gpudem/errors.h"
#include "gpudem/slice_grid.h"
#include "testing/slice_scenes.h"
#include "testing/tolerance.h"

#include <numeric>
#include <string>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

SliceGrid gridOf(int ranks, int levels, std::array<double, 3> extent = {1, 1, 1}, std::string axes = "auto")
{
  SliceRequest request;
  request.ranks = ranks;
  request.levels = levels;
  request.extent = extent;
  request.axes = axes;
  return makeSliceGrid(request);
}

/// Largest weight of a rank that cuts within their tolerance may leave: the aim, and a particle for each level, since
/// no cut divides one.
double allowed(const SliceOptions &options, int levels, double mean, double heaviestParticle)
{
  return mean * std::pow(1.0 + (options.aim - 1.0) / levels, levels) * (1.0 + 1e-3) + levels * heaviestParticle;
}

void expectSameCuts(const SliceGrid &a, const SliceGrid &b)
{
  for (std::size_t l = 0; l < a.levels.size(); ++l) EXPECT_EQ(a.levels[l].lower, b.levels[l].lower) << "level " << l;
}

template <class Call>
std::string messageOf(Call call)
{
  try {
    call();
  } catch (const Error &e) {
    return e.what();
  }
  return "no error";
}
#define EXPECT_MESSAGE(words, call) \
  EXPECT_NE(messageOf([&] { call; }).find(words), std::string::npos) << messageOf([&] { call; })

}  // namespace

TEST(SliceShape, EveryNumberOfRanksFillsTheBoxWithEqualVolumes)
{
  for (int ranks = 1; ranks <= 64; ++ranks)
    for (int levels = 1; levels <= 3; ++levels) {
      const SliceGrid grid = gridOf(ranks, levels, {1.0 + ranks % 3, 1.0, 0.5 + ranks % 5});
      ASSERT_EQ(static_cast<int>(grid.levels.size()), levels);
      ASSERT_EQ(grid.levels.back().parts(), ranks);
      double sum = 0.0;
      for (int r = 0; r < ranks; ++r) {
        double volume = 1.0;
        for (int a = 0; a < 3; ++a) volume *= grid.bounds(r, a)[1] - grid.bounds(r, a)[0];
        EXPECT_TRUE(near(volume, 1.0 / ranks, roundOff(Precision::Double, 1.0)))
            << ranks << " ranks, " << levels << " levels";
        sum += volume;
      }
      EXPECT_TRUE(near(sum, 1.0, roundOff(Precision::Double, 1.0, ranks)));
    }
}

TEST(SliceShape, EveryCutOfTheTreeIsACutOfTheGrid)
{
  for (int ranks = 2; ranks <= 64; ++ranks)
    for (int levels = 1; levels <= 3; ++levels) {
      const SliceGrid grid = gridOf(ranks, levels);
      EXPECT_EQ(grid.treeCut(0).axis, -1);
      for (int r = 1; r < ranks; ++r) {
        const TreeCut cut = grid.treeCut(r);
        ASSERT_GE(cut.axis, 0);
        EXPECT_EQ(grid.bounds(r, cut.axis)[0], cut.fraction);
      }
    }
}

TEST(SliceShape, LongRegionIsCutAcrossItsLength)
{
  EXPECT_EQ(gridOf(8, 1, {1, 10, 1}).levels[0].axis, 1);
  EXPECT_EQ(gridOf(8, 1, {1, 1, 10}).levels[0].axis, 2);
  // a flat bed gets no cut through its height
  for (const SliceLevel &level : gridOf(16, 2, {10, 10, 1}).levels) EXPECT_NE(level.axis, 2);
  // a cube: as many slabs as columns in a slab
  EXPECT_EQ(gridOf(64, 3).levels[0].parts(), 4);
  EXPECT_EQ(gridOf(64, 3).levels[1].parts(), 16);
}

TEST(SliceShape, SurfaceIsThatOfTheFacesBetweenRanks)
{
  const std::array<double, 3> extent = {4.0, 2.0, 1.0};
  EXPECT_EQ(sliceSurface(gridOf(1, 3), extent), 0.0);
  EXPECT_TRUE(near(sliceSurface(gridOf(4, 1, {1, 1, 1}, "x"), extent), 3 * 2.0, roundOff(Precision::Double, 6.0)));
  EXPECT_TRUE(near(sliceSurface(gridOf(4, 1, {1, 1, 1}, "z"), extent), 3 * 8.0, roundOff(Precision::Double, 24.0)));
  // what is chosen for a region has the least surface in it
  for (int ranks = 2; ranks <= 64; ++ranks)
    EXPECT_LE(sliceSurface(gridOf(ranks, 3, extent), extent),
              sliceSurface(gridOf(ranks, 3, {1.0, 3.0, 0.4}), extent) * (1.0 + 1e-9));
}

TEST(SliceShape, GivenAxesAreKept)
{
  const SliceGrid grid = gridOf(12, 2, {1, 1, 1}, "zx");
  EXPECT_EQ(grid.levels[0].axis, 2);
  EXPECT_EQ(grid.levels[1].axis, 0);
}

TEST(SliceShape, WrongRequestsAreNamed)
{
  EXPECT_MESSAGE("at least 1", gridOf(0, 1));
  EXPECT_MESSAGE("levels 4", gridOf(4, 4));
  EXPECT_MESSAGE("levels 0", gridOf(4, 0));
  EXPECT_MESSAGE("'w' is no axis", gridOf(4, 2, {1, 1, 1}, "xw"));
  EXPECT_MESSAGE("x stands twice", gridOf(4, 2, {1, 1, 1}, "xx"));
  EXPECT_MESSAGE("2 axes, but the grid has 3 levels", gridOf(4, 3, {1, 1, 1}, "xy"));
  SliceRequest flat;
  flat.dimension = 2;
  flat.axes = "xz";
  EXPECT_MESSAGE("no cuts along z in two dimensions", makeSliceGrid(flat));
  SliceRequest narrow;
  narrow.ranks = 50;
  narrow.smallest = {0.3, 0.3, 0.3};
  EXPECT_MESSAGE("box is too small for 50 ranks", makeSliceGrid(narrow));
}

TEST(SliceShape, LeastWidthsBoundTheNumberOfParts)
{
  SliceRequest request;
  request.ranks = 12;
  request.smallest = {0.3, 0.02, 0.02};
  request.axes = "xy";
  const SliceGrid grid = makeSliceGrid(request);
  EXPECT_LE(grid.levels[0].parts(), 3);
}

TEST(SliceOwner, EachPointBelongsToOneRankAndTheTreeAgrees)
{
  for (int ranks = 1; ranks <= 64; ++ranks) {
    std::mt19937 random(ranks);
    const int levels = 1 + ranks % 3;
    const Spread kind = allSpreads[ranks % 5];
    SliceGrid grid = gridOf(ranks, levels);
    const auto x = spread(kind, 3000, random);
    balanced(grid, x, {}, {});
    auto points = spread(Spread::Uniform, 300, random);
    points.insert(points.end(), x.begin(), x.begin() + 900);
    for (int r = 0; r < ranks; ++r)  // corners lie on cuts, of which the upper side is the owner
      for (int a = 0; a < 3; ++a) points.push_back(grid.bounds(r, a)[0]);
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
      const double *p = &points[3 * i];
      const auto owners = ranksAround(grid, p);
      ASSERT_EQ(owners.size(), 1u) << ranks << " ranks, point " << p[0] << " " << p[1] << " " << p[2];
      EXPECT_EQ(grid.rankOf(p), owners[0]);
      EXPECT_EQ(rankByTree(grid, p), owners[0]);
    }
    const double outside[3] = {-0.2, 1.3, 0.5};
    EXPECT_EQ(grid.rankOf(outside), rankByTree(grid, outside));
  }
}

TEST(SliceBalance, ImbalanceReachesTheAimForAllRanksAndDistributions)
{
  constexpr int count = 20000;
  for (int ranks = 1; ranks <= 64; ++ranks)
    for (Spread kind : allSpreads) {
      std::mt19937 random(100 * ranks + static_cast<int>(kind));
      const int levels = 1 + (ranks + static_cast<int>(kind)) % 3;
      SliceGrid grid = gridOf(ranks, levels);
      const auto x = spread(kind, count, random);
      const SliceOptions options;
      const SliceReport report = balanced(grid, x, {}, options);
      const auto load = loads(grid, x, {});
      EXPECT_EQ(std::accumulate(load.begin(), load.end(), 0.0), count);
      const double most = *std::max_element(load.begin(), load.end()), mean = static_cast<double>(count) / ranks;
      EXPECT_TRUE(near(report.heaviest, most, roundOff(Precision::Double, most))) << "what is said is what is";
      EXPECT_TRUE(near(report.imbalance, most / mean, roundOff(Precision::Double, most / mean)));
      if (!indivisible(kind)) {
        EXPECT_LE(most, allowed(options, levels, mean, 1.0))
            << ranks << " ranks, " << levels << " levels, kind " << int(kind);
      }
    }
}

TEST(SliceBalance, WeightsAreBalanced)
{
  constexpr int count = 20000;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const int ranks = 1 + static_cast<int>(random() % 64), levels = 1 + seed % 3;
    const Spread kind = allSpreads[seed % 4];
    const auto x = spread(kind, count, random);
    std::lognormal_distribution<double> any(0.0, 1.0);
    std::vector<double> weight(count);
    const double scale =
        std::pow(10.0, static_cast<double>(seed % 7) * 4.0 - 12.0);  // the unit of weight does not matter
    for (double &w : weight) w = scale * any(random);
    SliceGrid grid = gridOf(ranks, levels);
    const SliceOptions options;
    const SliceReport report = balanced(grid, x, weight, options);
    const auto load = loads(grid, x, weight);
    const double most = *std::max_element(load.begin(), load.end());
    const double mean = std::accumulate(load.begin(), load.end(), 0.0) / ranks;
    EXPECT_LE(most, allowed(options, levels, mean, *std::max_element(weight.begin(), weight.end()))) << "seed " << seed;
    EXPECT_TRUE(near(report.heaviest, most, weightRounding(most))) << "seed " << seed;
  }
}

/// A layer on an edge between bins belongs to the bin above it, however the quotient that finds the bin rounds.
TEST(SliceBalance, LayersAreNeverSplitNorMisplaced)
{
  for (int ranks = 2; ranks <= 64; ++ranks)
    for (int each = 1; each <= 4; ++each) {
      const int layers = ranks * each;
      std::vector<double> x;
      for (int k = 0; k < layers; ++k)
        for (int i = 0; i < 50; ++i) x.insert(x.end(), {static_cast<double>(k) / layers, 0.5, 0.5});
      SliceGrid grid = gridOf(ranks, 1, {1, 1, 1}, "x");
      SliceOptions options;
      options.aim = 1.0;
      EXPECT_EQ(balanced(grid, x, {}, options).imbalance, 1.0) << ranks << " ranks, layers each " << each;
    }
}

TEST(SliceBalance, CutsDoNotDependOnWhereParticlesLive)
{
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    const auto x = spread(allSpreads[seed % 5], 5000, random);
    std::uniform_real_distribution<double> any(0.1, 3.0);
    std::vector<double> weight(5000);
    for (double &w : weight) w = any(random);
    SliceGrid one = gridOf(13, 2), many = gridOf(13, 2);
    balanced(one, x, weight, {}, 1);
    balanced(many, x, weight, {}, 13, seed);
    expectSameCuts(one, many);
  }
}

TEST(SliceBalance, WhatIsGoodEnoughStays)
{
  std::mt19937 random(5);
  const auto x = spread(Spread::Clusters, 20000, random);
  SliceGrid grid = gridOf(24, 2);
  EXPECT_GT(balanced(grid, x, {}, {}).moved, 0);
  const SliceGrid before = grid;
  EXPECT_EQ(balanced(grid, x, {}, {}).moved, 0);
  expectSameCuts(before, grid);
}

TEST(SliceBalance, NothingToDivideMovesNothing)
{
  SliceGrid grid = gridOf(7, 2);
  const SliceGrid before = grid;
  const SliceReport empty = balanced(grid, {}, {}, {});
  EXPECT_EQ(empty.moved, 0);
  EXPECT_EQ(empty.imbalance, 1.0);
  const SliceReport weightless = balanced(grid, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {0.0, 0.0}, {});
  EXPECT_EQ(weightless.moved, 0);
  expectSameCuts(before, grid);
}

TEST(SliceBalance, OnePlaceIsNotDivided)
{
  std::vector<double> x;
  for (int i = 0; i < 1000; ++i) x.insert(x.end(), {0.3, 0.6, 0.1});
  for (int levels = 1; levels <= 3; ++levels) {
    SliceGrid grid = gridOf(11, levels);
    SliceOptions options;
    options.smallest = {0.01, 0.01, 0.01};
    const SliceReport report = balanced(grid, x, {}, options);
    EXPECT_EQ(report.heaviest, 1000.0);
    EXPECT_EQ(report.imbalance, 11.0);
    for (int r = 0; r < 11; ++r)
      for (int a = 0; a < 3; ++a) EXPECT_GE(grid.bounds(r, a)[1] - grid.bounds(r, a)[0], 0.01 * (1.0 - 1e-9));
  }
}

TEST(SliceBalance, FewerParticlesThanRanks)
{
  std::mt19937 random(3);
  const auto x = spread(Spread::Uniform, 10, random);
  for (int levels = 1; levels <= 3; ++levels) {
    SliceGrid grid = gridOf(64, levels);
    const auto report = balanced(grid, x, {}, {});
    EXPECT_LE(report.heaviest, 2.0) << levels << " levels";
    const auto load = loads(grid, x, {});
    EXPECT_EQ(std::accumulate(load.begin(), load.end(), 0.0), 10.0);
  }
}

TEST(SliceBalance, WidthsAndMovesKeepTheirLimits)
{
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const int ranks = 2 + static_cast<int>(random() % 40), levels = 1 + seed % 3;
    SliceGrid grid = gridOf(ranks, levels);
    const SliceGrid before = grid;
    const auto x = spread(allSpreads[seed % 5], 5000, random);
    SliceOptions options;
    options.smallest = {0.004, 0.004, 0.004};
    options.farthest = {0.01, 0.02, 0.03};
    options.betweenNeighbors = seed % 2;
    balanced(grid, x, {}, options);
    for (std::size_t l = 0; l < grid.levels.size(); ++l) {
      const SliceLevel &level = grid.levels[l], &old = before.levels[l];
      for (int g = 0; g < level.groups(); ++g)
        for (int k = level.groupStart[g]; k < level.groupStart[g + 1]; ++k) {
          const double upper = k + 1 < level.groupStart[g + 1] ? level.lower[k + 1] : 1.0;
          EXPECT_GE(upper - level.lower[k], 0.004 * (1.0 - 1e-9)) << "seed " << seed;
          EXPECT_LE(std::abs(level.lower[k] - old.lower[k]),
                    options.farthest[level.axis] * (1.0 + 1e-9) + 0.004 * level.parts());
          if (!options.betweenNeighbors || k == level.groupStart[g]) continue;
          EXPECT_GE(level.lower[k], old.lower[k - 1]);
        }
    }
  }
}

TEST(SliceBalance, LimitedMovesArriveInSeveralCalls)
{
  std::mt19937 random(9);
  const auto x = spread(Spread::Clusters, 20000, random);
  SliceGrid grid = gridOf(16, 1);
  SliceOptions options;
  options.betweenNeighbors = true;
  double imbalance = 16.0;
  int calls = 0;
  for (; calls < 40 && imbalance > 1.02; ++calls) imbalance = balanced(grid, x, {}, options).imbalance;
  EXPECT_LE(imbalance, 1.02);
  EXPECT_GT(calls, 1);
}

TEST(SliceBalance, WrongOptionsAndWeightsAreNamed)
{
  SliceGrid grid = gridOf(4, 1);
  const std::vector<double> x = {0.1, 0.2, 0.3};
  const auto with = [&](auto set) {
    SliceOptions options;
    set(options);
    return messageOf([&] { balanced(grid, x, {}, options); });
  };
  EXPECT_NE(with([](SliceOptions &o) { o.aim = 0.9; }).find("imbalance of 0.9"), std::string::npos);
  EXPECT_NE(with([](SliceOptions &o) { o.bins = 1; }).find("1 bins"), std::string::npos);
  EXPECT_NE(with([](SliceOptions &o) { o.rounds = 0; }).find("0 refinements"), std::string::npos);
  EXPECT_NE(with([](SliceOptions &o) { o.smallest = {-1, -1, -1}; }).find("must not be negative"), std::string::npos);
  EXPECT_NE(with([](SliceOptions &o) { o.smallest = {0.3, 0.3, 0.3}; }).find("do not fit"), std::string::npos);
  EXPECT_MESSAGE("weight -1", balanced(grid, x, {-1.0}, {}));
  EXPECT_MESSAGE("weight nan", balanced(grid, x, {std::nan("")}, {}));
  EXPECT_MESSAGE("weight inf", balanced(grid, x, {HUGE_VAL}, {}));
}
