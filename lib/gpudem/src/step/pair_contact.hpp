// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From two grains to the contact that the law takes, in two halves: what must be gathered, and what can be
/// computed for many contacts at once.
#pragma once

#include "step/step_view.hpp"

namespace gpudem {

/// Differences and products of two touching grains; no root and no quotient yet.
template <class Real>
struct GatheredPair {
  Vec3<Real> branch;             ///< from the partner to the grain (distance)
  Real room2;                    ///< (R_i + R_j)^2 - distance^2, exact before rounding (distance^2)
  Real reach;                    ///< R_i + R_j (distance)
  Real massProduct, massSum;     ///< their quotient is the effective mass
  Real radius, radius2;          ///< R_i, R_j (distance)
  Vec3<Real> relativeVelocity;   ///< v_i - v_j
  Vec3<Real> surfaceSpin;        ///< R_i omega_i + R_j omega_j
};

/// Could the grains touch? Coarse, and wrong to the safe side only.
GPUDEM_HD bool mayTouch(const CoarsePosition &c, const CoarsePosition &o, float ux, float uy, float uz,
                        float reachSlack)
{
  const float dx = static_cast<float>(static_cast<std::int32_t>(c.x - o.x)) * ux;
  const float dy = static_cast<float>(static_cast<std::int32_t>(c.y - o.y)) * uy;
  const float dz = static_cast<float>(static_cast<std::int32_t>(c.z - o.z)) * uz;
  const float reach = (c.radius + o.radius) * 1.000001f + reachSlack;
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

/// \return false if the grains do not touch, or overlap by less than the coordinates resolve (grains placed exactly
/// side by side, as on a lattice); the same from both sides
template <class P>
GPUDEM_HD bool gatherPair(const StepView<P> &s, const FixedPosition &p, const Motion<typename P::Real> &m,
                          std::uint32_t j, GatheredPair<typename P::Real> &g)
{
  using Real = typename P::Real;
  const Motion<Real> o = s.motionIn[j];
  const FixedPosition q = loadPosition(s.in, j, o.word);
  const Vec3<double> branch = separation(p, q, s.frame);
  const double reach = p.radius + q.radius;
  const double room2 = reach * reach - dot(branch, branch);
  const bool touches = room2 > reach * s.touchMargin;
#ifdef __CUDA_ARCH__
  if (!touches) return false;   // on the CPU a branch costs more than what it saves
#endif
  const Real ri = static_cast<Real>(p.radius), rj = static_cast<Real>(q.radius);
  g.branch = branch.template as<Real>();
  g.room2 = static_cast<Real>(room2);
  g.reach = static_cast<Real>(reach);
  g.radius = ri;
  g.radius2 = rj;
  g.massProduct = m.mass * o.mass;
  g.massSum = m.mass + o.mass;
  if ((m.word | o.word) & s.frozenRole) {   // a frozen grain counts as infinitely heavy
    g.massProduct = o.word & s.frozenRole ? m.mass : o.mass;
    g.massSum = Real(1);
  }
  g.relativeVelocity = {m.vx - o.vx, m.vy - o.vy, m.vz - o.vz};
  g.surfaceSpin = {symmetricSum(ri, m.wx, rj, o.wx), symmetricSum(ri, m.wy, rj, o.wy),
                   symmetricSum(ri, m.wz, rj, o.wz)};
  return touches;
}

template <NormalModel normal, class Real>
GPUDEM_HD Contact<Real> toContact(const GatheredPair<Real> &g)
{
  Contact<Real> c;
  const Real distance2 = dot(g.branch, g.branch);
  c.branch = g.branch;
  c.inverseDistance = inverseSquareRoot(distance2);
  c.distance = distance2 * c.inverseDistance;
  c.overlap = divide(g.room2, g.reach + c.distance);
  c.effectiveRadius = normal == NormalModel::Hertz ? divide(g.radius * g.radius2, g.reach) : Real(0);
  c.effectiveMass = divide(g.massProduct, g.massSum);
  c.relativeVelocity = g.relativeVelocity;
  c.surfaceSpin = g.surfaceSpin;
  return c;
}

/// Half of branch x force, so that both sides of a contact make the whole (xx yy zz xy xz yz).
template <class Real>
GPUDEM_HD void addVirial(const Vec3<Real> &branch, const Vec3<Real> &force, Real *virial)
{
  virial[0] += Real(0.5) * branch.x * force.x;
  virial[1] += Real(0.5) * branch.y * force.y;
  virial[2] += Real(0.5) * branch.z * force.z;
  virial[3] += Real(0.5) * branch.x * force.y;
  virial[4] += Real(0.5) * branch.x * force.z;
  virial[5] += Real(0.5) * branch.y * force.z;
}

enum class StepMode {
  Fused,  ///< force, full kick, drift: x_n, v_(n-1/2) -> x_(n+1), v_(n+1/2)
  Event,  ///< force kept in memory, optional second half kick: v_(n-1/2) -> v_n
};

}  // namespace gpudem
