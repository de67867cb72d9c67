// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour tables of a cloud in both forms, and the same pairs by brute force.
#pragma once

#include "engine/transfer.hpp"
#include "neighbor/cross_levels.hpp"
#include "neighbor/level_choice.hpp"
#include "neighbor/pair_table.hpp"
#include "neighbor/row_table.hpp"
#include "testing/emulated_warp.h"
#include "testing/mixtures.h"

#include <gtest/gtest.h>

namespace gpudem::testing {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  ///< (i, j) of host indices, sorted

/// The tables of a cloud, by the functions that the engine calls.
template <class P>
class Search {
 public:
  Search(const Cloud &c, int levels, double ratio, bool dense) : Search(c, levels, ratio, [=](auto, auto) { return dense; }) {}
  /// The directory as the engine chooses it.
  Search(const Cloud &c, int levels, double ratio) : Search(c, levels, ratio, CellTable<CpuExec>::isDense) {}

  template <class Choose>
  Search(const Cloud &c, int levels, double ratio, const Choose &isDense) : n_(static_cast<std::uint32_t>(c.x.size()))
  {
    const double largest = *std::max_element(c.radius.begin(), c.radius.end());
    const CellGrid home = chooseGrid(c.box, 2.0 * largest + c.skin, mostCells);
    const Frame frame = chooseFrame(c.box, home);
    const LevelGrid grid =
        levelGrid(c.box, chooseLevels(c.radius.data(), n_, largest, levels, ratio), home, 0.0, c.skin);
    this->levels = grid.levels;
    gridCells = grid.cells();

    for (auto *a : {&key, &cell, &homeCell, &mask}) a->reserve(n_);
    order.reserve(n_);
    type.reserve(n_);
    tag.reserve(n_);
    Buffer<CpuExec, CoarsePosition> coarse0("");
    Buffer<CpuExec, FinePosition> fine0("");
    coarse0.reserve(n_);
    fine0.reserve(n_);
    coarse.reserve(n_);
    fine.reserve(n_);
    motion.reserve(n_);
    Buffer<CpuExec, int> image("");
    image.reserve(n_);
    PositionArrays<P> before{coarse0.data(), fine0.data(), motion.data(), 0};
    for (std::uint32_t i = 0; i < n_; ++i) {
      image.data()[i] = 512 | 512 << 10 | 512 << 20;
      motion.data()[i] = {};
      FixedPosition p{0, 0, 0, c.radius[i]};
      setCoordinates(p, c.x[i], frame);
      std::uint32_t word = 0;
      storePosition(before, i, p, word);
      homeCell.data()[i] = home.cellOf(c.x[i]);
    }
    const BoxView box{{c.box.lo[0], c.box.lo[1], c.box.lo[2]}, {c.box.hi[0], c.box.hi[1], c.box.hi[2]},
                      {c.box.periodic[0], c.box.periodic[1], c.box.periodic[2]}};
    exec.forEach(n_, PlaceGrains<P>{before, homeCell.data(), home, grid, home, frame, box, image.data(), key.data(), nullptr});
    exec.sort(key, cell, order, n_, grid.cells());
    exec.forEach(n_, Gather<CoarsePosition>{order.data(), coarse0.data(), coarse.data()});
    exec.forEach(n_, Gather<FinePosition>{order.data(), fine0.data(), fine.data()});
    for (std::uint32_t i = 0; i < n_; ++i) {
      mask.data()[i] = 1;
      type.data()[i] = 1;
      tag.data()[i] = static_cast<std::int32_t>(order.data()[i] + 1);
    }
    v.count = n_;
    v.position = {coarse.data(), fine.data(), motion.data(), 0};
    v.mask = mask.data();
    v.type = type.data();
    v.tag = tag.data();
    v.cell = cell.data();
    v.levels = grid;
    v.frame = frame;
    v.skin = static_cast<float>(c.skin);
    v.reachSlack = reachSlackOf(frame);
    dense_ = isDense(grid.cells(), n_);
    v.directory = cells.build(exec, cell.data(), n_, grid.cells(), dense_);
    v.cross = cross.build(exec, v);
  }

  /// The search once more from the sorted cells on, into the table of the CPU.
  void build()
  {
    v.directory = cells.build(exec, cell.data(), n_, v.levels.cells(), dense_);
    v.cross = cross.build(exec, v);
    table_.build(exec, v, false, {}, nullptr);
  }
  /// Candidates that the grains test, and pairs, each pair once.
  std::pair<std::uint64_t, std::uint64_t> count()
  {
    std::uint64_t candidates = 0, entries = 0;
    for (std::uint32_t i = 0; i < n_; ++i) {
      const auto add = [&](std::uint32_t c) {
        std::uint32_t from, to;
        v.directory.grains(c, from, to);
        candidates += to - from;
      };
      forEachOwnCell(v.levels, v.cell[i], add);
      const int own = v.levels.levelOfCell(v.cell[i]);
      for (int coarser = own + 1; coarser < v.levels.levels; ++coarser)
        forEachCoarserCell(v.levels, v.cell[i], coarser, static_cast<double>(coarserReach(v, own, coarser)), add);
      forEachNeighbor(v, i, [&](std::uint32_t, bool) { ++entries; });
    }
    return {candidates, entries / 2};
  }

  /// Every entry of every row.
  Pairs rows()
  {
    EmulatedExec gpu;
    CrossLevels<EmulatedExec, P> gpuCross;
    BuildView<P> w = v;
    w.cross = gpuCross.build(gpu, w);
    RowTable<EmulatedExec, P> table;
    table.build(gpu, w, false, {}, nullptr);
    const auto r = table.view();
    Pairs pairs;
    for (std::uint32_t i = 0; i < n_; ++i)
      for (std::uint32_t k = 0; k < r.count[i]; ++k)
        pairs.emplace_back(order.data()[i], order.data()[r.neighbor[r.start[i / 32] + i % 32 + k * 32]]);
    const std::uint32_t longRows = r.longFirst ? r.longFirst[chunksOf(n_, 32)] : 0u;
    for (std::uint32_t m = 0; m < longRows; ++m)
      for (std::uint32_t k = 0; k < r.longRow[m].count; ++k)
        pairs.emplace_back(order.data()[r.longRow[m].grain], order.data()[r.neighbor[r.longRow[m].start + k]]);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
  /// Every pair of every chunk, as seen from both grains where both are in the chunk.
  Pairs chunks()
  {
    PairTable<CpuExec, P> table;
    table.build(exec, v, false, {}, nullptr);
    Pairs pairs;
    for (std::uint32_t c = 0; c < chunksOf(n_, grainsPerChunk); ++c) {
      const auto &chunk = table.view()[c];
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        const std::uint32_t i = order.data()[c * grainsPerChunk + chunk.owner[k]], j = order.data()[chunk.partner[k]];
        pairs.emplace_back(i, j);
        const bool inside = chunk.partner[k] / grainsPerChunk == c;
        EXPECT_EQ(chunk.mirror[k], inside ? chunk.partner[k] % grainsPerChunk : grainsPerChunk);
        if (inside) pairs.emplace_back(j, i);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Of the directory of cells.
  std::size_t directoryBytes() const { return cells.bytes(); }

  int levels = 0;
  std::uint32_t gridCells = 0;

 private:
  using Numbers = Buffer<CpuExec, std::uint32_t>;
  CpuExec exec{1};
  std::uint32_t n_;
  Numbers key{"key"}, cell{"cell"}, homeCell{"home"}, order{"order"}, mask{"mask"};
  Buffer<CpuExec, int> type{"type"};
  Buffer<CpuExec, std::int32_t> tag{"tag"};
  Buffer<CpuExec, CoarsePosition> coarse{"coarse"};
  Buffer<CpuExec, FinePosition> fine{"fine"};
  Buffer<CpuExec, Motion<typename P::Real>> motion{"motion"};
  bool dense_ = false;
  PairTable<CpuExec, P> table_;
  CellTable<CpuExec> cells;
  CrossLevels<CpuExec, P> cross;
  BuildView<P> v{};
};

/// Distance of two grains over the distance at which they are listed.
inline double overReach(const Cloud &c, std::uint32_t i, std::uint32_t j)
{
  double d2 = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double length = c.box.hi[d] - c.box.lo[d];
    double a = c.x[i][d] - c.x[j][d];
    if (c.box.periodic[d]) a -= length * std::round(a / length);
    d2 += a * a;
  }
  return std::sqrt(d2) / (c.radius[i] + c.radius[j] + c.skin);
}

/// Every pair within reach, from both sides: sweep along x and test all whose intervals meet. Knows nothing of cells.
inline Pairs sweep(const Cloud &c)
{
  struct Interval {
    double lo, hi;
    std::uint32_t grain;
  };
  std::vector<Interval> intervals;
  const double length = c.box.hi[0] - c.box.lo[0];
  double end = c.box.lo[0];
  for (std::uint32_t i = 0; i < c.x.size(); ++i) {
    const double half = c.radius[i] + 0.5 * c.skin;
    intervals.push_back({c.x[i].x - half, c.x[i].x + half, i});
    end = std::max(end, c.x[i].x + half);
  }
  for (std::size_t i = 0; c.box.periodic[0] && i < c.x.size(); ++i) {
    const Interval image{intervals[i].lo + length, intervals[i].hi + length, intervals[i].grain};
    if (image.lo <= end) intervals.push_back(image);
  }
  std::sort(intervals.begin(), intervals.end(), [](const Interval &a, const Interval &b) { return a.lo < b.lo; });
  Pairs pairs;
  for (auto a = intervals.begin(); a != intervals.end(); ++a)
    for (auto b = a + 1; b != intervals.end() && b->lo <= a->hi; ++b) {
      if (a->grain == b->grain || overReach(c, a->grain, b->grain) > 1.0) continue;
      pairs.emplace_back(a->grain, b->grain);
      pairs.emplace_back(b->grain, a->grain);
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Each pair within reach is listed exactly once from either side; what else is listed lies within rounding of the reach.
inline void compare(const Cloud &c, const Pairs &listed, const Pairs &needed, const char *what)
{
  EXPECT_TRUE(std::adjacent_find(listed.begin(), listed.end()) == listed.end()) << what << ": a pair is listed twice";
  Pairs missing, more;
  std::set_difference(needed.begin(), needed.end(), listed.begin(), listed.end(), std::back_inserter(missing));
  std::set_difference(listed.begin(), listed.end(), needed.begin(), needed.end(), std::back_inserter(more));
  EXPECT_EQ(missing.size(), 0u) << what << ": of " << needed.size() << " pairs";
  const auto apart = [&](const auto &p) { return p.first == p.second || overReach(c, p.first, p.second) > 1.0 + 1e-5; };
  EXPECT_EQ(std::count_if(more.begin(), more.end(), apart), 0) << what << ": pairs out of reach";
}

/// All sizes, places and boundaries, each cloud with a seed of its own.
template <class P>
void compareClouds(std::size_t count, unsigned seed)
{
  std::size_t pairs = 0;
  for (const Sizes sizes : {Sizes::Bimodal, Sizes::LogNormal, Sizes::PowerLaw})
    for (const double ratio : {1.0, 3.0, 10.0, 30.0, 100.0})
      for (const Boundary &b : boundaries) {
        const Places places = static_cast<Places>(++seed % 3);
        const Cloud c = makeCloud(sizes, places, ratio, b.periodic, b.dimension, count, seed);
        SCOPED_TRACE(fmt::format("sizes {}, places {}, ratio {}, dimension {}, periodic {}{}{}, seed {}", static_cast<int>(sizes),
                                 static_cast<int>(places), ratio, b.dimension, b.periodic[0], b.periodic[1], b.periodic[2], seed));
        Search<P> search(c, 0, 2.0, seed % 2 == 0);
        const Pairs needed = sweep(c);
        compare(c, search.rows(), needed, "rows");
        compare(c, search.chunks(), needed, "chunks");
        pairs += needed.size();
      }
  EXPECT_GT(pairs, count) << "the clouds must have pairs to mean anything";
}

}  // namespace gpudem::testing
