// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour search on the CPU: grains of one cell share their candidates, which are tested in SIMD lanes.
///
/// Same candidates and same test as rows.hpp, so the neighbours are the same.
#pragma once

#include "neighbor/rows.hpp"

#include <vector>

namespace gpudem {

/// Candidates of one cell, one array per quantity.
struct CandidateList {
  std::vector<std::uint32_t> x, y, z, index, found;
  std::vector<float> radius;
  std::vector<std::uint8_t> near;

  std::size_t size() const { return count; }
  void clear() { count = 0; }
  void makeRoom(std::size_t more)
  {
    if (count + more <= index.size()) return;
    const std::size_t room = 2 * (count + more) + 64;
    for (auto *v : {&x, &y, &z, &index, &found}) v->resize(room);
    radius.resize(room);
    near.resize(room);
  }
  /// After makeRoom().
  void add(const CoarsePosition &p, std::uint32_t j)
  {
    x[count] = p.x;
    y[count] = p.y;
    z[count] = p.z;
    radius[count] = p.radius;
    index[count] = j;
    ++count;
  }

 private:
  std::size_t count = 0;
};

/// Grains that may be neighbours of the grains of \p cell as far as [begin, end) lists each of its pairs once: of
/// the grains from \p begin on, those before the cell's own are left out.
template <class P>
void collectCandidates(const BuildView<P> &v, std::uint32_t cell, std::uint32_t begin, CandidateList &list)
{
  list.clear();
  std::uint32_t own, ownEnd;
  v.directory.grains(cell, own, ownEnd);
  own = own > begin ? own : begin;
  forEachOwnCell(v.levels, cell, [&](std::uint32_t other) {
    std::uint32_t first, end;
    v.directory.grains(other, first, end);
    list.makeRoom(end - first);
    for (; first < end && first < begin; ++first) list.add(v.position.coarse[first], first);
    for (first = first > own ? first : own; first < end; ++first) list.add(v.position.coarse[first], first);
    if (v.ghosts == 0) return;
    v.ghostDirectory.grains(other, first, end);
    list.makeRoom(end - first);
    for (; first < end; ++first) list.add(v.position.coarse[v.count + first], v.count + first);
  });
}

/// The candidates within reach of grain i (itself included). \return how many
template <class P>
std::size_t findNear(const BuildView<P> &v, std::uint32_t i, CandidateList &list)
{
  const CoarsePosition p = v.position.coarse[i];
  const float ux = static_cast<float>(v.frame.unit32.x), uy = static_cast<float>(v.frame.unit32.y),
              uz = static_cast<float>(v.frame.unit32.z);
  const float slack = v.skin, more = v.reachSlack;
  const std::size_t size = list.size();
  const std::uint32_t *x = list.x.data(), *y = list.y.data(), *z = list.z.data(), *index = list.index.data();
  const float *radius = list.radius.data();
  std::uint8_t *near = list.near.data();
  std::uint32_t *found = list.found.data();
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const float dx = static_cast<float>(static_cast<std::int32_t>(p.x - x[k])) * ux;
    const float dy = static_cast<float>(static_cast<std::int32_t>(p.y - y[k])) * uy;
    const float dz = static_cast<float>(static_cast<std::int32_t>(p.z - z[k])) * uz;
    const float reach = (p.radius + radius[k]) * 1.000001f + more + slack;
    near[k] = dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0;
  }
  std::size_t n = 0;
  for (std::size_t k = 0; k < size; ++k) {
    found[n] = index[k];
    n += near[k];
  }
  return n;
}

/// Call pair(i, j) for each pair with a grain of [begin, end); a pair within the range comes once.
template <class P, class Pair>
void forEachPair(const BuildView<P> &v, std::uint32_t begin, std::uint32_t end, CandidateList &list, Pair &&pair)
{
  const bool anyExclusion = v.exclude.any();
  for (std::uint32_t i = begin; i < end; ++i) {
    if (i == begin || v.cell[i] != v.cell[i - 1]) collectCandidates(v, v.cell[i], begin, list);
    const std::size_t n = findNear(v, i, list);
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t j = list.found[k];
      if (j == i || (j < i && j >= begin)) continue;
      if (anyExclusion && v.exclude.excluded(v.mask[i], v.mask[j], v.type[i], v.type[j])) continue;
      pair(i, j);
    }
    if (!v.cross.offset) continue;
    for (std::uint32_t k = v.cross.offset[i]; k < v.cross.offset[i + 1]; ++k) pair(i, v.cross.coarser[k]);
    for (std::uint32_t k = v.cross.first[i]; k < v.cross.end[i]; ++k) {
      const std::uint32_t j = v.cross.finer[k];
      if (j < begin || j >= end) pair(i, j);  // within the range the finer grain lists the pair
    }
  }
}

}  // namespace gpudem
