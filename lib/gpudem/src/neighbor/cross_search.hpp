// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The search across levels on the CPU: the grains of a block of 64 cells share their coarser candidates.
///
/// What can meet none of the block is left out first; the rest is tested in SIMD lanes. Same neighbours in the same
/// order as grain by grain (cross_levels.hpp).
#pragma once

#include "neighbor/cell_search.hpp"
#include "neighbor/pair_chunk.hpp"

namespace gpudem {

/// What surrounds the grains of a block of cells, to leave out candidates that are too far from all of them.
struct BlockBounds {
  std::uint32_t centre[3];  ///< of the block, in coarse coordinates
  float lo[3], hi[3];       ///< of the grains, from the centre (distance); infinite where windows are too short to tell
  float unit[3];

  float fromCentre(std::uint32_t x, int d) const
  {
    return static_cast<float>(static_cast<std::int32_t>(x - centre[d])) * unit[d];
  }
  /// Is a grain within \p reach of the others?
  bool meets(const CoarsePosition &p, float reach) const
  {
    const std::uint32_t x[3] = {p.x, p.y, p.z};
    for (int d = 0; d < 3; ++d) {
      const float away = fromCentre(x[d], d);
      if (away < lo[d] - reach || away > hi[d] + reach) return false;
    }
    return true;
  }
};

/// \param cell  the first of the block, in its level's grid
/// \param reach of the largest grains to each other (distance)
template <class P>
BlockBounds blockBounds(const BuildView<P> &v, const CellGrid &grid, const Vec3<int> &cell, std::uint32_t begin,
                        std::uint32_t end, float reach)
{
  BlockBounds b;
  for (int d = 0; d < 3; ++d) {
    const double centre = grid.lo[d] + (cell[d] + 2.0) * grid.size[d];
    b.centre[d] = static_cast<std::uint32_t>(toFraction(centre, v.frame.origin[d], v.frame.inverse[d]) >> 32);
    b.unit[d] = static_cast<float>(v.frame.unit32[d]);
    b.lo[d] = HUGE_VALF;
    b.hi[d] = -HUGE_VALF;
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    const CoarsePosition p = v.position.coarse[i];
    const std::uint32_t x[3] = {p.x, p.y, p.z};
    for (int d = 0; d < 3; ++d) {
      b.lo[d] = std::min(b.lo[d], b.fromCentre(x[d], d));
      b.hi[d] = std::max(b.hi[d], b.fromCentre(x[d], d));
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (std::max(-b.lo[d], b.hi[d]) + reach < 0.45f * static_cast<float>(v.frame.window[d])) continue;
    b.lo[d] = -HUGE_VALF;
    b.hi[d] = HUGE_VALF;
  }
  return b;
}

/// Grains of coarser levels that may be neighbours of the grains [begin, end) of one block.
template <class P>
void collectCoarser(const BuildView<P> &v, std::uint32_t begin, std::uint32_t end, CandidateList &list)
{
  list.clear();
  const LevelGrid &levels = v.levels;
  const std::uint32_t cell = v.cell[begin];
  const int own = levels.levelOfCell(cell);
  const Vec3<int> first = levels.grid[own].coordinates((cell - levels.firstCell[own]) & ~63u);
  if (own + 1 == levels.levels) return;
  const BlockBounds bounds = blockBounds(v, levels.grid[own], first, begin, end, coarserReach(v, own, levels.levels - 1));
  for (int coarser = own + 1; coarser < levels.levels; ++coarser)
    forEachCoarserCell(levels, own, first, 4, coarser, static_cast<double>(coarserReach(v, own, coarser)), [&](std::uint32_t c) {
      forEachRange(v, c, [&](std::uint32_t j, std::uint32_t last) {
        if (begin >= v.count && j >= v.count) return;  // ghosts get no rows
        list.makeRoom(last - j);
        for (; j < last; ++j) {
          const CoarsePosition q = v.position.coarse[j];
          if (bounds.meets(q, (levels.largest[own] + q.radius) * 1.00001f + v.reachSlack + v.skin)) list.add(q, j);
        }
      });
    });
}

/// Coarser neighbours of the grains of each chunk, one grain after the other.
template <class P>
struct FindCoarser {
  BuildView<P> v;
  std::uint32_t *count;               ///< [n], ghosts included
  std::vector<std::uint32_t> *found;  ///< [chunks]
  void operator()(std::uint32_t chunk) const
  {
    static thread_local CandidateList candidates;
    std::vector<std::uint32_t> &out = found[chunk];
    out.clear();
    const bool anyExclusion = v.exclude.any();
    const std::uint32_t begin = chunk * grainsPerChunk, end = std::min(v.count + v.ghosts, begin + grainsPerChunk);
    std::uint32_t blockEnd = begin;
    for (std::uint32_t i = begin; i < end; ++i) {
      if (i == blockEnd) {
        const std::uint32_t last = i < v.count ? std::min(end, v.count) : end;
        while (blockEnd < last && v.cell[blockEnd] >> 6 == v.cell[i] >> 6) ++blockEnd;
        collectCoarser(v, i, blockEnd, candidates);
      }
      const std::size_t before = out.size(), near = findNear(v, i, candidates);
      for (std::size_t k = 0; k < near; ++k) {
        const std::uint32_t j = candidates.found[k];
        if (anyExclusion && v.exclude.excluded(v.mask[i], v.mask[j], v.type[i], v.type[j])) continue;
        out.push_back(j);
      }
      count[i] = static_cast<std::uint32_t>(out.size() - before);
    }
  }
};
struct JoinCoarser {
  std::uint32_t grains;  ///< ghosts included
  const std::vector<std::uint32_t> *found;
  const std::uint32_t *offset;  ///< [n+1]
  std::uint32_t *coarser, *finer;
  void operator()(std::uint32_t chunk) const
  {
    const std::uint32_t begin = chunk * grainsPerChunk, end = std::min(grains, begin + grainsPerChunk);
    std::copy(found[chunk].begin(), found[chunk].end(), coarser + offset[begin]);
    for (std::uint32_t i = begin; i < end; ++i) std::fill(finer + offset[i], finer + offset[i + 1], i);
  }
};

}  // namespace gpudem
