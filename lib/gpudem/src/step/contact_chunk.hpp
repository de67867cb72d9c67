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
#include "step/batch_models.hpp"
#include "step/contact_step.hpp"
#include "step/motion_chunk.hpp"

namespace gpudem {

template <class P, class Law, StepMode mode, WallUse walls>
struct ContactChunk {
  using Real = typename P::Real;
  using Batch = ContactBatch<Law, Real>;
  static constexpr std::uint32_t ahead = 24;  ///< pairs between asking for memory and using it

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
    BatchEvaluator<Law, Real> evaluate;
    for (std::uint32_t first = 0; first < size; first += batchCapacity) {
      const std::uint32_t last = size - first < batchCapacity ? size : first + batchCapacity;
      gather(begin, first, last, pairs, batch);
      evaluate(s, batch, mode == StepMode::Fused || s.advanceSprings);
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

  /// The pairs first .. last - 1 that touch. Those that touched when the list was built are not tested first.
  void gather(std::uint32_t begin, std::uint32_t first, std::uint32_t last, PairChunk<Real> &pairs, Batch &b) const
  {
    const bool keeps = Law::keeps(s);
    const std::uint32_t *partner = pairs.partner.data();
    const std::uint16_t *owner = pairs.owner.data();
    std::uint8_t *touching = pairs.touching.data();
    std::uint32_t candidate[batchCapacity];
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
      if (keeps) touching[k] &= near ? 1u : 0u;
    }
    b.size = 0;
    for (std::uint32_t n = 0; n < candidates; ++n) {
      const std::uint32_t k = candidate[n], i = begin + owner[k], j = partner[k];
      const bool held = keeps && touching[k] != 0;
      const std::uint32_t kind = Law::kind(s, i, j);
      GatheredPair<Real> g{};
      const bool touches = gatherPair<Law>(s, loadSelf(s, i), j, kind, held, g);
      b.put(k, kind, g);
      if (Law::takesInertia(s)) b.inertia[b.size] = g.inertia;
      if (keeps) {
        const int size = Law::historySize(s);
        const Real *slot = pairs.spring.data() + static_cast<std::size_t>(size) * k;
        for (int d = 0; d < size; ++d) {
          const Real kept = slot[d];
          b.kept[d][b.size] = held ? kept : Real(0);
        }
        touching[k] = touches ? 1 : 0;
      }
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
    if (Law::keeps(s)) __builtin_prefetch(pairs.spring.data() + static_cast<std::size_t>(Law::historySize(s)) * k);
  }

  void scatter(PairChunk<Real> &pairs, const Batch &b, Sums &sums) const
  {
    const bool keeps = Law::keeps(s);
    for (int n = 0; n < b.size; ++n) {
      const std::uint32_t k = b.pair[n], g = pairs.owner[k], h = pairs.mirror[k];
      const Real load[6] = {b.fx[n], b.fy[n], b.fz[n], b.cx[n], b.cy[n], b.cz[n]};
      Real *mine = sums.load[g], *other = sums.load[h];
      Real arm = b.radius[n], arm2 = b.radius2[n];
      if (Law::moments) {
        arm -= b.shorter[n];
        arm2 -= b.shorter[n];
        const Real moment[3] = {b.mx[n], b.my[n], b.mz[n]};
        for (int d = 0; d < 3; ++d) {
          mine[3 + d] += moment[d];
          other[3 + d] -= moment[d];
        }
      }
      for (int d = 0; d < 3; ++d) {
        mine[d] += load[d];
        mine[3 + d] -= load[3 + d] * arm;
      }
      for (int d = 0; d < 3; ++d) {
        other[d] -= load[d];
        other[3 + d] -= load[3 + d] * arm2;
      }
      if (keeps) {
        const int size = Law::historySize(s);
        Real *slot = pairs.spring.data() + static_cast<std::size_t>(size) * k;
        for (int d = 0; d < size; ++d) slot[d] = b.kept[d][n];
      }
      if (mode == StepMode::Event && s.virial) {
        const Vec3<Real> branch{b.bx[n], b.by[n], b.bz[n]}, force{load[0], load[1], load[2]};
        addVirial(branch, force, sums.virialOf(g));
        addVirial(branch, force, sums.virialOf(h));
      }
    }
  }
};

}  // namespace gpudem
