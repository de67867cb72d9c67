// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Velocity Verlet of LAMMPS as kicks and drifts of one grain.
///
/// v_n = v_(n-1/2) + dt/2 f_n/m, v_(n+1/2) = v_n + dt/2 f_n/m, x_(n+1) = x_n + dt v_(n+1/2) (Swope et al., J. Chem.
/// Phys. 76 (1982) 637); spins alike with the moment of inertia. Between events the two half kicks are one.
/// Prescribed motion (fix move) replaces them.
#pragma once

#include "base/rounding.hpp"
#include "step/step_view.hpp"

namespace gpudem {

/// \param perUnit stored units per distance: 2^64 per window in double precision, 2^40 in mixed
template <class P>
GPUDEM_HD std::uint64_t advance(std::uint64_t x, typename P::Real distance, typename P::Real perUnit)
{
  return x + (static_cast<std::uint64_t>(roundToInt(distance * perUnit)) << (P::fine ? 0 : 24));
}

/// Kick of fix nve/sphere: velocity and spin by \p halves half kicks.
template <class P>
GPUDEM_HD void kickSphere(const StepView<P> &s, const IntegratorView &it, double radius,
                          const Vec3<typename P::Real> &force, const Vec3<typename P::Real> &torque,
                          typename P::Real halves, RoundingBits &random, Motion<typename P::Real> &m)
{
  using Real = typename P::Real;
  const Real perMass = divide(halves * static_cast<Real>(s.halfKick), m.mass);
  m.vx = addUnbiased(m.vx, perMass * force.x, random);
  m.vy = addUnbiased(m.vy, perMass * force.y, random);
  m.vz = addUnbiased(m.vz, perMass * force.z, random);
  const Real r = static_cast<Real>(radius);
  const Real perInertia = divide(halves * static_cast<Real>(it.halfKickPerInertia), r * r * m.mass);
  m.wx = addUnbiased(m.wx, perInertia * torque.x, random);
  m.wy = addUnbiased(m.wy, perInertia * torque.y, random);
  m.wz = addUnbiased(m.wz, perInertia * torque.z, random);
}

/// Drift of fix nve/sphere.
template <class P>
GPUDEM_HD void driftSphere(const StepView<P> &s, FixedPosition &p, const Motion<typename P::Real> &m)
{
  p.x = advance<P>(p.x, s.dt * m.vx, s.perUnit.x);
  p.y = advance<P>(p.y, s.dt * m.vy, s.perUnit.y);
  p.z = advance<P>(p.z, s.dt * m.vz, s.perUnit.z);
}

/// Velocities and spins advance by \p halves half kicks: one at an event, two in a fused step.
template <class P>
GPUDEM_HD void kickGrain(const StepView<P> &s, std::uint32_t i, double radius, const Vec3<typename P::Real> &force,
                         const Vec3<typename P::Real> &torque, typename P::Real halves, Motion<typename P::Real> &m)
{
  using Real = typename P::Real;
  RoundingBits random(i, s.step);
  for (int k = 0; k < s.integrators; ++k) {
    const IntegratorView &it = s.integrator[k];
    if (!(m.word & it.role) || it.kind == IntegratorKind::Rotate) continue;
    if (it.kind == IntegratorKind::NveSphere) {
      kickSphere(s, it, radius, force, torque, halves, random, m);
      continue;
    }
    const Real perMass = divide(halves * static_cast<Real>(s.halfKick), m.mass);
    if (!(it.prescribed & 1)) m.vx = addUnbiased(m.vx, perMass * force.x, random);
    if (!(it.prescribed & 2)) m.vy = addUnbiased(m.vy, perMass * force.y, random);
    if (!(it.prescribed & 4)) m.vz = addUnbiased(m.vz, perMass * force.z, random);
  }
}

/// Rotation of the original position about an axis (fix move rotate).
GPUDEM_HD void rotateGrain(const IntegratorView &it, const Vec3<double> &origin, Vec3<double> &x, Vec3<double> &v)
{
  const Vec3<double> d = origin - it.point;
  const Vec3<double> along = it.axis * dot(d, it.axis);
  const Vec3<double> a = d - along;
  const Vec3<double> b = cross(it.axis, a);
  const Vec3<double> arm = a * it.cosine + b * it.sine;
  x = it.point + along + arm;
  v = cross(it.axis, arm) * it.angularFrequency;
}

/// Positions advance by a step; prescribed motion sets positions and velocities.
/// \return whether any integrator moved the grain
template <class P>
GPUDEM_HD bool driftGrain(const StepView<P> &s, std::uint32_t i, FixedPosition &p, Motion<typename P::Real> &m)
{
  using Real = typename P::Real;
  const Frame &f = s.frame;
  bool moved = false;
  for (int k = 0; k < s.integrators; ++k) {
    const IntegratorView &it = s.integrator[k];
    if (!(m.word & it.role)) continue;
    moved = true;
    if (it.kind == IntegratorKind::NveSphere) {
      driftSphere(s, p, m);
      continue;
    }
    if (it.kind == IntegratorKind::Rotate) {
      Vec3<double> x, v;
      rotateGrain(it, s.origin[i], x, v);
      setCoordinates(p, x, f);
      m.vx = static_cast<Real>(v.x);
      m.vy = static_cast<Real>(v.y);
      m.vz = static_cast<Real>(v.z);
      m.wx = static_cast<Real>(it.angularFrequency * it.axis.x);
      m.wy = static_cast<Real>(it.angularFrequency * it.axis.y);
      m.wz = static_cast<Real>(it.angularFrequency * it.axis.z);
      continue;
    }
    const Vec3<double> to = s.origin[i] + it.displacement;
    if (it.prescribed & 1) {
      m.vx = static_cast<Real>(it.velocity.x);
      p.x = toFraction(to.x, f.origin.x, f.inverse.x);
    } else {
      p.x = advance<P>(p.x, s.dt * m.vx, s.perUnit.x);
    }
    if (it.prescribed & 2) {
      m.vy = static_cast<Real>(it.velocity.y);
      p.y = toFraction(to.y, f.origin.y, f.inverse.y);
    } else {
      p.y = advance<P>(p.y, s.dt * m.vy, s.perUnit.y);
    }
    if (it.prescribed & 4) {
      m.vz = static_cast<Real>(it.velocity.z);
      p.z = toFraction(to.z, f.origin.z, f.inverse.z);
    } else {
      p.z = advance<P>(p.z, s.dt * m.vz, s.perUnit.z);
    }
  }
  return moved;
}

/// Coordinate minus the middle of the anchor's quantum, in coarse units.
GPUDEM_HD float anchorDistance(std::uint32_t now, std::uint32_t kept, int shift)
{
  const int spare = 22 - shift;
  const std::int32_t wrapped = static_cast<std::int32_t>((now - (kept << shift)) << spare) >> spare;
  return static_cast<float>(wrapped) - 0.5f * static_cast<float>(1u << shift);
}

/// What a grain's displacement asks for.
enum Alarm : std::uint32_t {
  spentAlarm = 1,   ///< too far from where it was when the rows were built, or too far in this step
  brokenAlarm = 2,  ///< not a number, or farther in this step than a cell
};

/// \param moved did an integrator move the grain
/// \return bits of Alarm
template <class P>
GPUDEM_HD std::uint32_t alarmOf(const StepView<P> &s, std::uint32_t anchor, const CoarsePosition &now,
                                const Motion<typename P::Real> &m, bool moved)
{
  using Real = typename P::Real;
  const AnchorRule &rule = s.anchorRule;
  const float ux = static_cast<float>(s.frame.unit32.x), uy = static_cast<float>(s.frame.unit32.y),
              uz = static_cast<float>(s.frame.unit32.z);
  const Real speed2 = m.vx * m.vx + m.vy * m.vy + m.vz * m.vz;
  const float step2 = moved ? static_cast<float>(speed2 * s.dt * s.dt) : 0.0f;
  const Real sum = m.vx + m.vy + m.vz + m.wx + m.wy + m.wz;
  const bool broken = moved & (!(step2 <= rule.lost2) | (sum - sum != Real(0)));

  // the anchor keeps 10 bits: wrap the difference to shift + 10 bits and measure from the quantum's middle
  const float dx = anchorDistance(now.x - s.driftX, anchor & 1023u, rule.shiftX) * ux;
  const float dy = anchorDistance(now.y - s.driftY, (anchor >> 10) & 1023u, rule.shiftY) * uy;
  const float dz = anchorDistance(now.z - s.driftZ, (anchor >> 20) & 1023u, rule.shiftZ) * uz;
  const bool spent = (dx * dx + dy * dy + dz * dz > rule.limit2) | (step2 > rule.stepLimit2);
  return (spent ? spentAlarm : 0u) | (broken ? brokenAlarm : 0u);
}

template <class P>
GPUDEM_HD void raiseAlarm(const StepView<P> &s, std::uint32_t i, std::uint32_t alarm)
{
  if (alarm && s.status->rebuildAfter > s.sequence) {
    atomicLower(&s.status->lastAllowed, s.sequence);
    atomicLower(&s.status->rebuildAfter, s.sequence);
  }
  if (alarm & brokenAlarm) atomicLower(&s.status->badParticle, i);
}

/// Squared displacement of a step against the motion that all grains share (distance^2).
template <class P>
GPUDEM_HD float strayed2(const StepView<P> &s, const CoarsePosition &now, const CoarsePosition &before)
{
  const float dx = static_cast<float>(static_cast<std::int32_t>(now.x - before.x)) * s.coarseUnit.x - s.stepDrift.x;
  const float dy = static_cast<float>(static_cast<std::int32_t>(now.y - before.y)) * s.coarseUnit.y - s.stepDrift.y;
  const float dz = static_cast<float>(static_cast<std::int32_t>(now.z - before.z)) * s.coarseUnit.z - s.stepDrift.z;
  return dx * dx + dy * dy + dz * dz;
}

/// A step was longer than the inner list allows for: later launches must wait until distances are measured anew.
template <class P>
GPUDEM_HD void raiseStale(const StepView<P> &s, float moved2)
{
  atomicLower(&s.status->lastAllowed, s.sequence);
  atomicRaise(&s.status->longestStep2, bitsOf(moved2));
}

}  // namespace gpudem
