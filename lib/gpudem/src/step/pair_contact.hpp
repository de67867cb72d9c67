// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From two grains to the contact that the law takes, in two halves: what must be gathered, and what can be
/// computed for many contacts at once.
#pragma once

#include "step/step_law.hpp"

namespace gpudem {

/// Differences and products of two touching grains; no root and no quotient yet.
template <class Real>
struct GatheredPair {
  Vec3<Real> branch;            ///< from the partner to the grain (distance)
  Real room2;                   ///< (R_i + R_j)^2 - distance^2, exact before rounding (distance^2)
  Real reach;                   ///< R_i + R_j (distance)
  Real massProduct, massSum;    ///< their quotient is the effective mass
  Real radius, radius2;         ///< R_i, R_j (distance)
  Vec3<Real> relativeVelocity;  ///< v_i - v_j
  Vec3<Real> surfaceSpin;       ///< R_i omega_i + R_j omega_j
  Vec3<Real> spinDifference;    ///< omega_i - omega_j, filled for laws that take it
  Real inertia;                 ///< I_i I_j/(I_i + I_j), I = m R^2, filled for laws that take it
};

/// What a grain knows of itself while it visits its neighbours.
template <class P>
struct Self;
template <>
struct Self<Mixed> {
  CoarsePosition coarse;
  Motion<float> motion;
  std::uint32_t index;
};
template <>
struct Self<Double> {
  FixedPosition position;
  Motion<double> motion;
  std::uint32_t index;
};
GPUDEM_HD Self<Mixed> loadSelf(const StepView<Mixed> &s, std::uint32_t i)
{
  return {s.in.coarse[i], s.motionIn[i], i};
}
GPUDEM_HD Self<Double> loadSelf(const StepView<Double> &s, std::uint32_t i)
{
  return {loadPosition(s.in, i), s.motionIn[i], i};
}

/// Where two grains are to each other.
template <class Real>
struct Gap {
  Vec3<Real> branch;     ///< from the partner to the grain (distance)
  double room2;          ///< (R_i + R_j)^2 - distance^2 (distance^2)
  Real reach;            ///< R_i + R_j (distance)
  Real radius, radius2;  ///< R_i, R_j (distance)
};

/// Mixed: the coarse bits suffice for the direction. The square of the distance takes all bits, the lower ones as a
/// correction of first order: with d the coarse difference and e the lower one, (d + e)^2 - d^2 = 2 d e to 2^-64.
GPUDEM_HD Gap<float> gapTo(const StepView<Mixed> &s, const Self<Mixed> &self, std::uint32_t j, std::uint32_t word)
{
  const CoarsePosition &c = self.coarse;
  const CoarsePosition o = s.in.coarse[j];
  const std::int32_t dx = static_cast<std::int32_t>(c.x - o.x), dy = static_cast<std::int32_t>(c.y - o.y),
                     dz = static_cast<std::int32_t>(c.z - o.z);
  const Vec3<double> coarse{toDouble(dx) * s.frame.unit32.x, toDouble(dy) * s.frame.unit32.y,
                            toDouble(dz) * s.frame.unit32.z};
  const double reach = static_cast<double>(c.radius) + static_cast<double>(o.radius);
  Gap<float> g;
  g.branch = {static_cast<float>(dx) * s.coarseUnit.x, static_cast<float>(dy) * s.coarseUnit.y,
              static_cast<float>(dz) * s.coarseUnit.z};
  const std::uint32_t mine = self.motion.word;
  const Vec3<float> lower{biasedByte(mine, 1) - biasedByte(word, 1), biasedByte(mine, 2) - biasedByte(word, 2),
                          biasedByte(mine, 3) - biasedByte(word, 3)};
  const float correction = g.branch.x * s.twiceFineUnit.x * lower.x + g.branch.y * s.twiceFineUnit.y * lower.y +
                           g.branch.z * s.twiceFineUnit.z * lower.z;
  g.room2 = reach * reach - dot(coarse, coarse) - static_cast<double>(correction);
  g.reach = c.radius + o.radius;
  g.radius = c.radius;
  g.radius2 = o.radius;
  return g;
}
GPUDEM_HD Gap<double> gapTo(const StepView<Double> &s, const Self<Double> &self, std::uint32_t j, std::uint32_t)
{
  const FixedPosition &p = self.position;
  const FixedPosition q = loadPosition(s.in, j);
  Gap<double> g;
  g.branch = separation(p, q, s.frame);
  g.reach = p.radius + q.radius;
  g.room2 = g.reach * g.reach - dot(g.branch, g.branch);
  g.radius = p.radius;
  g.radius2 = q.radius;
  return g;
}

/// I_i I_j/(I_i + I_j) with I = m R^2; a frozen grain counts as infinitely heavy.
template <class Real>
GPUDEM_HD Real pairInertia(const Motion<Real> &m, const Motion<Real> &o, Real ri, Real rj, std::uint32_t frozen)
{
  const Real mine = m.mass * ri * ri, other = o.mass * rj * rj;
  if (o.word & frozen) return mine;
  if (m.word & frozen) return other;
  return divide(mine * other, symmetricSum(m.mass * ri, ri, o.mass * rj, rj));
}

/// \param kind of the pair's coefficients, and \param held whether the pair was in contact: read by laws whose contacts
/// outlive touch
/// \return false if the grains do not touch, or overlap by less than the coordinates resolve (grains placed exactly
/// side by side, as on a lattice); the same from both sides
template <class Law, class P>
GPUDEM_HD bool gatherPair(const StepView<P> &s, const Self<P> &self, std::uint32_t j, std::uint32_t kind, bool held,
                          GatheredPair<typename P::Real> &g)
{
  using Real = typename P::Real;
  const Motion<Real> &m = self.motion;
  const Gap<Real> gap = gapTo(s, self, j, P::fine ? 0u : s.motionIn[j].word);
  bool touches = gap.room2 > static_cast<double>(gap.reach) * s.touchMargin;
  if (Law::beyondTouch && !touches && (held || Law::beforeTouch(s, kind))) {
    const Real apart = Law::gap(Law::coefficients(s, kind), gap.radius, gap.radius2);
    touches = gap.room2 > -static_cast<double>(apart * (Real(2) * gap.reach + apart));
  }
#ifdef __CUDA_ARCH__
  if (!touches) return false;  // on the CPU a branch costs more than what it saves
#endif
  const Motion<Real> o = s.motionIn[j];
  const Real ri = gap.radius, rj = gap.radius2;
  g.branch = gap.branch;
  g.room2 = static_cast<Real>(gap.room2);
  g.reach = gap.reach;
  g.radius = ri;
  g.radius2 = rj;
  g.massProduct = m.mass * o.mass;
  g.massSum = m.mass + o.mass;
  if ((m.word | o.word) & s.frozenRole) {  // a frozen grain counts as infinitely heavy
    g.massProduct = o.word & s.frozenRole ? m.mass : o.mass;
    g.massSum = Real(1);
  }
  g.relativeVelocity = {m.vx - o.vx, m.vy - o.vy, m.vz - o.vz};
  g.surfaceSpin = {symmetricSum(ri, m.wx, rj, o.wx), symmetricSum(ri, m.wy, rj, o.wy),
                   symmetricSum(ri, m.wz, rj, o.wz)};
  if (Law::takesSpinDifference) g.spinDifference = {m.wx - o.wx, m.wy - o.wy, m.wz - o.wz};
  g.inertia = Law::takesInertia(s) ? pairInertia(m, o, ri, rj, s.frozenRole) : Real(0);
  return touches;
}

template <class Law, class Real>
GPUDEM_HD Contact<Real> toContact(const GatheredPair<Real> &g)
{
  Contact<Real> c;
  const Real distance2 = dot(g.branch, g.branch);
  c.branch = g.branch;
  c.inverseDistance = inverseSquareRoot(distance2);
  c.distance = distance2 * c.inverseDistance;
  c.overlap = divide(g.room2, g.reach + c.distance);
  c.effectiveRadius = Law::takesRadius ? divide(g.radius * g.radius2, g.reach) : Real(0);
  c.effectiveMass = divide(g.massProduct, g.massSum);
  c.relativeVelocity = g.relativeVelocity;
  c.surfaceSpin = g.surfaceSpin;
  c.spinDifference = g.spinDifference;
  c.radiusDifference = g.radius2 - g.radius;
  c.inertia = g.inertia;
  c.atWall = false;
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
