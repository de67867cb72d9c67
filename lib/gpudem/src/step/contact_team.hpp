// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The step on the GPU for scenes that leave most of the chip idle: several warps take 32 grains together.
///
/// A small scene waits for the longest chain of instructions, not for the sum of all: the warps share the near entries
/// and then the contacts of their grains, and only the motion is left to the first of them. Every sum is taken in the
/// order of contact_warp.hpp, so the bits are the same.
#pragma once

#include "step/row_contacts.hpp"

namespace gpudem {

template <class P, class Law, WallUse walls, int warps>
struct TeamContacts : RowContacts<P, Law, StepMode::Fused> {
  using Base = RowContacts<P, Law, StepMode::Fused>;
  using typename Base::Real;
  using Base::loads, Base::s, Base::W;
  static constexpr std::uint32_t T = warps, lanes = T * W;
  static constexpr int teamWarps = warps;
  static constexpr int blockSize = static_cast<int>(lanes);
  static constexpr int minimumBlocks = (Law::moments ? (P::fine ? 16 : 24) : (P::fine ? 20 : 32)) / warps;

  /// What the warps of a team share.
  struct Shared {
    Real load[loads][lanes];              ///< of the contacts at hand
    Real sum[loads][W];                   ///< over the contacts of each grain
    std::uint32_t near[T][W], bits[T][W];  ///< what each warp found
    std::uint32_t old[W], now[W];         ///< entries in contact before and after, of the word at hand
    std::uint32_t owners[W], start[W];    ///< of each rank: grains that have such a contact, and its place in the queue
    std::uint32_t total;                  ///< contacts in the queue
    std::uint16_t queue[W * W];           ///< contacts to visit: lane of the grain * 32 + bit of the entry
  };

  const std::uint32_t *slices;  ///< that the launch is for, 32 grains each; null: all

  /// All lanes of a team call this together.
  GPUDEM_HD void operator()(std::uint32_t unit, Shared &shared) const
  {
    const std::uint32_t lane = warpLane(), warp = teamWarp(), slice = slices ? slices[unit] : unit, i = slice * W + lane;
    const bool inRange = i < s.count;
    const std::uint32_t base = s.rows.start[slice], words = s.rows.words(slice, W);
    const CoarsePosition c = s.in.coarse[inRange ? i : s.count - 1];
    std::uint32_t near = !s.refresh && inRange ? s.rows.near[i] : 0u;
    std::uint32_t old = Law::keeps(s) && inRange ? s.rows.touch[i] : 0u;
    if (s.sequence > s.status->lastAllowed) return;
    if (inRange && warp == 0) prefetchLine(s.motionIn + i);
    const std::uint32_t length = s.refresh && inRange ? s.rows.count[i] : 0u;
    for (std::uint32_t d = warp; d < loads; d += T) shared.sum[d][lane] = Real(0);
    for (std::uint32_t w = 0;;) {
      const std::uint32_t word = s.rows.wordOf(i, w, W);
      const std::uint32_t bits = find(base + lane, length, w * W, c, near, shared);
      if (s.refresh && inRange && warp == 0) s.rows.near[word] = near;
      if (warpAny((bits | old) != 0)) {  // in all warps alike
        const std::uint32_t now = visit(base, i - lane, w * W, bits, old, shared);
        if (Law::keeps(s) && inRange && warp == 0 && now != old) s.rows.touch[word] = now;
      }
      if (++w >= words) break;
      const std::uint32_t next = s.rows.wordOf(i, w, W);
      near = !s.refresh && inRange ? s.rows.near[next] : 0u;
      old = Law::keeps(s) && inRange ? s.rows.touch[next] : 0u;
      teamSync();
    }
    if (warp != 0) return;
    this->takeEarlier(slice, i, shared.sum);
    float moved2 = 0.0f;
    if (inRange) {
      Motion<Real> m = s.motionIn[i];
      FixedPosition p = loadPosition(s.in, i, m.word);
      const auto sum = [&](int d) { return d < loads ? shared.sum[d][lane] : Real(0); };
      const Real virial[6] = {};
      completeGrain<StepMode::Fused, walls, typename Law::WallProduct>(s, i, p, m, Vec3<Real>{sum(0), sum(1), sum(2)},
                                            Vec3<Real>{sum(3), sum(4), sum(5)}, virial);
      moved2 = strayed2(s, coarsePart(p), c);
    }
    this->watchStep(moved2);
  }

 private:
  /// Entries of the word that may touch; each warp looks at its share. \p near are those within the inner reach.
  GPUDEM_HD std::uint32_t find(std::uint32_t row, std::uint32_t length, std::uint32_t first, const CoarsePosition &c,
                                std::uint32_t &near, Shared &shared) const
  {
    constexpr std::uint32_t share = W / T, everyTth = 0xffffffffu / ((1u << T) - 1u);
    const std::uint32_t lane = warpLane(), warp = teamWarp();
    if (s.refresh) {
      std::uint32_t mine = 0;
      shared.bits[warp][lane] = this->measure(row, length, first, warp * share, (warp + 1) * share, c, mine);
      shared.near[warp][lane] = mine;
    } else {
      shared.bits[warp][lane] = this->template pick<2>(row, first, near & everyTth << warp, c);
    }
    teamSync();
    std::uint32_t bits = 0;
    GPUDEM_UNROLL
    for (std::uint32_t t = 0; t < T; ++t) {
      bits |= shared.bits[t][lane];
      if (s.refresh) near |= shared.near[t][lane];
    }
    return bits;
  }

  /// As in contact_warp.hpp, with as many contacts at a time as the team has lanes.
  GPUDEM_HD std::uint32_t visit(std::uint32_t base, std::uint32_t sliceFirst, std::uint32_t first, std::uint32_t bits,
                                 std::uint32_t old, Shared &shared) const
  {
    const std::uint32_t lane = warpLane(), warp = teamWarp(), below = (1u << lane) - 1u;
    if (warp == 0) fillQueue(bits, old, shared);
    teamSync();
    std::uint32_t left = bits, rank = 0;  // contacts of the lane's grain that are not summed yet, and the first of them
    for (std::uint32_t start = 0; start < shared.total; start += lanes) {
      const std::uint32_t here = warp * W + lane, at = start + here;
      if (at < shared.total) {
        const std::uint32_t contact = shared.queue[at], owner = contact >> 5, k = contact & 31u;
        Real load[loads];
        if (this->evaluate(sliceFirst + owner, base + (first + k) * W + owner, shared.old[owner] >> k & 1u, load)) {
          GPUDEM_UNROLL
          for (int d = 0; d < loads; ++d) shared.load[d][here] = load[d];
        } else {
          clearShared(&shared.now[owner], 1u << k);
        }
      }
      teamSync();
      const std::uint32_t now = shared.now[lane];
      for (; left; left &= left - 1, ++rank) {
        const std::uint32_t place = shared.start[rank] + static_cast<std::uint32_t>(bitCount(shared.owners[rank] & below));
        if (place >= start + lanes) break;
        if (!(now >> lowestBit(left) & 1u)) continue;
        for (std::uint32_t d = warp; d < loads; d += T) shared.sum[d][lane] += shared.load[d][place - start];
      }
      teamSync();
    }
    return shared.now[lane];
  }

  /// The first contact of every grain, then the second of those that have one, ... The first warp calls this.
  GPUDEM_HD void fillQueue(std::uint32_t bits, std::uint32_t old, Shared &shared) const
  {
    const std::uint32_t lane = warpLane(), below = (1u << lane) - 1u;
    shared.old[lane] = old;
    shared.now[lane] = bits;
    std::uint32_t total = 0;
    for (std::uint32_t rank = 0;; ++rank) {
      const std::uint32_t owners = warpBallot(bits != 0);
      if (owners == 0) break;
      if (bits) shared.queue[total + static_cast<std::uint32_t>(bitCount(owners & below))] =
          static_cast<std::uint16_t>(lane << 5 | static_cast<std::uint32_t>(lowestBit(bits)));
      bits &= bits - 1;
      if (lane == 0) {
        shared.owners[rank] = owners;
        shared.start[rank] = total;
      }
      total += static_cast<std::uint32_t>(bitCount(owners));
    }
    if (lane == 0) shared.total = total;
  }
};

}  // namespace gpudem
