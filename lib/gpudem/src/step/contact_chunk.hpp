// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The step on the CPU: the same functions as contact_step.hpp, arranged so that each pair of a chunk is
/// evaluated once and the contact law runs in SIMD lanes.
///
/// The pairs of a chunk pass in batches through four loops without branches that depend on the data: which may
/// touch, what the law needs of them, the law, and the sums of both grains. A pair adds the same force with
/// opposite signs to its two grains, in an order given by the list alone.
#pragma once

#include "neighbor/pair_chunk.hpp"
#include "step/contact_step.hpp"
#include "step/motion_chunk.hpp"

namespace gpudem {

template <class P, NormalModel normal, TangentialModel tangential, StepMode mode, bool walls>
struct ContactChunk {
  using Real = typename P::Real;
  static constexpr bool history = tangential == TangentialModel::Spring;
  static constexpr std::uint32_t capacity = 128;  ///< pairs in a batch
  static constexpr int stride = capacity + 16;    ///< arrays must not all start in the same set of the L1 cache
  static constexpr std::uint32_t ahead = 24;      ///< pairs between asking for memory and using it

  StepView<P> s;
  PairChunk<Real> *chunks;

  void operator()(std::uint32_t c) const
  {
    if (s.sequence > s.status->lastAllowed) return;
    const std::uint32_t begin = c * grainsPerChunk;
    const std::uint32_t grains = s.count - begin < grainsPerChunk ? s.count - begin : grainsPerChunk;
    PairChunk<Real> &pairs = chunks[c];
    const auto size = static_cast<std::uint32_t>(pairs.size());
    Sums sums(grains);
    Batch batch;
    for (std::uint32_t first = 0; first < size; first += capacity) {
      const std::uint32_t last = size - first < capacity ? size : first + capacity;
      gather(begin, first, last, pairs, batch);
      if (mode == StepMode::Fused || s.advanceSprings) evaluate<true>(batch, s.law, s.dt);
      else evaluate<false>(batch, s.law, s.dt);
      scatter(pairs, batch, sums);
    }
    if (mode == StepMode::Fused && movesInLanes(s)) {
      MotionChunk<P, walls> motion;
      constexpr std::uint32_t some = MotionChunk<P, walls>::capacity;
      for (std::uint32_t g = 0; g < grains; g += some)
        motion(s, begin + g, grains - g < some ? grains - g : some, sums.load + g);
      return;
    }
    for (std::uint32_t g = 0; g < grains; ++g) {
      const std::uint32_t i = begin + g;
      Motion<Real> m = s.motionIn[i];
      FixedPosition p = loadPosition(s.in, i, m.word);
      const Real *a = sums.load[g];
      completeGrain<mode, walls>(s, i, p, m, Vec3<Real>{a[0], a[1], a[2]}, Vec3<Real>{a[3], a[4], a[5]},
                                 sums.virialOf(g));
    }
  }

 private:
  /// Sums of each grain of the chunk; one more takes what belongs to grains of other chunks.
  struct Sums {
    Real load[grainsPerChunk + 1][8];                                  ///< force, torque, padding
    Real virial[mode == StepMode::Event ? grainsPerChunk + 1 : 1][6];  ///< a fused step keeps none
    explicit Sums(std::uint32_t grains)
    {
      memset(load, 0, grains * sizeof load[0]);
      memset(load[grainsPerChunk], 0, sizeof load[0]);
      memset(virial, 0, sizeof virial);
    }
    Real *virialOf(std::uint32_t g) { return virial[mode == StepMode::Event ? g : 0]; }
  };

  /// Pairs in contact, one array per quantity.
  struct Batch {
    int size = 0;
    std::uint32_t pair[stride];
    Real radius[stride], radius2[stride];
    Real bx[stride], by[stride], bz[stride], room2[stride], reach[stride];
    Real product[stride], sum[stride], vx[stride], vy[stride], vz[stride];
    Real wx[stride], wy[stride], wz[stride], sx[stride], sy[stride], sz[stride];
    Real fx[stride], fy[stride], fz[stride], cx[stride], cy[stride], cz[stride];

    /// Whole vectors: what lies behind the last pair is whatever the memory holds, and nobody reads the result.
    int padded() const { return (size + 15) / 16 * 16; }
  };

  /// The pairs first .. last - 1 that touch. Those that touched when the list was built are not tested first.
  void gather(std::uint32_t begin, std::uint32_t first, std::uint32_t last, PairChunk<Real> &pairs, Batch &b) const
  {
    const std::uint32_t *partner = pairs.partner.data();
    const std::uint16_t *owner = pairs.owner.data();
    std::uint8_t *touching = pairs.touching.data();
    std::uint32_t candidate[capacity];
    std::uint32_t candidates = 0, k = first;
    for (; k < last && k < pairs.front; ++k) {
      prefetch(pairs, k + ahead);
      candidate[candidates++] = k;
    }
    const CoarsePosition *coarse = s.in.coarse;
    const Vec3<float> unit = s.coarseUnit;
    const float slack = s.reachSlack;
    for (; k < last; ++k) {
      prefetch(pairs, k + ahead);
      const bool near = mayTouch(coarse[begin + owner[k]], coarse[partner[k]], unit, slack);
      candidate[candidates] = k;
      candidates += near ? 1u : 0u;
      if (history) touching[k] &= near ? 1u : 0u;
    }
    b.size = 0;
    for (std::uint32_t n = 0; n < candidates; ++n) {
      const std::uint32_t k = candidate[n], i = begin + owner[k], j = partner[k];
      GatheredPair<Real> g;
      const bool touches = gatherPair(s, loadSelf(s, i), j, g);
      put(b, k, g, pairs);
      if (history) touching[k] = touches ? 1 : 0;
      b.size += touches ? 1 : 0;
    }
  }

  /// Ask for what pair k will need, if there is such a pair.
  void prefetch(const PairChunk<Real> &pairs, std::uint32_t k) const
  {
    if (k >= pairs.size()) return;
    const std::uint32_t j = pairs.partner[k];
    __builtin_prefetch(s.in.coarse + j);
    if (k >= pairs.front) return;
    if (P::fine) __builtin_prefetch(s.in.fine + j);
    __builtin_prefetch(s.motionIn + j);
    if (history) __builtin_prefetch(&pairs.spring[3 * static_cast<std::size_t>(k)]);
  }

  static void put(Batch &b, std::uint32_t k, const GatheredPair<Real> &g, const PairChunk<Real> &pairs)
  {
    const int n = b.size;
    b.pair[n] = k;
    b.radius[n] = g.radius;
    b.radius2[n] = g.radius2;
    b.bx[n] = g.branch.x;
    b.by[n] = g.branch.y;
    b.bz[n] = g.branch.z;
    b.room2[n] = g.room2;
    b.reach[n] = g.reach;
    b.product[n] = g.massProduct;
    b.sum[n] = g.massSum;
    b.vx[n] = g.relativeVelocity.x;
    b.vy[n] = g.relativeVelocity.y;
    b.vz[n] = g.relativeVelocity.z;
    b.wx[n] = g.surfaceSpin.x;
    b.wy[n] = g.surfaceSpin.y;
    b.wz[n] = g.surfaceSpin.z;
    if (history) {
      const bool known = pairs.touching[k] != 0;
      const Real *slot = &pairs.spring[3 * static_cast<std::size_t>(k)];
      const Real x = slot[0], y = slot[1], z = slot[2];
      b.sx[n] = known ? x : Real(0);
      b.sy[n] = known ? y : Real(0);
      b.sz[n] = known ? z : Real(0);
    }
  }

  void scatter(PairChunk<Real> &pairs, const Batch &b, Sums &sums) const
  {
    for (int n = 0; n < b.size; ++n) {
      const std::uint32_t k = b.pair[n], g = pairs.owner[k], h = pairs.mirror[k];
      const Real load[6] = {b.fx[n], b.fy[n], b.fz[n], b.cx[n], b.cy[n], b.cz[n]};
      Real *mine = sums.load[g], *other = sums.load[h];
      for (int d = 0; d < 3; ++d) {
        mine[d] += load[d];
        mine[3 + d] -= load[3 + d] * b.radius[n];
      }
      for (int d = 0; d < 3; ++d) {
        other[d] -= load[d];
        other[3 + d] -= load[3 + d] * b.radius2[n];
      }
      if (history) {
        Real *slot = &pairs.spring[3 * static_cast<std::size_t>(k)];
        slot[0] = b.sx[n];
        slot[1] = b.sy[n];
        slot[2] = b.sz[n];
      }
      if (mode == StepMode::Event && s.virial) {
        const Vec3<Real> branch{b.bx[n], b.by[n], b.bz[n]}, force{load[0], load[1], load[2]};
        addVirial(branch, force, sums.virialOf(g));
        addVirial(branch, force, sums.virialOf(h));
      }
    }
  }

  template <bool advance>
  static void evaluate(Batch &b, const LawCoefficients<Real> law, const Real dt)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      const GatheredPair<Real> g{{b.bx[n], b.by[n], b.bz[n]},
                                 b.room2[n],
                                 b.reach[n],
                                 b.product[n],
                                 b.sum[n],
                                 b.radius[n],
                                 b.radius2[n],
                                 {b.vx[n], b.vy[n], b.vz[n]},
                                 {b.wx[n], b.wy[n], b.wz[n]}};
      Vec3<Real> spring{history ? b.sx[n] : Real(0), history ? b.sy[n] : Real(0), history ? b.sz[n] : Real(0)};
      const ContactForce<Real> f = springDashpot<normal, tangential>(law, toContact<normal>(g), spring, dt, advance);
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
