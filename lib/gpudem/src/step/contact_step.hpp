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

namespace gpudem {

enum class StepMode {
  Fused,  ///< force, full kick, drift: x_n, v_(n-1/2) -> x_(n+1), v_(n+1/2)
  Event,  ///< force kept in memory, optional second half kick: v_(n-1/2) -> v_n
};

template <class P, NormalModel normal, TangentialModel tangential, StepMode mode, bool walls, int W>
struct ContactStep {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = P::fine ? 4 : 8;

  StepView<P> s;

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (s.sequence > s.status->lastAllowed) return;

    FixedPosition<P> p = loadPosition<P>(s.in, i);
    Motion<Real> m = s.motionIn[i];
    Vec3<Real> force{Real(0), Real(0), Real(0)}, torque{Real(0), Real(0), Real(0)};
    Real virial[6] = {Real(0), Real(0), Real(0), Real(0), Real(0), Real(0)};

    sumContacts(i, p, m, force, torque, virial);

    const std::uint32_t anchor = s.anchor[i];
    applyForceTerms<walls>(s, i, p, (anchor & nearWallBit) != 0, m, force, torque);

    if (mode == StepMode::Fused) {
      finishGrain(s, p.radius, force, torque, m);
      const bool moved = beginGrain(s, i, force, torque, p, m);
      const CoarsePosition now = storePosition(s.out, i, p);
      s.motionOut[i] = m;
      if (moved) watchDisplacement(s, i, anchor, now, m);
    } else {
      s.force[i] = force;
      s.torque[i] = torque;
      if (s.virial)
        for (int k = 0; k < 6; ++k) s.virial[static_cast<std::size_t>(k) * s.count + i] = virial[k];
      if (s.finish) finishGrain(s, p.radius, force, torque, m);
      s.motionOut[i] = m;
      const Real sum = force.x + force.y + force.z + torque.x + torque.y + torque.z;
      if (!(sum - sum == Real(0))) atomicLower(&s.status->badParticle, i);
    }
  }

 private:
  GPUDEM_HD void sumContacts(std::uint32_t i, const FixedPosition<P> &p, const Motion<Real> &m,
                             Vec3<Real> &force, Vec3<Real> &torque, Real *virial) const
  {
    const std::uint32_t slice = i / W, lane = i % W;
    const std::uint32_t base = s.rows.start[slice] + lane;
    const std::uint32_t length = s.rows.count[i];
    const CoarsePosition c = s.in.coarse[i];
    const float ux = static_cast<float>(s.frame.unit32.x), uy = static_cast<float>(s.frame.unit32.y),
                uz = static_cast<float>(s.frame.unit32.z);
    for (std::uint32_t first = 0; first < length; first += 32) {
      const std::uint32_t last = length - first < 32u ? length - first : 32u;
      std::uint32_t bits = 0;
      constexpr std::uint32_t batch = 4;
      std::uint32_t k = 0;
      for (; k + batch <= last; k += batch) {
        std::uint32_t near[batch];
        GPUDEM_UNROLL
        for (std::uint32_t b = 0; b < batch; ++b) near[b] = mayTouch(base, first + k + b, c, ux, uy, uz);
        GPUDEM_UNROLL
        for (std::uint32_t b = 0; b < batch; ++b) bits |= near[b] << (k + b);
      }
      for (; k < last; ++k) bits |= mayTouch(base, first + k, c, ux, uy, uz) << k;
      visit(base, slice, lane, first, bits, p, m, force, torque, virial);
    }
  }

  GPUDEM_HD std::uint32_t mayTouch(std::uint32_t base, std::uint32_t k, const CoarsePosition &c, float ux,
                                   float uy, float uz) const
  {
    const CoarsePosition o = s.in.coarse[s.rows.neighbor[base + k * W]];
    const float dx = static_cast<float>(static_cast<std::int32_t>(c.x - o.x)) * ux;
    const float dy = static_cast<float>(static_cast<std::int32_t>(c.y - o.y)) * uy;
    const float dz = static_cast<float>(static_cast<std::int32_t>(c.z - o.z)) * uz;
    const float reach = (c.radius + o.radius) * 1.000001f + s.reachSlack;
    return dx * dx + dy * dy + dz * dz < reach * reach ? 1u : 0u;
  }

  /// The contacts among entries first .. first+31 whose bit is set.
  GPUDEM_HD void visit(std::uint32_t base, std::uint32_t slice, std::uint32_t lane, std::uint32_t first,
                       std::uint32_t bits, const FixedPosition<P> &p, const Motion<Real> &m,
                       Vec3<Real> &force, Vec3<Real> &torque, Real *virial) const
  {
    constexpr bool history = tangential == TangentialModel::Spring;
    std::uint32_t old = 0, now = 0;
    std::uint32_t *word = nullptr;
    if (history) {
      word = s.rows.touch + s.rows.maskStart[slice] + (first / 32u) * W + lane;
      old = *word;
    }
    while (bits) {
      const int k = lowestBit(bits);
      bits &= bits - 1;
      const std::uint32_t entry = base + (first + static_cast<std::uint32_t>(k)) * W;
      const std::uint32_t j = s.rows.neighbor[entry];
      const FixedPosition<P> q = loadPosition<P>(s.in, j);
      const Vec3<double> branch = separation(p, q, s.frame);
      const double reach = p.radius + q.radius;
      const double room2 = reach * reach - dot(branch, branch);
      if (!(room2 > 0.0)) continue;
      const Motion<Real> o = s.motionIn[j];

      Contact<Real> c;
      c.branch = branch.template as<Real>();
      c.distance = squareRoot(dot(c.branch, c.branch));
      c.overlap = static_cast<Real>(room2) / (static_cast<Real>(reach) + c.distance);
      const Real ri = static_cast<Real>(p.radius), rj = static_cast<Real>(q.radius);
      if (normal == NormalModel::Hertz) c.effectiveRadius = ri * rj / (ri + rj);
      c.effectiveMass = m.mass * o.mass / (m.mass + o.mass);
      if (m.mask & s.frozenMask) c.effectiveMass = o.mass;
      if (o.mask & s.frozenMask) c.effectiveMass = m.mass;
      c.relativeVelocity = {m.vx - o.vx, m.vy - o.vy, m.vz - o.vz};
      c.surfaceSpin = {symmetricSum(ri, m.wx, rj, o.wx), symmetricSum(ri, m.wy, rj, o.wy),
                       symmetricSum(ri, m.wz, rj, o.wz)};

      Vec3<Real> spring{Real(0), Real(0), Real(0)};
      Real *slot = nullptr;
      if (history) {
        slot = s.rows.spring + 3 * static_cast<std::size_t>(entry);
        if (old >> k & 1u) spring = {slot[0], slot[1], slot[2]};
        now |= 1u << k;
      }
      const ContactForce<Real> f =
          springDashpot<normal, tangential>(s.law, c, spring, s.dt, s.advanceSprings);
      if (history) {
        slot[0] = spring.x;
        slot[1] = spring.y;
        slot[2] = spring.z;
      }
      force += f.force;
      torque -= f.couple * ri;
      if (mode == StepMode::Event && s.virial) {
        virial[0] += Real(0.5) * c.branch.x * f.force.x;
        virial[1] += Real(0.5) * c.branch.y * f.force.y;
        virial[2] += Real(0.5) * c.branch.z * f.force.z;
        virial[3] += Real(0.5) * c.branch.x * f.force.y;
        virial[4] += Real(0.5) * c.branch.x * f.force.z;
        virial[5] += Real(0.5) * c.branch.y * f.force.z;
      }
    }
    if (history && now != old) *word = now;
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
    FixedPosition<P> p = loadPosition<P>(s.in, i);
    Motion<Real> m = s.motionIn[i];
    const bool moved = beginGrain(s, i, s.force[i], s.torque[i], p, m);
    const CoarsePosition now = storePosition(s.out, i, p);
    s.motionOut[i] = m;
    if (moved) watchDisplacement(s, i, s.anchor[i], now, m);
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
    finishGrain(s, loadPosition<P>(s.in, i).radius, s.force[i], s.torque[i], m);
    s.motionOut[i] = m;
  }
};

}  // namespace gpudem
