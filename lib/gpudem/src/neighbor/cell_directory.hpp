// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Which grains lie in a cell, from the sorted cells of the grains.
///
/// Dense: two numbers for every cell of the box. Sparse: a hash table of the blocks of 64 cells that hold grains, with
/// one bit per cell, and a number per occupied cell; memory follows the grains and not the box.
#pragma once

#include "gpudem/errors.h"
#include "neighbor/place.hpp"

#include <fmt/format.h>

namespace gpudem {

/// A block of 64 cells.
struct alignas(16) CellBlock {
  std::uint32_t key;    ///< number of the block, noBlock if the slot is free
  std::uint32_t first;  ///< first of its occupied cells
  std::uint64_t mask;   ///< a bit per cell
};
constexpr std::uint32_t noBlock = 0xffffffffu;

struct CellDirectory {
  const std::uint32_t *first, *end;  ///< dense: [cells]
  const CellBlock *block;            ///< sparse: [slots]; null if dense
  const std::uint32_t *start;        ///< sparse: [occupied + 1] first grain of each occupied cell
  std::uint32_t slots;               ///< a power of two

  GPUDEM_HD static std::uint32_t slotOf(std::uint32_t key, std::uint32_t slots)
  {
    key ^= key >> 16;
    key *= 0x7feb352du;
    key ^= key >> 15;
    key *= 0x846ca68bu;
    return (key ^ key >> 16) & (slots - 1);
  }
  /// Grains [from, to) of \p cell.
  GPUDEM_HD void grains(std::uint32_t cell, std::uint32_t &from, std::uint32_t &to) const
  {
    if (!block) {
      from = first[cell];
      to = end[cell];
      return;
    }
    from = to = 0;
    const std::uint32_t key = cell >> 6;
    for (std::uint32_t s = slotOf(key, slots);; s = (s + 1) & (slots - 1)) {
      const CellBlock b = block[s];
      if (b.key == noBlock) return;
      if (b.key != key) continue;
      const std::uint64_t bit = 1ull << (cell & 63u);
      if (!(b.mask & bit)) return;
      const std::uint32_t k = b.first + static_cast<std::uint32_t>(bitCount64(b.mask & (bit - 1)));
      from = start[k];
      to = start[k + 1];
      return;
    }
  }
};

/// 1 where a cell begins.
struct CellBegins {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *cell;  ///< [n] sorted
  std::uint32_t *flag;        ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const { flag[i] = i == 0 || cell[i - 1] != cell[i] ? 1u : 0u; }
};
struct CellStarts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *cell, *rank;  ///< rank: exclusive scan of CellBegins
  std::uint32_t count;
  std::uint32_t *start;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (i == 0 || cell[i - 1] != cell[i]) start[rank[i]] = i;
    if (i + 1 == count) start[rank[count]] = count;
  }
};
/// 1 where a block begins among the occupied cells.
struct BlockBegins {
  const std::uint32_t *cell, *start;
  GPUDEM_HD std::uint32_t operator()(std::uint32_t k) const
  {
    return k == 0 || cell[start[k - 1]] >> 6 != cell[start[k]] >> 6 ? 1u : 0u;
  }
};
struct AddNumbers {
  GPUDEM_HD std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const { return a + b; }
};
struct FreeSlots {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  CellBlock *block;
  GPUDEM_HD void operator()(std::uint32_t s) const { block[s] = {noBlock, 0u, 0u}; }
};
/// Enter each block into the hash table. Where it ends up depends on the threads, what is found does not.
struct EnterBlocks {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *cell, *start;
  std::uint32_t occupied, slots;
  CellBlock *block;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    if (!BlockBegins{cell, start}(k)) return;
    const std::uint32_t key = cell[start[k]] >> 6;
    std::uint64_t mask = 0;
    for (std::uint32_t m = k; m < occupied && m < k + 64u; ++m) {
      const std::uint32_t c = cell[start[m]];
      if (c >> 6 != key) break;
      mask |= 1ull << (c & 63u);
    }
    std::uint32_t s = CellDirectory::slotOf(key, slots);
    while (!atomicClaim(&block[s].key, noBlock, key)) s = (s + 1) & (slots - 1);
    block[s].first = k;
    block[s].mask = mask;
  }
};

template <class Exec>
class CellTable {
 public:
  /// Numbers of cells up to which a dense table takes less than a sparse one, or little.
  static bool isDense(std::uint64_t cells, std::uint32_t count) { return cells <= 16ull * count || cells <= 1u << 20; }

  /// \param cell [count] sorted
  CellDirectory build(Exec &exec, const std::uint32_t *cell, std::uint32_t count, std::uint32_t cells, bool dense)
  {
    CellDirectory d{};
    if (dense) {
      first_.reserveWithSlack(cells);
      end_.reserveWithSlack(cells);
      exec.fill(first_.data(), cells, 0);
      exec.fill(end_.data(), cells, 0);
      exec.forEach(count, CellRanges{cell, count, first_.data(), end_.data()});
      d.first = first_.data();
      d.end = end_.data();
      return d;
    }
    end_.reserve(count);
    first_.reserve(static_cast<std::size_t>(count) + 1);
    exec.forEach(count, CellBegins{cell, end_.data()});
    const std::uint32_t occupied = exec.exclusiveScan(end_.data(), first_.data(), count);
    start_.reserveWithSlack(static_cast<std::size_t>(occupied) + 1);
    exec.forEach(count, CellStarts{cell, first_.data(), count, start_.data()});
    const std::uint32_t blocks = exec.reduce(occupied, BlockBegins{cell, start_.data()}, AddNumbers{}, 0u);
    d.slots = 64;
    while (d.slots < 2 * blocks) d.slots *= 2;
    block_.reserve(d.slots);
    exec.forEach(d.slots, FreeSlots{block_.data()});
    exec.forEach(occupied, EnterBlocks{cell, start_.data(), occupied, d.slots, block_.data()});
    d.block = block_.data();
    d.start = start_.data();
    return d;
  }
  std::size_t bytes() const { return first_.bytes() + end_.bytes() + start_.bytes() + block_.bytes(); }

 private:
  template <class T>
  using Array = typename Exec::template Array<T>;
  Array<std::uint32_t> first_{"first grains of cells"}, end_{"last grains of cells"}, start_{"occupied cells"};
  Array<CellBlock> block_{"blocks of cells"};
};

}  // namespace gpudem
