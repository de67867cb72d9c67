// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What follows the contact forces of a grain, and the motion of a step that events split in halves.
#pragma once

#include "step/force_terms.hpp"
#include "step/integrate.hpp"
#include "step/pair_contact.hpp"

namespace gpudem {

/// What follows the contact forces of grain \p i: force terms, then its motion or the record of the event.
template <StepMode mode, WallUse walls, class WallProduct = AnyProduct, class P>
GPUDEM_HD void completeGrain(const StepView<P> &s, std::uint32_t i, FixedPosition &p, Motion<typename P::Real> &m,
                             Vec3<typename P::Real> force, Vec3<typename P::Real> torque,
                             const typename P::Real *virial)
{
  using Real = typename P::Real;
  const std::uint32_t anchor = s.anchor[i];
  applyForceTerms<walls, WallProduct>(s, i, p, anchor, m, force, torque);
  if (mode == StepMode::Fused) {
    kickGrain(s, i, p.radius, force, torque, Real(2), m);
    const bool moved = driftGrain(s, i, p, m);
    const CoarsePosition now = storePosition(s.out, i, p, m.word);
    s.motionOut[i] = m;
    raiseAlarm(s, i, alarmOf(s, anchor, now, m, moved));
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
    const CoarsePosition before = coarsePart(p);
    kickGrain(s, i, p.radius, s.force[i], s.torque[i], Real(1), m);
    const bool moved = driftGrain(s, i, p, m);
    const CoarsePosition now = storePosition(s.out, i, p, m.word);
    s.motionOut[i] = m;
    raiseAlarm(s, i, alarmOf(s, s.anchor[i], now, m, moved));
    const float moved2 = strayed2(s, now, before);
    if (moved2 > s.innerStepLimit2) raiseStale(s, moved2);
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
