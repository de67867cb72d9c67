// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contacts of long rows on the GPU: a team of warps takes a segment of a row, a lane an entry.
///
/// The launch goes ahead of that of the other contacts and beside it. It leaves sums over segments; who moves the grain adds
/// them up, in the order of the row (row_contacts.hpp).
#pragma once

#include "step/row_contacts.hpp"

namespace gpudem {

template <class P, class Law, StepMode mode>
struct SegmentContacts : RowContacts<P, Law, mode> {
  using Base = RowContacts<P, Law, mode>;
  using typename Base::Real;
  using Base::loads, Base::s, Base::W;
  static constexpr int teamWarps = LongRow::segmentEntries / W;
  static constexpr int blockSize = LongRow::segmentEntries;
  static constexpr int minimumBlocks = 2;

  /// Sums of the warps.
  struct Shared {
    Real sum[loads][teamWarps];
  };

  /// All lanes of a team call this together, once for each segment.
  GPUDEM_HD void operator()(std::uint32_t segment, Shared &shared) const
  {
    letNextStart();
    const LongRow row = s.rows.longRow[s.rows.rowOfSegment[segment]];
    const std::uint32_t lane = warpLane(), warp = teamWarp();
    const std::uint32_t first = (segment - row.segment) * LongRow::segmentEntries + warp * W;
    if (s.sequence > s.status->lastAllowed) return;
    Real load[loads] = {};
    if (first < row.count) visit(row, first, load);
    for (int d = 0; d < loads; ++d)
      if (lane == 0) shared.sum[d][warp] = load[d];
    teamSync();
    if (warp == 0 && lane < loads) {
      Real sum(0);
      for (int w = 0; w < teamWarps; ++w) sum += shared.sum[lane][w];
      s.rows.segmentLoad[static_cast<std::size_t>(segment) * loads + lane] = sum;
    }
    waitForEarlier();  // who waits for this launch waits for those before it
  }

 private:
  /// Entries first .. first + 31 of the row, one to each lane. \param load their sum
  GPUDEM_HD void visit(const LongRow &row, std::uint32_t first, Real *load) const
  {
    const std::uint32_t lane = warpLane(), bit = 1u << lane, word = row.word + first / W, entry = row.start + first + lane;
    const std::uint32_t marked = s.refresh ? 0xffffffffu : s.rows.near[word];
    const std::uint32_t old = Law::keeps(s) ? s.rows.touch[word] : 0u;
    bool touches = false, near = false;
    if (first + lane < row.count && (marked & bit)) {
      const CoarsePosition c = s.in.coarse[row.grain], o = s.in.coarse[s.rows.neighbor[entry]];
      const float apart2 = distance2(c, o, s.coarseUnit);
      const float reach = (c.radius + o.radius) * 1.000001f + s.reachSlack, inner = reach + s.innerSkin;
      near = apart2 < inner * inner;
      touches = apart2 < reach * reach && this->evaluate(row.grain, entry, (old & bit) != 0, load);
    }
    const std::uint32_t nearBits = warpBallot(near), now = warpBallot(touches);
    if (s.refresh && lane == 0) s.rows.near[word] = nearBits;
    if (Law::keeps(s) && lane == 0 && now != old) s.rows.touch[word] = now;
    if (now == 0) return;
    for (int d = 0; d < loads; ++d) load[d] = warpSum(touches ? load[d] : Real(0));
  }
};

}  // namespace gpudem
