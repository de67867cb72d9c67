// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The step on the CPU: the same functions as contact_step.hpp, arranged so that the contact law runs in
/// SIMD lanes.
///
/// A chunk of grains gathers its contacts into arrays, the law is evaluated for all of them in one vector loop,
/// and the results are added to the grains in the order of their rows. The arithmetic per contact and the order
/// of the sums are those of the scalar form, so neither the chunk nor the number of threads shows in the result.
#pragma once

#include "step/contact_step.hpp"

namespace gpudem {

template <class P, NormalModel normal, TangentialModel tangential, StepMode mode, bool walls>
struct ContactChunk {
  using Real = typename P::Real;
  static constexpr bool history = tangential == TangentialModel::Spring;
  static constexpr std::uint32_t chunk = 64;   ///< grains
  static constexpr int capacity = 256;         ///< contacts evaluated at once
  static constexpr int stride = capacity + 16; ///< arrays must not all start in the same set of the L1 cache
  static constexpr std::uint32_t ahead = 12;   ///< rows between asking for memory and using it

  StepView<P> s;

  void operator()(std::uint32_t c) const
  {
    if (s.sequence > s.status->lastAllowed) return;
    const std::uint32_t begin = c * chunk, end = s.count - begin < chunk ? s.count : begin + chunk;
    Sums sums;
    Batch batch;
    for (std::uint32_t i = begin; i < end; ++i) gatherRow(i, i - begin, batch, sums);
    flush(batch, sums);
    for (std::uint32_t i = begin; i < end; ++i) {
      FixedPosition<P> p = loadPosition<P>(s.in, i);
      Motion<Real> m = s.motionIn[i];
      const std::uint32_t g = i - begin;
      completeGrain<mode, walls>(s, i, p, m, sums.force[g], sums.torque[g], sums.virialOf(g));
    }
  }

 private:
  struct Sums {
    Vec3<Real> force[chunk] = {}, torque[chunk] = {};
    Real virial[mode == StepMode::Event ? chunk : 1][6] = {};   ///< a fused step keeps none
    Real *virialOf(std::uint32_t g) { return virial[mode == StepMode::Event ? g : 0]; }
  };

  /// Contacts waiting for the law, one array per quantity.
  struct Batch {
    int size = 0;
    std::uint32_t grain[stride], entry[stride];
    Real radius[stride];
    Real bx[stride], by[stride], bz[stride], room2[stride], reach[stride], radii[stride];
    Real product[stride], sum[stride], vx[stride], vy[stride], vz[stride];
    Real wx[stride], wy[stride], wz[stride], sx[stride], sy[stride], sz[stride];
    Real fx[stride], fy[stride], fz[stride], cx[stride], cy[stride], cz[stride];
  };

  /// Ask for what row i will gather: neighbours are met before their turn in the sorted order comes.
  void prefetchRow(std::uint32_t i) const
  {
    if (i >= s.count) return;
    const std::uint32_t base = s.rows.start[i], length = s.rows.count[i];
    if (length == 0) return;   // an empty row has no touch word
    const std::uint32_t touching =
        history ? static_cast<std::uint32_t>(bitCount(s.rows.touch[s.rows.maskStart[i]])) : length;
    if (history) __builtin_prefetch(s.rows.spring + 3 * static_cast<std::size_t>(base));
    for (std::uint32_t k = 0; k < length; ++k) {
      const std::uint32_t j = s.rows.neighbor[base + k];
      __builtin_prefetch(s.in.coarse + j);
      if (k < touching) __builtin_prefetch(s.motionIn + j);
    }
  }

  void gatherRow(std::uint32_t i, std::uint32_t grain, Batch &b, Sums &sums) const
  {
    prefetchRow(i + ahead);
    const FixedPosition<P> p = loadPosition<P>(s.in, i);
    const Motion<Real> m = s.motionIn[i];
    const CoarsePosition c = s.in.coarse[i];
    const std::uint32_t base = s.rows.start[i], length = s.rows.count[i];
    const float ux = static_cast<float>(s.frame.unit32.x), uy = static_cast<float>(s.frame.unit32.y),
                uz = static_cast<float>(s.frame.unit32.z);
    for (std::uint32_t first = 0; first < length; first += 32) {
      std::uint32_t bits = touchCandidates<1>(s, base, length, first, c, ux, uy, uz), now = 0;
      std::uint32_t *word = history ? s.rows.touch + s.rows.maskStart[i] + first / 32u : nullptr;
      const std::uint32_t old = history ? *word : 0;
      for (; bits; bits &= bits - 1) {
        const int k = lowestBit(bits);
        const std::uint32_t entry = base + first + static_cast<std::uint32_t>(k);
        GatheredPair<Real> g;
        if (!gatherPair(s, s.rows.neighbor[entry], p, m, g)) continue;
        now |= 1u << k;
        put(b, grain, entry, static_cast<Real>(p.radius), g, history && (old >> k & 1u));
        if (b.size == capacity) flush(b, sums);
      }
      if (history && now != old) *word = now;
    }
  }

  void put(Batch &b, std::uint32_t grain, std::uint32_t entry, Real radius, const GatheredPair<Real> &g,
           bool known) const
  {
    const int n = b.size++;
    b.grain[n] = grain;
    b.entry[n] = entry;
    b.radius[n] = radius;
    b.bx[n] = g.branch.x;
    b.by[n] = g.branch.y;
    b.bz[n] = g.branch.z;
    b.room2[n] = g.room2;
    b.reach[n] = g.reach;
    b.radii[n] = g.radiusProduct;
    b.product[n] = g.massProduct;
    b.sum[n] = g.massSum;
    b.vx[n] = g.relativeVelocity.x;
    b.vy[n] = g.relativeVelocity.y;
    b.vz[n] = g.relativeVelocity.z;
    b.wx[n] = g.surfaceSpin.x;
    b.wy[n] = g.surfaceSpin.y;
    b.wz[n] = g.surfaceSpin.z;
    if (history) {
      const Real *slot = s.rows.spring + 3 * static_cast<std::size_t>(entry);
      b.sx[n] = known ? slot[0] : Real(0);
      b.sy[n] = known ? slot[1] : Real(0);
      b.sz[n] = known ? slot[2] : Real(0);
    }
  }

  void flush(Batch &b, Sums &sums) const
  {
    const LawCoefficients<Real> law = s.law;
    const Real dt = s.dt;
    const bool advance = mode == StepMode::Fused || s.advanceSprings;
    if (advance) evaluate<true>(b, law, dt);
    else evaluate<false>(b, law, dt);
    for (int n = 0; n < b.size; ++n) {
      const std::uint32_t g = b.grain[n];
      const Vec3<Real> force{b.fx[n], b.fy[n], b.fz[n]};
      sums.force[g] += force;
      sums.torque[g] -= Vec3<Real>{b.cx[n], b.cy[n], b.cz[n]} * b.radius[n];
      if (history) {
        Real *slot = s.rows.spring + 3 * static_cast<std::size_t>(b.entry[n]);
        slot[0] = b.sx[n];
        slot[1] = b.sy[n];
        slot[2] = b.sz[n];
      }
      if (mode == StepMode::Event && s.virial)
        addVirial(Vec3<Real>{b.bx[n], b.by[n], b.bz[n]}, force, sums.virialOf(g));
    }
    b.size = 0;
  }

  template <bool advance>
  static void evaluate(Batch &b, const LawCoefficients<Real> law, const Real dt)
  {
    const int size = b.size;
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      const GatheredPair<Real> g{{b.bx[n], b.by[n], b.bz[n]}, b.room2[n], b.reach[n], b.radii[n],
                                 b.product[n], b.sum[n], {b.vx[n], b.vy[n], b.vz[n]},
                                 {b.wx[n], b.wy[n], b.wz[n]}};
      Vec3<Real> spring{history ? b.sx[n] : Real(0), history ? b.sy[n] : Real(0), history ? b.sz[n] : Real(0)};
      const ContactForce<Real> f =
          springDashpot<normal, tangential>(law, toContact<normal>(g), spring, dt, advance);
      b.fx[n] = f.force.x;
      b.fy[n] = f.force.y;
      b.fz[n] = f.force.z;
      b.cx[n] = f.couple.x;
      b.cy[n] = f.couple.y;
      b.cz[n] = f.couple.z;
      if (history) {
        b.sx[n] = spring.x;
        b.sy[n] = spring.y;
        b.sz[n] = spring.z;
      }
    }
  }
};

}  // namespace gpudem
