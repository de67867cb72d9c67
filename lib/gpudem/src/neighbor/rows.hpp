// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Building the neighbour rows: keys, counts, entries, and the springs carried into them.
#pragma once

#include "neighbor/cell_directory.hpp"
#include "neighbor/contact_store.hpp"
#include "neighbor/levels.hpp"
#include "step/step_view.hpp"

namespace gpudem {

/// Entries of a row that fits a slice.
constexpr std::uint32_t longestShortRow = 64;

/// neigh_modify exclude, as tests on group bits and a table of type pairs.
struct ExclusionView {
  int groups;
  std::uint32_t groupA[maxGroupExclusions], groupB[maxGroupExclusions];
  const std::uint8_t *typeTable;  ///< [(types+1)^2], null if no type is excluded
  int types;

  GPUDEM_HD bool any() const { return groups > 0 || typeTable != nullptr; }
  GPUDEM_HD bool excluded(std::uint32_t maskI, std::uint32_t maskJ, int typeI, int typeJ) const
  {
    for (int g = 0; g < groups; ++g)
      if (((maskI & groupA[g]) && (maskJ & groupB[g])) || ((maskI & groupB[g]) && (maskJ & groupA[g]))) return true;
    return typeTable && typeTable[typeI * (types + 1) + typeJ];
  }
};

/// Do the tables remember contacts? Springs alone have a size that the compiler knows.
enum class Keeping { Nothing, Springs, Blocks };
template <Keeping keeping>
GPUDEM_HD int keptSize(int size)
{
  return keeping == Keeping::Springs ? 3 : size;
}
inline Keeping keepingOf(bool contacts, int size)
{
  return !contacts ? Keeping::Nothing : size == 3 ? Keeping::Springs : Keeping::Blocks;
}

/// Neighbours of other levels: those of grain i are coarser[offset[i] .. offset[i+1]) and finer[first[i] .. end[i]).
struct CrossView {
  const std::uint32_t *offset;  ///< [n+1], null if there is one level
  const std::uint32_t *coarser;
  const std::uint32_t *first, *end;  ///< [n]
  const std::uint32_t *finer;
};

template <class P>
struct BuildView {
  using Real = typename P::Real;
  std::uint32_t count;   ///< grains that get rows
  std::uint32_t ghosts;  ///< grains of other ranks, behind them
  PositionArrays<P> position;
  const std::uint32_t *mask;  ///< [n] group bits
  const int *type;
  const std::int32_t *tag;
  const std::uint32_t *cell;  ///< [count], [ghosts] both sorted, numbered through the levels
  CellDirectory directory;
  CellDirectory ghostDirectory;  ///< counts from the first ghost; not read if there is none
  LevelGrid levels;
  CrossView cross;
  Frame frame;
  float skin;
  float reachSlack;
  ExclusionView exclude;
};

/// Distance within which a grain of level \p own may have a neighbour of level \p coarser (distance).
template <class P>
GPUDEM_HD float coarserReach(const BuildView<P> &v, int own, int coarser)
{
  return (v.levels.largest[own] + v.levels.largest[coarser]) * 1.00001f + v.reachSlack + v.skin;
}

/// Call range(from, to) for the grains of \p cell, then for the ghosts in it.
template <class P, class Range>
GPUDEM_HD void forEachRange(const BuildView<P> &v, std::uint32_t cell, Range &&range)
{
  std::uint32_t from, to;
  v.directory.grains(cell, from, to);
  range(from, to);
  if (v.ghosts == 0) return;
  v.ghostDirectory.grains(cell, from, to);
  range(v.count + from, v.count + to);
}

/// Call visit(j, touches) for every grain j != i of the same level that lies within the coarse reach; \p touches is wrong
/// to the safe side only.
template <class P, class Visit>
GPUDEM_HD void forEachOwnNeighbor(const BuildView<P> &v, std::uint32_t i, Visit &&visit)
{
  const CoarsePosition p = v.position.coarse[i];
  const std::uint32_t mask = v.mask[i];
  const Vec3<float> unit = v.frame.unit32.template as<float>();
  const bool anyExclusion = v.exclude.any();
  const auto range = [&](std::uint32_t j, std::uint32_t end) {
    for (; j < end; ++j) {
      const CoarsePosition q = v.position.coarse[j];
      const float dx = static_cast<float>(static_cast<std::int32_t>(p.x - q.x)) * unit.x;
      const float dy = static_cast<float>(static_cast<std::int32_t>(p.y - q.y)) * unit.y;
      const float dz = static_cast<float>(static_cast<std::int32_t>(p.z - q.z)) * unit.z;
      const float contact = (p.radius + q.radius) * 1.000001f + v.reachSlack, reach = contact + v.skin;
      const float distance2 = dx * dx + dy * dy + dz * dz;
      if (distance2 >= reach * reach || j == i) continue;
      if (anyExclusion && v.exclude.excluded(mask, v.mask[j], v.type[i], v.type[j])) continue;
      visit(j, distance2 < contact * contact);
    }
  };
  forEachOwnCell(v.levels, v.cell[i], [&](std::uint32_t cell) { forEachRange(v, cell, range); });
}

/// Likewise for the grains of all levels.
template <class P, class Visit>
GPUDEM_HD void forEachNeighbor(const BuildView<P> &v, std::uint32_t i, Visit &&visit)
{
  forEachOwnNeighbor(v, i, visit);
  if (!v.cross.offset) return;
  const CoarsePosition p = v.position.coarse[i];
  const Vec3<float> unit = v.frame.unit32.template as<float>();
  const auto listed = [&](const std::uint32_t *list, std::uint32_t from, std::uint32_t to) {
    for (; from < to; ++from) {
      const std::uint32_t j = list[from];
      visit(j, mayTouch(p, v.position.coarse[j], unit, v.reachSlack));
    }
  };
  listed(v.cross.coarser, v.cross.offset[i], v.cross.offset[i + 1]);
  listed(v.cross.finer, v.cross.first[i], v.cross.end[i]);
}

template <class P>
struct CountNeighbors {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 8;
  BuildView<P> v;
  std::uint32_t *out;  ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t n = 0;
    forEachOwnNeighbor(v, i, [&](std::uint32_t, bool) { ++n; });
    if (v.cross.offset) n += v.cross.offset[i + 1] - v.cross.offset[i] + (v.cross.end[i] - v.cross.first[i]);
    out[i] = n;
  }
};

/// Width and touch words of each slice from the lengths of its rows, but for those that are long.
template <int W>
struct SliceWidths {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t count;
  const std::uint32_t *length;
  std::uint32_t *entries, *words;  ///< [slices]; words beyond the first of each row
  std::uint32_t *longRows;         ///< [slices] how many
  GPUDEM_HD void operator()(std::uint32_t slice) const
  {
    std::uint32_t widest = 0, many = 0;
    for (std::uint32_t i = slice * W; i < (slice + 1) * W && i < count; ++i) {
      const bool isLong = length[i] > longestShortRow;
      many += isLong ? 1u : 0u;
      widest = !isLong && length[i] > widest ? length[i] : widest;
    }
    longRows[slice] = many;
    entries[slice] = widest * W;
    words[slice] = widest > 32 ? (widest - 1) / 32 * W : 0u;
  }
};

struct AddToAll {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t value;
  std::uint32_t *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] += value; }
};

/// Write the rows of the slices, touching neighbours first, and put each carried spring into its entry.
template <class P, Keeping keeping, int W>
struct FillRows {
  using Real = typename P::Real;
  static constexpr bool history = keeping != Keeping::Nothing;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 4;
  BuildView<P> v;
  RowView<Real> rows;
  std::uint32_t *neighbor;
  ContactStore<Real> store;
  const std::uint32_t *oldIndex;  ///< [n] row of each grain in the store

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const std::uint32_t slice = i / W, lane = i % W;
    const std::uint32_t base = rows.start[slice] + lane;
    std::uint32_t from = 0, to = 0;
    if (history) {
      for (std::uint32_t w = 0; w < rows.words(slice, W); ++w) rows.touch[rows.wordOf(i, w, W)] = 0;
      from = store.offset[oldIndex[i]];
      to = store.offset[oldIndex[i] + 1];
    }
    std::uint32_t front = 0, back = rows.count[i];
    if (back == 0) return;  // no neighbours, or a long row
    forEachNeighbor(v, i, [&](std::uint32_t j, bool touches) {
      if (touches) {
        const std::uint32_t k = front++;
        neighbor[base + k * W] = j;
        if (history) carry(i, k, base, v.tag[j], from, to);
      } else {
        neighbor[base + (--back) * W] = j;
      }
    });
  }

 private:
  GPUDEM_HD void carry(std::uint32_t i, std::uint32_t k, std::uint32_t base, std::int32_t tag, std::uint32_t from,
                       std::uint32_t to) const
  {
    const std::uint32_t m = store.find(from, to, tag);
    if (m == to) return;
    const int size = keptSize<keeping>(store.size);
    Real *slot = rows.spring + size * static_cast<std::size_t>(base + k * W);
    for (int d = 0; d < size; ++d) slot[d] = store.spring[size * static_cast<std::size_t>(m) + d];
    rows.touch[rows.wordOf(i, k / 32, W)] |= 1u << (k % 32);
  }
};

/// Number of springs in each row.
template <class Real, int W>
struct CountSprings {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  RowView<Real> rows;
  std::uint32_t *out;  ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t n = 0;
    for (std::uint32_t w = 0; w < rows.words(i / W, W); ++w)
      n += static_cast<std::uint32_t>(bitCount(rows.touch[rows.wordOf(i, w, W)]));
    out[i] = n;
  }
};

/// Copy the springs out of the rows.
template <class Real, Keeping keeping, int W>
struct ExtractSprings {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  RowView<Real> rows;
  int storedSize;  ///< numbers per contact
  const std::int32_t *tag;
  const std::uint32_t *offset;
  std::int32_t *partner;
  Real *spring;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const std::uint32_t slice = i / W, lane = i % W;
    const int size = keptSize<keeping>(storedSize);
    std::uint32_t to = offset[i];
    for (std::uint32_t w = 0; w < rows.words(slice, W); ++w)
      for (std::uint32_t bits = rows.touch[rows.wordOf(i, w, W)]; bits; bits &= bits - 1) {
        const std::uint32_t k = w * 32 + static_cast<std::uint32_t>(lowestBit(bits));
        const std::size_t entry = rows.start[slice] + lane + static_cast<std::size_t>(k) * W;
        partner[to] = tag[rows.neighbor[entry]];
        for (int d = 0; d < size; ++d) spring[size * static_cast<std::size_t>(to) + d] = rows.spring[size * entry + d];
        ++to;
      }
  }
};

}  // namespace gpudem
