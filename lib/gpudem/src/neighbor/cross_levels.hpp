// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Pairs of grains of different levels: found from the finer grain, listed at both.
///
/// The finer grains write their coarser neighbours one grain after the other; a stable sort by the coarser grain turns
/// that list round. Both orders depend on the order of the grains alone.
#pragma once

#include "base/saturated.hpp"
#include "neighbor/cross_search.hpp"

namespace gpudem {

/// Call visit(j) for every grain j of a coarser level within the coarse reach of grain i. Two ghosts are no pair: neither
/// has a row.
template <class P, class Visit>
GPUDEM_HD void forEachCoarserNeighbor(const BuildView<P> &v, std::uint32_t i, Visit &&visit)
{
  const CoarsePosition p = v.position.coarse[i];
  const std::uint32_t mask = v.mask[i];
  const Vec3<float> unit = v.frame.unit32.template as<float>();
  const bool anyExclusion = v.exclude.any();
  const std::uint32_t cell = v.cell[i];
  const int own = v.levels.levelOfCell(cell);
  for (int coarser = own + 1; coarser < v.levels.levels; ++coarser) {
    const float reach = coarserReach(v, own, coarser);
    forEachCoarserCell(v.levels, cell, coarser, static_cast<double>(reach), [&](std::uint32_t c) {
      forEachRange(v, c, [&](std::uint32_t j, std::uint32_t end) {
        if (i >= v.count && j >= v.count) return;
        for (; j < end; ++j) {
          const CoarsePosition q = v.position.coarse[j];
          const float near = (p.radius + q.radius) * 1.000001f + v.reachSlack + v.skin;
          if (distance2(p, q, unit) >= near * near) continue;
          if (anyExclusion && v.exclude.excluded(mask, v.mask[j], v.type[i], v.type[j])) continue;
          visit(j);
        }
      });
    });
  }
}

template <class P>
struct CountCoarser {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 8;
  BuildView<P> v;
  std::uint32_t *out;  ///< [n] grains and ghosts
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t n = 0;
    forEachCoarserNeighbor(v, i, [&](std::uint32_t) { ++n; });
    out[i] = n;
  }
};
template <class P>
struct ListCoarser {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 8;
  BuildView<P> v;
  const std::uint32_t *offset;  ///< [n+1]
  std::uint32_t *coarser, *finer;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t to = offset[i];
    forEachCoarserNeighbor(v, i, [&](std::uint32_t j) {
      coarser[to] = j;
      finer[to++] = i;
    });
  }
};

template <class Exec, class P>
class CrossLevels {
 public:
  CrossView build(Exec &exec, const BuildView<P> &v)
  {
    CrossView c{};
    if (v.levels.levels < 2) return c;
    const std::uint32_t n = v.count + v.ghosts;
    first_.reserve(n);
    end_.reserve(n);
    offset_.reserve(static_cast<std::size_t>(n) + 1);
    const std::uint32_t chunks = chunksOf(n, grainsPerChunk);
    if constexpr (Exec::onGpu) {
      exec.forEach(n, CountCoarser<P>{v, first_.data()});
    } else {
      found_.resize(chunks);
      exec.forEachChunk(chunks, FindCoarser<P>{v, first_.data(), found_.data()});
    }
    const std::uint32_t m = exec.exclusiveScan(first_.data(), offset_.data(), n);
    if (m == saturated) throw Error("the pairs of grains of different levels exceed the 32-bit index");
    for (auto *a : {&coarser_, &finer_, &sorted_, &order_}) a->reserveWithSlack(m);
    if constexpr (Exec::onGpu) exec.forEach(n, ListCoarser<P>{v, offset_.data(), coarser_.data(), finer_.data()});
    else exec.forEachChunk(chunks, JoinCoarser{n, found_.data(), offset_.data(), coarser_.data(), finer_.data()});
    exec.sort(coarser_, sorted_, order_, m, n);
    exec.fill(first_.data(), n, 0);
    exec.fill(end_.data(), n, 0);
    exec.forEach(m, CellRanges{sorted_.data(), m, first_.data(), end_.data()});
    exec.forEach(m, Gather<std::uint32_t>{order_.data(), finer_.data(), sorted_.data()});
    return {offset_.data(), coarser_.data(), first_.data(), end_.data(), sorted_.data()};
  }
  std::size_t bytes() const
  {
    std::size_t found = 0;
    for (const auto &f : found_) found += f.capacity() * sizeof(std::uint32_t);
    return found + offset_.bytes() + first_.bytes() + end_.bytes() + coarser_.bytes() + finer_.bytes() + sorted_.bytes() +
           order_.bytes();
  }

 private:
  using Array = typename Exec::template Array<std::uint32_t>;
  Array offset_{"coarser partners"}, first_{"finer partners"}, end_{"finer partners (2)"},
      coarser_{"pairs across levels"}, finer_{"pairs across levels (2)"}, sorted_{"pairs across levels (3)"},
      order_{"pairs across levels (4)"};
  std::vector<std::vector<std::uint32_t>> found_;  ///< [chunks] coarser neighbours, CPU only
};

}  // namespace gpudem
