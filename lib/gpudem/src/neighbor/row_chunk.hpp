// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour search on the CPU: grains of one cell share their candidates, which are tested in SIMD lanes.
///
/// Same candidates, same test and same order as rows.hpp, so the rows are the same.
#pragma once

#include "neighbor/rows.hpp"

#include <vector>

namespace gpudem {

/// Candidates of one cell, one array per quantity.
struct CandidateList {
  std::vector<std::uint32_t> x, y, z, index;
  std::vector<float> radius;
  std::vector<std::uint8_t> near;

  std::size_t size() const { return count; }
  void clear() { count = 0; }
  void makeRoom(std::size_t more)
  {
    if (count + more <= index.size()) return;
    const std::size_t room = 2 * (count + more) + 64;
    for (auto *v : {&x, &y, &z, &index}) v->resize(room);
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

template <class P>
void collectCandidates(const BuildView<P> &v, std::uint32_t cell, CandidateList &list)
{
  list.clear();
  forEachCellAround(v.grid, cell, [&](std::uint32_t other) {
    const std::uint32_t first = v.cellFirst[other], end = v.cellEnd[other];
    list.makeRoom(end - first);
    for (std::uint32_t j = first; j < end; ++j) list.add(v.position.coarse[j], j);
  });
}

/// Mark the candidates within reach of grain i (itself included).
template <class P>
void testCandidates(const BuildView<P> &v, std::uint32_t i, CandidateList &list)
{
  const CoarsePosition p = v.position.coarse[i];
  const float ux = static_cast<float>(v.frame.unit32.x), uy = static_cast<float>(v.frame.unit32.y),
              uz = static_cast<float>(v.frame.unit32.z);
  const float slack = v.skin, more = v.reachSlack;
  const std::size_t size = list.size();
  const std::uint32_t *x = list.x.data(), *y = list.y.data(), *z = list.z.data();
  const float *radius = list.radius.data();
  std::uint8_t *near = list.near.data();
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const float dx = static_cast<float>(static_cast<std::int32_t>(p.x - x[k])) * ux;
    const float dy = static_cast<float>(static_cast<std::int32_t>(p.y - y[k])) * uy;
    const float dz = static_cast<float>(static_cast<std::int32_t>(p.z - z[k])) * uz;
    const float reach = (p.radius + radius[k]) * 1.000001f + slack + more;
    near[k] = dx * dx + dy * dy + dz * dz < reach * reach ? 1 : 0;
  }
}

/// Call row(i, neighbours) for the grains of a chunk; neighbours calls its argument with each neighbour.
template <class P, class Row>
void forEachRow(const BuildView<P> &v, std::uint32_t begin, std::uint32_t end, Row &&row)
{
  CandidateList list;
  const bool anyExclusion = v.exclude.groups > 0 || v.exclude.typeTable != nullptr;
  for (std::uint32_t i = begin; i < end; ++i) {
    if (i == begin || v.cell[i] != v.cell[i - 1]) collectCandidates(v, v.cell[i], list);
    testCandidates(v, i, list);
    row(i, [&](auto &&visit) {
      for (std::size_t k = 0; k < list.size(); ++k) {
        if (!list.near[k]) continue;
        const std::uint32_t j = list.index[k];
        if (j == i) continue;
        if (anyExclusion &&
            v.exclude.excluded(v.motion[i].mask, v.motion[j].mask, v.type[i], v.type[j]))
          continue;
        visit(j);
      }
    });
  }
}

/// Neighbours found by the first pass, chunk by chunk: the second pass need not search again.
using FoundNeighbors = std::vector<std::vector<std::uint32_t>>;

template <class P>
struct CountNeighborsChunk {
  static constexpr std::uint32_t chunk = 256;
  CountNeighbors<P> pass;
  FoundNeighbors *found;   ///< [chunks]
  void operator()(std::uint32_t c) const
  {
    const std::uint32_t begin = c * chunk, end = std::min(pass.v.count, begin + chunk);
    std::vector<std::uint32_t> &list = (*found)[c];
    list.clear();
    forEachRow(pass.v, begin, end, [&](std::uint32_t i, auto &&neighbors) {
      const std::size_t before = list.size();
      neighbors([&](std::uint32_t j) { list.push_back(j); });
      pass.out[i] = static_cast<std::uint32_t>(list.size() - before);
    });
  }
};

template <class P, bool history>
struct FillRowsChunk {
  static constexpr std::uint32_t chunk = CountNeighborsChunk<P>::chunk;
  FillRows<P, history, 1> pass;
  const FoundNeighbors *found;
  void operator()(std::uint32_t c) const
  {
    const std::uint32_t begin = c * chunk, end = std::min(pass.v.count, begin + chunk);
    const std::uint32_t *next = (*found)[c].data();
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t *first = next;
      next += pass.length[i];
      pass.fillRow(i, [&](auto &&visit) {
        for (const std::uint32_t *j = first; j != next; ++j) visit(*j);
      });
    }
  }
};

}  // namespace gpudem
