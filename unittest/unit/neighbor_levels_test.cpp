// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour tables of grains of many sizes against every pair of grains, in both table forms.

#include "testing/level_search.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

TEST(NeighborLevels, EveryPairInMixed) { compareClouds<Mixed>(1200, 1000); }
TEST(NeighborLevels, EveryPairInDouble) { compareClouds<Double>(1200, 2000); }

TEST(NeighborLevels, TheNumberOfLevelsDoesNotMatter)
{
  const Cloud c = makeCloud(Sizes::LogNormal, Places::Uniform, 20.0, {true, true, true}, 3, 3000, 7);
  Search<Mixed> one(c, 1, 2.0, true);
  const Pairs expected = one.rows();
  compare(c, expected, sweep(c), "one level");
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
  const Pairs needed = sweep(c);
  compare(c, search.rows(), needed, "rows");
  compare(c, search.chunks(), needed, "chunks");
}

/// Two heaps a million diameters above each other: nothing is kept for the cells between them.
TEST(NeighborLevels, TallSparseDomain)
{
  for (const double ratio : {1.0, 10.0, 100.0}) {
    Cloud c = makeCloud(Sizes::PowerLaw, Places::Uniform, ratio, {true, true, false}, 3, 4000, 11);
    const double height = c.box.hi[2] - c.box.lo[2], lift = 1e6 * ratio;
    for (std::size_t i = 0; i < c.x.size(); i += 2) c.x[i].z += lift;
    c.box.hi[2] = c.box.lo[2] + lift + height;
    Search<Mixed> search(c, 0, 2.0, false);
    EXPECT_GT(search.gridCells, 1000.0 * c.x.size()) << "the case must have empty cells to mean anything";
    EXPECT_LT(search.directoryBytes(), 100u * c.x.size());
    const Pairs needed = sweep(c);
    compare(c, search.rows(), needed, "rows");
    compare(c, search.chunks(), needed, "chunks");
  }
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

/// Every contact is found again by its partner, in rows of any length, and keeps its numbers.
TEST(NeighborLevels, ContactsAreFoundByTheirPartners)
{
  CpuExec exec(1);
  std::mt19937 random(9);
  const std::vector<std::uint32_t> lengths = {0, 3, longestUnsortedRow, longestUnsortedRow + 1, 5000, 1, 0, 70000, 12};
  std::vector<std::uint32_t> offset = {0};
  std::vector<std::int32_t> partner;
  for (const std::uint32_t length : lengths) {
    std::vector<std::int32_t> row(length);
    for (std::uint32_t k = 0; k < length; ++k) row[k] = static_cast<std::int32_t>(3 * k + 1);
    std::shuffle(row.begin(), row.end(), random);
    partner.insert(partner.end(), row.begin(), row.end());
    offset.push_back(static_cast<std::uint32_t>(partner.size()));
  }
  std::vector<float> spring;
  for (std::uint32_t row = 0; row < lengths.size(); ++row)
    for (std::uint32_t m = offset[row]; m < offset[row + 1]; ++m)
      for (int d = 0; d < 2; ++d) spring.push_back(static_cast<float>(100000 * d + partner[m]) + 0.1f * static_cast<float>(row));
  StoreSorter<CpuExec, float> sorter;
  sorter.sort(exec, static_cast<std::uint32_t>(lengths.size()), 2, offset.data(), partner.data(), spring.data());
  const ContactStore<float> store{2, offset.data(), partner.data(), spring.data()};
  for (std::uint32_t row = 0; row < lengths.size(); ++row) {
    const std::uint32_t from = offset[row], to = offset[row + 1];
    for (std::uint32_t k = 0; k < lengths[row]; ++k) {
      const auto tag = static_cast<std::int32_t>(3 * k + 1);
      const std::uint32_t m = store.find(from, to, tag);
      ASSERT_LT(m, to);
      ASSERT_EQ(store.partner[m], tag);
      for (int d = 0; d < 2; ++d)
        ASSERT_EQ(store.spring[2 * m + d], static_cast<float>(100000 * d + tag) + 0.1f * static_cast<float>(row));
      ASSERT_EQ(store.find(from, to, tag + 1), to);
    }
    EXPECT_EQ(store.find(from, to, 0), to);
    EXPECT_EQ(store.find(from, to, 1 << 30), to);
  }
}

}  // namespace
