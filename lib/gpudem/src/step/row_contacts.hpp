// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the kernels of the GPU's step do with one row: find the entries that may touch, and evaluate one contact.
#pragma once

#include "base/warp.hpp"
#include "step/contact_step.hpp"

namespace gpudem {

template <class P, class Law, StepMode mode>
struct RowContacts {
  using Real = typename P::Real;
  static constexpr std::uint32_t W = warpWidth, allLanes = 0xffffffffu;
  static constexpr int loads = mode == StepMode::Event ? 12 : Law::torques ? 6 : 3;  ///< force, torque, virial

  StepView<P> s;

 protected:
  /// Add what was computed by launches that may still be at work: long rows to the sums of their grains. Walls of their own
  /// launch are added later, but waited for here. Slices that take part in neither do not wait.
  GPUDEM_HD void takeEarlier(std::uint32_t slice, std::uint32_t i, Real (*sum)[W]) const
  {
    const std::uint32_t first = s.rows.longFirst ? s.rows.longFirst[slice] : 0u;
    const std::uint32_t last = s.rows.longFirst ? s.rows.longFirst[slice + 1] : 0u;
    const bool wall = s.wallsApart && warpAny(i < s.count && (s.anchor[i] & nearRegionBit));
    if (wall || first != last) waitForEarlier();
    if (first != last) addLongRows(first, last, i, sum);
  }

  /// A lane adds the segments of its own grain; where there are many, all lanes help.
  GPUDEM_HD void addLongRows(std::uint32_t first, std::uint32_t last, std::uint32_t i, Real (*sum)[W]) const
  {
    const std::uint32_t lane = warpLane();
    std::uint32_t from = 0, to = 0;
    for (std::uint32_t r = first; r < last; ++r) {
      const LongRow row = s.rows.longRow[r];
      const std::uint32_t segments = row.segments();
      const bool mine = row.grain == i;
      if (segments <= W) {
        from = mine ? row.segment : from;
        to = mine ? row.segment + segments : to;
        continue;
      }
      Real all[loads] = {};
      addSegments(row.segment + lane, row.segment + segments, W, all);
      for (int d = 0; d < loads; ++d) {
        const Real total = warpSum(all[d]);
        if (mine) sum[d][lane] += total;
      }
    }
    Real own[loads] = {};
    addSegments(from, to, 1, own);
    for (int d = 0; d < loads; ++d) sum[d][lane] += own[d];
  }

  GPUDEM_HD void addSegments(std::uint32_t from, std::uint32_t to, std::uint32_t step, Real *sum) const
  {
    for (std::uint32_t k = from; k < to; k += step) {
      GPUDEM_UNROLL
      for (int d = 0; d < loads; ++d) sum[d] += s.rows.segmentLoad[static_cast<std::size_t>(k) * loads + d];
    }
  }

  /// Does the inner list stay right, and how long are the steps?
  GPUDEM_HD void watchStep(float moved2) const
  {
    if (moved2 > s.innerStepLimit2) raiseStale(s, moved2);
    if (!s.refresh) return;
    const std::uint32_t longest = warpMax(bitsOf(moved2 > 1.0e-30f ? moved2 : 1.0e-30f));
    if (warpLane() == 0 && longest > readFresh(&s.status->longestStep2)) atomicRaise(&s.status->longestStep2, longest);
  }

  /// Entries first + from .. first + to - 1 of a row, 0 <= from < to <= 32.
  /// \return bits of grains that may touch; \p near those within the inner reach
  GPUDEM_HD std::uint32_t measure(std::uint32_t row, std::uint32_t length, std::uint32_t first, std::uint32_t from,
                                   std::uint32_t to, const CoarsePosition &c, std::uint32_t &near) const
  {
    std::uint32_t bits = 0;
    near = 0;
    if (first + from >= length) return 0;
    const std::uint32_t last = length - first < to ? length - first : to;
    constexpr std::uint32_t batch = 4;
    for (std::uint32_t k = from; k < last; k += batch) {  // the gathers of a batch are in flight together
      CoarsePosition o[batch];
      GPUDEM_UNROLL
      for (std::uint32_t b = 0; b < batch; ++b)
        o[b] = s.in.coarse[s.rows.neighbor[row + (first + (k + b < last ? k + b : k)) * W]];
      GPUDEM_UNROLL
      for (std::uint32_t b = 0; b < batch; ++b) {
        const float apart2 = distance2(c, o[b], s.coarseUnit);
        const float reach = (c.radius + o[b].radius) * 1.000001f + s.reachSlack, inner = reach + s.innerSkin;
        bits |= (apart2 < reach * reach ? 1u : 0u) << (k + b);
        near |= (apart2 < inner * inner ? 1u : 0u) << (k + b);
      }
    }
    const std::uint32_t inRow = allLanes >> (32u - last);
    near &= inRow;
    return bits & inRow;
  }

  /// Ask for what a contact will need.
  GPUDEM_HD void prefetch(std::uint32_t entry, std::uint32_t j) const
  {
    prefetchLine(s.motionIn + j);
    if (P::fine) prefetchLine(s.in.fine + j);
    if (Law::numbers > 0) prefetchLine(s.rows.spring + static_cast<std::size_t>(Law::historySize(s)) * entry);
  }

  /// Those of the entries \p near that may touch. \tparam batch how many are in flight together
  template <int batch = 4>
  GPUDEM_HD std::uint32_t pick(std::uint32_t row, std::uint32_t first, std::uint32_t near,
                                const CoarsePosition &c) const
  {
    std::uint32_t bits = 0;
    while (near) {
      int k[batch], last = 0;
      std::uint32_t j[batch];
      CoarsePosition o[batch];
      GPUDEM_UNROLL
      for (int b = 0; b < batch; ++b) {
        k[b] = last = near ? lowestBit(near) : last;
        near &= near - 1;
        j[b] = s.rows.neighbor[row + (first + static_cast<std::uint32_t>(k[b])) * W];
      }
      GPUDEM_UNROLL
      for (int b = 0; b < batch; ++b) o[b] = s.in.coarse[j[b]];
      GPUDEM_UNROLL
      for (int b = 0; b < batch; ++b) {
        if (!mayTouch(c, o[b], s.coarseUnit, s.reachSlack)) continue;
        bits |= 1u << k[b];
        prefetch(row + (first + static_cast<std::uint32_t>(k[b])) * W, j[b]);
      }
    }
    return bits;
  }

  /// Contact of grain \p i with the grain of \p entry. \return do they touch?
  GPUDEM_HD bool evaluate(std::uint32_t i, std::uint32_t entry, bool held, Real *load) const
  {
    const bool keeps = Law::keeps(s);
    const Self<P> self = loadSelf(s, i);
    const std::uint32_t j = s.rows.neighbor[entry];
    const std::uint32_t kind = Law::kind(s, i, j);
    GatheredPair<Real> g;
    if (!gatherPair<Law>(s, self, j, kind, keeps && held, g)) return false;
    typename Law::template History<Real> kept{};
    Real *slot = nullptr;
    if (keeps) {
      slot = s.rows.spring + static_cast<std::size_t>(Law::historySize(s)) * entry;
      if (held) kept = Law::load(s, slot);
    }
    const ContactForce<Real> f = Law::evaluate(Law::coefficients(s, kind), toContact<Law>(g), kept, s.dt,
                                               mode == StepMode::Fused || s.advanceSprings);
    if (keeps) Law::store(s, kept, slot);
    load[0] = f.force.x;
    load[1] = f.force.y;
    load[2] = f.force.z;
    if (Law::torques) {
      Vec3<Real> torque = f.couple * (Law::moments ? f.shorter - g.radius : -g.radius);
      if (Law::moments) torque += f.moment;
      load[3] = torque.x;
      load[4] = torque.y;
      load[5] = torque.z;
    }
    if (mode == StepMode::Event) {
      for (int d = Law::torques ? 6 : 3; d < loads; ++d) load[d] = Real(0);
      if (s.virial) addVirial(g.branch, f.force, load + 6);
    }
    return true;
  }
};

}  // namespace gpudem
