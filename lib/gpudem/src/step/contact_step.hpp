// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The step: all forces on one grain, then its motion. The heart of the program.
///
/// Two phases over the row. The first only measures distances, coarsely and conservatively, with the
/// gathers of several neighbours in flight, and leaves a bit per neighbour that may touch. The second
/// visits the set bits, decides exactly and evaluates the contact law. Each grain sums over its full
/// row in a fixed order and writes only to itself: no atomics, no reverse communication, and the same
/// bits in every run.
#pragma once

#include "step/force_terms.hpp"
#include "step/integrate.hpp"
#include "step/pair_contact.hpp"

namespace gpudem {

/// What follows the contact forces of grain \p i: force terms, then its motion or the record of the event.
template <StepMode mode, WallUse walls, class P>
GPUDEM_HD void completeGrain(const StepView<P> &s, std::uint32_t i, FixedPosition &p, Motion<typename P::Real> &m,
                             Vec3<typename P::Real> force, Vec3<typename P::Real> torque,
                             const typename P::Real *virial)
{
  using Real = typename P::Real;
  const std::uint32_t anchor = s.anchor[i];
  applyForceTerms<walls>(s, i, p, anchor, m, force, torque);
  if (mode == StepMode::Fused) {
    kickGrain(s, i, p.radius, force, torque, Real(2), m);
    const bool moved = driftGrain(s, i, p, m);
    const CoarsePosition now = storePosition(s.out, i, p, m.word);
    s.motionOut[i] = m;
    if (moved) raiseAlarm(s, i, alarmOf(s, anchor, now, m));
  } else {
    s.force[i] = force;
    s.torque[i] = torque;
    if (s.virial)
      for (int k = 0; k < 6; ++k) s.virial[static_cast<std::size_t>(k) * s.count + i] = virial[k];
    if (s.finish) kickGrain(s, i, p.radius, force, torque, Real(1), m);
    s.motionOut[i] = m;
    const Real sum = force.x + force.y + force.z + torque.x + torque.y + torque.z;
    if (!(sum - sum == Real(0))) atomicLower(&s.status->badParticle, i);
  }
}

/// Bits of entries first .. first + 31 of a row whose grains may touch.
template <int W, class P>
GPUDEM_HD std::uint32_t touchCandidates(const StepView<P> &s, std::uint32_t base, std::uint32_t length,
                                        std::uint32_t first, const CoarsePosition &c)
{
  const std::uint32_t last = length - first < 32u ? length - first : 32u;
  const auto test = [&](std::uint32_t k) {
    const CoarsePosition o = s.in.coarse[s.rows.neighbor[base + (first + k) * W]];
    return mayTouch(c, o, s.coarseUnit, s.reachSlack) ? 1u : 0u;
  };
  std::uint32_t bits = 0;
  constexpr std::uint32_t batch = 4;
  std::uint32_t k = 0;
  for (; k + batch <= last; k += batch) {
    std::uint32_t near[batch];
    GPUDEM_UNROLL
    for (std::uint32_t b = 0; b < batch; ++b) near[b] = test(k + b);
    GPUDEM_UNROLL
    for (std::uint32_t b = 0; b < batch; ++b) bits |= near[b] << (k + b);
  }
  for (; k < last; ++k) bits |= test(k) << k;
  return bits;
}

template <class P, class Law, StepMode mode, WallUse walls, int W>
struct ContactStep {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = Law::moments ? (P::fine ? 3 : 5) : (P::fine ? 4 : 8);

  StepView<P> s;

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (s.sequence > s.status->lastAllowed) return;
    const Self<P> self = loadSelf(s, i);
    Vec3<Real> force{Real(0), Real(0), Real(0)}, torque{Real(0), Real(0), Real(0)};
    Real virial[6] = {Real(0), Real(0), Real(0), Real(0), Real(0), Real(0)};

    const std::uint32_t slice = i / W, lane = i % W;
    const std::uint32_t base = s.rows.start[slice] + lane;
    const std::uint32_t length = s.rows.count[i];
    const CoarsePosition c = s.in.coarse[i];
    for (std::uint32_t first = 0; first < length; first += 32) {
      const std::uint32_t bits = touchCandidates<W>(s, base, length, first, c);
      visit(base, slice, lane, first, bits, self, force, torque, virial);
    }
    Motion<Real> m = self.motion;
    FixedPosition p = loadPosition(s.in, i, m.word);
    completeGrain<mode, walls>(s, i, p, m, force, torque, virial);
  }

 private:
  /// The contacts among entries first .. first+31 whose bit is set.
  GPUDEM_HD void visit(std::uint32_t base, std::uint32_t slice, std::uint32_t lane, std::uint32_t first,
                       std::uint32_t bits, const Self<P> &self, Vec3<Real> &force, Vec3<Real> &torque,
                       Real *virial) const
  {
    const bool keeps = Law::keeps(s);
    std::uint32_t old = 0, now = 0;
    std::uint32_t *word = nullptr;
    if (keeps) {
      word = s.rows.touch + s.rows.maskStart[slice] + (first / 32u) * W + lane;
      old = *word;
    }
    while (bits) {
      const int k = lowestBit(bits);
      bits &= bits - 1;
      const std::uint32_t entry = base + (first + static_cast<std::uint32_t>(k)) * W;
      const std::uint32_t j = s.rows.neighbor[entry];
      const std::uint32_t kind = Law::kind(s, self.index, j);
      const bool held = keeps && (old >> k & 1u);
      GatheredPair<Real> g;
      if (!gatherPair<Law>(s, self, j, kind, held, g)) continue;
      typename Law::template History<Real> kept{};
      Real *slot = nullptr;
      if (keeps) {
        slot = s.rows.spring + static_cast<std::size_t>(Law::historySize(s)) * entry;
        if (held) kept = Law::load(s, slot);
        now |= 1u << k;
      }
      const ContactForce<Real> f = Law::evaluate(Law::coefficients(s, kind), toContact<Law>(g), kept, s.dt,
                                                 mode == StepMode::Fused || s.advanceSprings);
      if (keeps) Law::store(s, kept, slot);
      force += f.force;
      torque -= f.couple * (Law::moments ? g.radius - f.shorter : g.radius);
      if (Law::moments) torque += f.moment;
      if (mode == StepMode::Event && s.virial) addVirial(g.branch, f.force, virial);
    }
    if (keeps && now != old) *word = now;
  }
};

/// Elementwise begin of a step from stored forces.
template <class P>
struct BeginStep {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  StepView<P> s;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    using Real = typename P::Real;
    Motion<Real> m = s.motionIn[i];
    FixedPosition p = loadPosition(s.in, i, m.word);
    kickGrain(s, i, p.radius, s.force[i], s.torque[i], Real(1), m);
    const bool moved = driftGrain(s, i, p, m);
    const CoarsePosition now = storePosition(s.out, i, p, m.word);
    s.motionOut[i] = m;
    if (moved) raiseAlarm(s, i, alarmOf(s, s.anchor[i], now, m));
  }
};

/// Elementwise second half kick from stored forces.
template <class P>
struct FinishStep {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  StepView<P> s;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    using Real = typename P::Real;
    Motion<Real> m = s.motionIn[i];
    kickGrain(s, i, loadPosition(s.in, i, m.word).radius, s.force[i], s.torque[i], Real(1), m);
    s.motionOut[i] = m;
  }
};

}  // namespace gpudem
