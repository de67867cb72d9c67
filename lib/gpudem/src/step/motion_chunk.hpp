// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The motion of consecutive grains on the CPU: kick, drift and alarm of integrate.hpp in SIMD lanes, for
/// scenes whose only integrator is nve/sphere.
#pragma once

#include "step/force_terms.hpp"
#include "step/integrate.hpp"

namespace gpudem {

/// One nve/sphere, and no term that alters velocities.
template <class P>
bool movesInLanes(const StepView<P> &s)
{
  bool plain = s.integrators == 1 && s.integrator[0].kind == IntegratorKind::NveSphere;
  for (int k = 0; k < s.terms; ++k) plain = plain && s.term[k].kind != ForceTermKind::Enforce2d;
  return plain;
}

template <class P, WallUse walls>
class MotionChunk {
 public:
  using Real = typename P::Real;
  static constexpr std::uint32_t capacity = 64;  ///< grains

  /// Fused step of grains begin .. begin + count - 1, count <= capacity.
  /// \param load [count][8] contact force and torque
  void operator()(const StepView<P> &s, std::uint32_t begin, std::uint32_t count, const Real (*load)[8])
  {
    for (std::uint32_t g = 0; g < count; ++g) read(s, begin + g, g, load[g]);
    move(s, begin, count);
    for (std::uint32_t g = 0; g < count; ++g) write(s, begin + g, g);
  }

 private:
  void read(const StepView<P> &s, std::uint32_t i, std::uint32_t g, const Real *load)
  {
    Motion<Real> m = s.motionIn[i];
    const FixedPosition p = loadPosition(s.in, i, m.word);
    const std::uint32_t anchor = s.anchor[i];
    Vec3<Real> force{load[0], load[1], load[2]}, torque{load[3], load[4], load[5]};
    applyForceTerms<walls>(s, i, p, anchor, m, force, torque);
    x_[g] = p.x;
    y_[g] = p.y;
    z_[g] = p.z;
    radius_[g] = p.radius;
    vx_[g] = m.vx;
    vy_[g] = m.vy;
    vz_[g] = m.vz;
    mass_[g] = m.mass;
    wx_[g] = m.wx;
    wy_[g] = m.wy;
    wz_[g] = m.wz;
    word_[g] = m.word;
    fx_[g] = force.x;
    fy_[g] = force.y;
    fz_[g] = force.z;
    tx_[g] = torque.x;
    ty_[g] = torque.y;
    tz_[g] = torque.z;
    anchor_[g] = anchor;
  }

  Motion<Real> motionAt(std::uint32_t g) const
  {
    Motion<Real> m{};
    m.vx = vx_[g];
    m.vy = vy_[g];
    m.vz = vz_[g];
    m.mass = mass_[g];
    m.wx = wx_[g];
    m.wy = wy_[g];
    m.wz = wz_[g];
    m.word = word_[g];
    return m;
  }
  FixedPosition positionAt(std::uint32_t g) const { return {x_[g], y_[g], z_[g], radius_[g]}; }

  void move(const StepView<P> &s, std::uint32_t begin, std::uint32_t count)
  {
    const IntegratorView it = s.integrator[0];
    std::uint32_t alarms = 0;
#pragma GCC ivdep
    for (std::uint32_t g = 0; g < count; ++g) {
      Motion<Real> m = motionAt(g);
      FixedPosition p = positionAt(g);
      RoundingBits random(begin + g, s.step);
      kickSphere(s, it, p.radius, Vec3<Real>{fx_[g], fy_[g], fz_[g]}, Vec3<Real>{tx_[g], ty_[g], tz_[g]}, Real(2),
                 random, m);
      driftSphere(s, p, m);
      const bool active = (word_[g] & it.role) != 0;
      x_[g] = active ? p.x : x_[g];
      y_[g] = active ? p.y : y_[g];
      z_[g] = active ? p.z : z_[g];
      vx_[g] = active ? m.vx : vx_[g];
      vy_[g] = active ? m.vy : vy_[g];
      vz_[g] = active ? m.vz : vz_[g];
      wx_[g] = active ? m.wx : wx_[g];
      wy_[g] = active ? m.wy : wy_[g];
      wz_[g] = active ? m.wz : wz_[g];
      const std::uint32_t alarm = alarmOf(s, anchor_[g], coarsePart(positionAt(g)), motionAt(g), active);
      alarm_[g] = alarm;
      alarms |= alarm;
    }
    if (!alarms) return;
    for (std::uint32_t g = 0; g < count; ++g) raiseAlarm(s, begin + g, alarm_[g]);
  }

  void write(const StepView<P> &s, std::uint32_t i, std::uint32_t g) const
  {
    Motion<Real> m = motionAt(g);
    storePosition(s.out, i, positionAt(g), m.word);
    s.motionOut[i] = m;
  }

  static constexpr std::uint32_t stride = capacity + 8;  ///< arrays must not all start in the same set of the L1 cache
  std::uint64_t x_[stride], y_[stride], z_[stride];
  double radius_[stride];
  Real vx_[stride], vy_[stride], vz_[stride], mass_[stride], wx_[stride], wy_[stride], wz_[stride];
  Real fx_[stride], fy_[stride], fz_[stride], tx_[stride], ty_[stride], tz_[stride];
  std::uint32_t word_[stride], anchor_[stride], alarm_[stride];
};

}  // namespace gpudem
