// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The step on the GPU: all forces on the 32 grains of a warp, then their motion. The heart of the program.
///
/// A row lists the grains within the sum of radii plus the skin. Inside it, a bit per entry marks those near enough to
/// touch within the next steps (the inner reach); only a launch that refreshes these bits looks at the whole row, the
/// others visit the marked entries alone. Candidates of the 32 grains form one queue, so that all lanes evaluate
/// contacts though the rows differ in their number. Afterwards every grain collects its sums from the lanes that
/// worked for it, in the order of its row, and writes only to itself: no atomics, no reverse communication, and the
/// same bits in every run.
#pragma once

#include "step/row_contacts.hpp"

namespace gpudem {

template <class P, class Law, StepMode mode, WallUse walls>
struct WarpContacts : RowContacts<P, Law, mode> {
  using Base = RowContacts<P, Law, mode>;
  using typename Base::Real;
  using Base::loads, Base::s, Base::W;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = Law::moments ? (P::fine ? 4 : 6) : (P::fine ? 5 : 8);
  static constexpr std::uint32_t capacity = 256;  ///< contacts in the queue

  /// What the lanes of a warp share.
  struct Shared {
    Real sum[loads][W];           ///< over the contacts of each grain
    std::uint32_t old[W], now[W]; ///< entries in contact before and after, of the word at hand
    std::uint16_t queue[capacity];  ///< contacts to visit: rank * 1024 + lane of the grain * 32 + bit of the entry
  };

  const std::uint32_t *slices;  ///< that the launch is for, 32 grains each; null: all

  /// All lanes of a warp call this together; \p thread counts through the launch.
  GPUDEM_HD void operator()(std::uint32_t thread, bool, Shared &shared) const
  {
    const std::uint32_t lane = warpLane(), slice = slices ? slices[thread / W] : thread / W, i = slice * W + lane;
    const bool inRange = i < s.count;
    const std::uint32_t base = s.rows.start[slice], words = s.rows.words(slice, W);
    const CoarsePosition c = s.in.coarse[inRange ? i : s.count - 1];
    std::uint32_t near = !s.refresh && inRange ? s.rows.near[i] : 0u;
    std::uint32_t old = Law::keeps(s) && inRange ? s.rows.touch[i] : 0u;
    if (s.sequence > s.status->lastAllowed) return;
    if (inRange) prefetchLine(s.motionIn + i);
    const std::uint32_t length = s.refresh && inRange ? s.rows.count[i] : 0u;
    GPUDEM_UNROLL
    for (int d = 0; d < loads; ++d) shared.sum[d][lane] = Real(0);
    for (std::uint32_t w = 0;;) {
      const std::uint32_t word = s.rows.wordOf(i, w, W), first = w * 32;
      const std::uint32_t bits =
          s.refresh ? this->measure(base + lane, length, first, 0, W, c, near) : this->pick(base + lane, first, near, c);
      if (s.refresh && inRange) s.rows.near[word] = near;
      if (warpAny((bits | old) != 0)) {
        const std::uint32_t now = visit(base, i - lane, first, bits, old, shared);
        if (Law::keeps(s) && inRange && now != old) s.rows.touch[word] = now;
      }
      if (++w >= words) break;
      const std::uint32_t next = s.rows.wordOf(i, w, W);
      near = !s.refresh && inRange ? s.rows.near[next] : 0u;
      old = Law::keeps(s) && inRange ? s.rows.touch[next] : 0u;
    }
    this->takeEarlier(slice, i, shared.sum);
    float moved2 = 0.0f;
    if (inRange) {
      Motion<Real> m = s.motionIn[i];
      FixedPosition p = loadPosition(s.in, i, m.word);
      const auto sum = [&](int d) { return d < loads ? shared.sum[d][lane] : Real(0); };
      Real virial[6] = {};
      if (mode == StepMode::Event)
        for (int d = 0; d < 6; ++d) virial[d] = sum(6 + d);
      completeGrain<mode, walls, typename Law::WallProduct>(s, i, p, m, Vec3<Real>{sum(0), sum(1), sum(2)}, Vec3<Real>{sum(3), sum(4), sum(5)},
                                 virial);
      if (mode == StepMode::Fused) moved2 = strayed2(s, coarsePart(p), c);
    }
    if (mode == StepMode::Fused) this->watchStep(moved2);
  }

 private:
  /// Evaluate the contacts of all lanes' \p bits and add them to the sums of their grains.
  /// \param warpFirst grain of lane 0
  /// \param old       entries of the lane's grain that were in contact
  /// \return those that are in contact now
  GPUDEM_HD std::uint32_t visit(std::uint32_t base, std::uint32_t warpFirst, std::uint32_t first, std::uint32_t bits,
                                 std::uint32_t old, Shared &shared) const
  {
    const std::uint32_t lane = warpLane(), below = (1u << lane) - 1u;
    shared.old[lane] = old;
    shared.now[lane] = bits;
    for (;;) {
      // the first contact of every grain, then the second of those that have one, ...: neighbouring lanes then read
      // neighbouring entries, and a grain adds its contacts in the order of its row
      std::uint32_t total = 0, rank = 0;
      for (;; ++rank) {
        const std::uint32_t owners = warpBallot(bits != 0);
        if (owners == 0 || total + static_cast<std::uint32_t>(bitCount(owners)) > capacity) break;
        if (bits) shared.queue[total + static_cast<std::uint32_t>(bitCount(owners & below))] =
            static_cast<std::uint16_t>(rank << 10 | lane << 5 | static_cast<std::uint32_t>(lowestBit(bits)));
        bits &= bits - 1;
        total += static_cast<std::uint32_t>(bitCount(owners));
      }
      warpSync();
      if (total == 0) return shared.now[lane];
      for (std::uint32_t start = 0; start < total; start += W) work(base, warpFirst, first, start, total, shared);
    }
  }

  /// One contact of the queue for every lane.
  GPUDEM_HD void work(std::uint32_t base, std::uint32_t warpFirst, std::uint32_t first, std::uint32_t start,
                       std::uint32_t total, Shared &shared) const
  {
    const std::uint32_t at = start + warpLane();
    const std::uint32_t contact = shared.queue[at < total ? at : total - 1];
    const std::uint32_t owner = contact >> 5 & 31u, k = contact & 31u, rank = contact >> 10;
    Real load[loads];
    bool touches = false;
    if (at < total) {
      const bool held = shared.old[owner] >> k & 1u;
      touches = this->evaluate(warpFirst + owner, base + (first + k) * W + owner, held, load);
      if (!touches) clearShared(&shared.now[owner], 1u << k);
    }
    const std::uint32_t lastRank = warpShuffle(rank, W - 1);
    for (std::uint32_t r = warpShuffle(rank, 0); r <= lastRank; ++r) {
      if (touches && r == rank) {
        GPUDEM_UNROLL
        for (int d = 0; d < loads; ++d) shared.sum[d][owner] += load[d];
      }
      warpSync();
    }
  }
};

}  // namespace gpudem
