// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour tables of grains of many sizes against every pair of grains, in both table forms.

#include "base/exec_cpu.hpp"
#include "engine/transfer.hpp"
#include "neighbor/cross_levels.hpp"
#include "neighbor/level_choice.hpp"
#include "neighbor/pair_table.hpp"
#include "neighbor/row_table.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

using namespace gpudem;

namespace {

enum class Sizes { Equal, Bimodal, LogNormal, PowerLaw };
enum class Places { Uniform, Clustered, Lattice };

struct Cloud {
  Box box;
  double skin = 0.0;
  std::vector<Vec3<double>> x;
  std::vector<double> radius;
};

double sizeOf(Sizes sizes, double ratio, double smallest, std::mt19937_64 &random)
{
  std::uniform_real_distribution<double> u(0.0, 1.0);
  switch (sizes) {
    case Sizes::Equal:
      return smallest;
    case Sizes::Bimodal:
      return u(random) < 0.9 ? smallest : smallest * ratio;
    case Sizes::LogNormal: {
      std::normal_distribution<double> n(0.5 * std::log(ratio), std::log(ratio) / 6.0);
      return smallest * std::clamp(std::exp(n(random)), 1.0, ratio);
    }
    case Sizes::PowerLaw:  // number density r^-3 between the smallest and the largest
      return smallest / std::sqrt(1.0 - u(random) * (1.0 - 1.0 / (ratio * ratio)));
  }
  return smallest;
}

Cloud makeCloud(Sizes sizes, Places places, double ratio, std::array<bool, 3> periodic, int dimension, std::size_t count,
                unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::normal_distribution<double> n(0.0, 0.03);
  Cloud c;
  c.skin = 0.3;
  c.box.periodic = periodic;
  c.box.dimension = dimension;
  const double smallest = 0.5;
  c.radius.resize(count);
  double volume = 0.0;
  for (double &r : c.radius) {
    r = sizeOf(sizes, ratio, smallest, random);
    volume += dimension == 2 ? 4.0 * r * r : 8.0 * r * r * r;
  }
  const double least = 2.2 * (2.0 * smallest * ratio + c.skin);  // of a periodic box
  const double edge = std::max(least, dimension == 2 ? std::sqrt(volume) : std::cbrt(volume));
  for (int d = 0; d < 3; ++d) {
    c.box.lo[d] = -0.3 * edge;
    c.box.hi[d] = c.box.lo[d] + edge * (1.0 + 0.37 * d);
  }
  if (dimension == 2) {
    c.box.lo[2] = -0.5;
    c.box.hi[2] = 0.5;
  }
  std::vector<Vec3<double>> centres;
  for (int k = 0; k < 8; ++k) centres.push_back({u(random), u(random), u(random)});
  for (std::size_t i = 0; i < count; ++i) {
    Vec3<double> f{u(random), u(random), u(random)};
    if (places == Places::Clustered) {
      const Vec3<double> &m = centres[random() % centres.size()];
      f = {m.x + n(random), m.y + n(random), m.z + n(random)};
    }
    if (places == Places::Lattice) f = {std::floor(f.x * 16) / 16, std::floor(f.y * 16) / 16, std::floor(f.z * 16) / 16};
    Vec3<double> x;
    for (int d = 0; d < 3; ++d) {
      f[d] = periodic[d] ? f[d] - std::floor(f[d]) : std::clamp(f[d], 0.0, 1.0);
      x[d] = c.box.lo[d] + f[d] * (c.box.hi[d] - c.box.lo[d]);
    }
    if (dimension == 2) x.z = 0.0;
    c.x.push_back(x);
  }
  return c;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  ///< (i, j) of host indices, sorted

/// The tables of a cloud, by the functions that the engine calls.
template <class P>
class Search {
 public:
  Search(const Cloud &c, int levels, double ratio, bool dense) : n_(static_cast<std::uint32_t>(c.x.size()))
  {
    const double largest = *std::max_element(c.radius.begin(), c.radius.end());
    const CellGrid home = chooseGrid(c.box, 2.0 * largest + c.skin, mostCells);
    const Frame frame = chooseFrame(c.box, home);
    const LevelGrid grid =
        levelGrid(c.box, chooseLevels(c.radius.data(), n_, largest, levels, ratio, ratio), home, 0.0, c.skin);
    this->levels = grid.levels;

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
    v.directory = cells.build(exec, cell.data(), n_, grid.cells(), dense);
    v.cross = cross.build(exec, v);
  }

  /// Every entry of every row.
  Pairs rows()
  {
    RowTable<CpuExec, P> table;
    table.build(exec, v, false, {}, nullptr);
    const auto r = table.view();
    Pairs pairs;
    for (std::uint32_t i = 0; i < n_; ++i)
      for (std::uint32_t k = 0; k < r.count[i]; ++k)
        pairs.emplace_back(order.data()[i], order.data()[r.neighbor[r.start[i / 32] + i % 32 + k * 32]]);
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

  int levels = 0;

 private:
  using Numbers = Buffer<CpuExec, std::uint32_t>;
  CpuExec exec{2};
  std::uint32_t n_;
  Numbers key{"key"}, cell{"cell"}, homeCell{"home"}, order{"order"}, mask{"mask"};
  Buffer<CpuExec, int> type{"type"};
  Buffer<CpuExec, std::int32_t> tag{"tag"};
  Buffer<CpuExec, CoarsePosition> coarse{"coarse"};
  Buffer<CpuExec, FinePosition> fine{"fine"};
  Buffer<CpuExec, Motion<typename P::Real>> motion{"motion"};
  CellTable<CpuExec> cells;
  CrossLevels<CpuExec, P> cross;
  BuildView<P> v{};
};

/// Each pair within reach is listed exactly once from either side; what else is listed lies within rounding of the reach.
void compare(const Cloud &c, const Pairs &listed, const char *what)
{
  EXPECT_TRUE(std::adjacent_find(listed.begin(), listed.end()) == listed.end()) << what << ": a pair is listed twice";
  const auto n = static_cast<std::uint32_t>(c.x.size());
  const double largest = *std::max_element(c.radius.begin(), c.radius.end());
  const auto gap = [&](std::uint32_t i, std::uint32_t j) {  // distance over reach
    double d2 = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double length = c.box.hi[d] - c.box.lo[d];
      double a = c.x[i][d] - c.x[j][d];
      if (c.box.periodic[d]) a -= length * std::round(a / length);
      d2 += a * a;
    }
    return std::sqrt(d2) / (c.radius[i] + c.radius[j] + c.skin);
  };
  std::size_t wrong = 0, missing = 0, needed = 0;
  for (const auto &[i, j] : listed) wrong += i == j || gap(i, j) > 1.0 + 1e-5;
  EXPECT_EQ(wrong, 0u) << what << ": pairs out of reach";
  // candidates by a sweep along x
  std::vector<std::uint32_t> byX(n);
  for (std::uint32_t i = 0; i < n; ++i) byX[i] = i;
  std::sort(byX.begin(), byX.end(), [&](std::uint32_t a, std::uint32_t b) { return c.x[a].x < c.x[b].x; });
  const double length = c.box.hi[0] - c.box.lo[0];
  for (std::uint32_t a = 0; a < n; ++a) {
    const std::uint32_t i = byX[a];
    for (std::uint32_t s = 1; s < n; ++s) {
      const bool around = a + s >= n;
      if (around && !c.box.periodic[0]) break;
      const std::uint32_t j = byX[(a + s) % n];
      if (c.x[j].x + (around ? length : 0.0) - c.x[i].x > c.radius[i] + largest + c.skin) break;
      if (gap(i, j) > 1.0) continue;
      ++needed;
      missing += !std::binary_search(listed.begin(), listed.end(), std::make_pair(i, j));
      missing += !std::binary_search(listed.begin(), listed.end(), std::make_pair(j, i));
    }
  }
  EXPECT_EQ(missing, 0u) << what << ": of " << needed << " pairs";
  EXPECT_GT(needed, 0u) << "the cloud has no pairs";
}

struct Boundary {
  std::array<bool, 3> periodic;
  int dimension;
};
const Boundary boundaries[] = {{{true, true, true}, 3}, {{false, false, false}, 3}, {{true, false, true}, 3}, {{true, false, true}, 2}};

template <class P>
void checkAll(std::size_t count, unsigned seed)
{
  for (const Sizes sizes : {Sizes::Bimodal, Sizes::LogNormal, Sizes::PowerLaw})
    for (const double ratio : {1.0, 3.0, 10.0, 30.0, 100.0})
      for (const Boundary &b : boundaries) {
        const Places places = static_cast<Places>(seed % 3);
        const Cloud c = makeCloud(sizes, places, ratio, b.periodic, b.dimension, count, ++seed);
        SCOPED_TRACE(fmt::format("sizes {}, places {}, ratio {}, dimension {}, periodic {}{}{}, seed {}", static_cast<int>(sizes),
                                 static_cast<int>(places), ratio, b.dimension, b.periodic[0], b.periodic[1], b.periodic[2], seed));
        Search<P> search(c, 0, 2.0, seed % 2 == 0);
        compare(c, search.rows(), "rows");
        compare(c, search.chunks(), "chunks");
      }
}

TEST(NeighborLevels, EveryPairInMixed) { checkAll<Mixed>(1200, 1000); }
TEST(NeighborLevels, EveryPairInDouble) { checkAll<Double>(1200, 2000); }

TEST(NeighborLevels, TheNumberOfLevelsDoesNotMatter)
{
  const Cloud c = makeCloud(Sizes::LogNormal, Places::Uniform, 20.0, {true, true, true}, 3, 3000, 7);
  Search<Mixed> one(c, 1, 2.0, true);
  const Pairs expected = one.rows();
  compare(c, expected, "one level");
  EXPECT_EQ(one.levels, 1);
  for (int levels = 2; levels <= maxLevels; ++levels)
    for (const bool dense : {false, true}) {
      Search<Mixed> several(c, levels, 2.0, dense);
      EXPECT_LE(several.levels, levels);
      EXPECT_EQ(several.rows(), expected) << levels << " levels";
      EXPECT_EQ(several.chunks(), expected) << levels << " levels";
    }
}

TEST(NeighborLevels, OneBodyTouchesThousands)
{
  Cloud c = makeCloud(Sizes::Equal, Places::Uniform, 30.0, {false, false, false}, 3, 20000, 3);
  c.x[0] = {0.0, 0.0, 0.0};
  c.radius[0] = 15.0;
  Search<Mixed> search(c, 0, 2.0, false);
  EXPECT_EQ(search.levels, 2);
  compare(c, search.rows(), "rows");
  compare(c, search.chunks(), "chunks");
}

TEST(NeighborLevels, MemoryFollowsTheGrainsNotTheBox)
{
  CpuExec exec(1);
  CellTable<CpuExec> table;
  std::vector<std::uint32_t> cell = {5, 5, 70, 1u << 20, 1u << 30, (1u << 30) + 1, 0x7fffffffu};
  const CellDirectory d = table.build(exec, cell.data(), static_cast<std::uint32_t>(cell.size()), 0x80000000u, false);
  EXPECT_LT(table.bytes(), 4096u);
  std::uint32_t from, to;
  for (std::uint32_t i = 0; i < cell.size(); ++i) {
    d.grains(cell[i], from, to);
    EXPECT_LE(from, i);
    EXPECT_GT(to, i);
    EXPECT_EQ(to - from, cell[i] == 5 ? 2u : 1u);
  }
  for (const std::uint32_t empty : {0u, 6u, 71u, 69u, 1u << 19, (1u << 30) + 2, 0x7ffffffeu}) {
    d.grains(empty, from, to);
    EXPECT_EQ(from, to) << empty;
  }
}

TEST(NeighborLevels, SortOfFewKeysInAWideRange)
{
  CpuExec exec(1);
  std::mt19937 random(5);
  const std::uint32_t n = 4000;
  Buffer<CpuExec, std::uint32_t> key("key"), out("out"), order("order");
  for (auto *a : {&key, &out, &order}) a->reserve(n);
  for (const std::uint32_t range : {4u * n + 100000u, 1u << 24, 0x80000000u, 0xffffffffu}) {
    for (std::uint32_t i = 0; i < n; ++i) key.data()[i] = i % 3 ? random() % range : range - 1 - i % 7;
    exec.sort(key, out, order, n, range);
    for (std::uint32_t k = 0; k < n; ++k) {
      ASSERT_EQ(out.data()[k], key.data()[order.data()[k]]);
      if (k == 0) continue;
      const bool equal = out.data()[k - 1] == out.data()[k];
      ASSERT_TRUE(equal ? order.data()[k - 1] < order.data()[k] : out.data()[k - 1] < out.data()[k]);
    }
  }
}

}  // namespace
