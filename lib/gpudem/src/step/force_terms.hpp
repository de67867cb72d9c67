// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The ordered per-grain force terms: LAMMPS' post_force fixes, applied in the order of the script.
#pragma once

#include "step/step_view.hpp"
#include "wall/analytic_wall.hpp"

namespace gpudem {

template <class Real>
struct WallLoad {
  Vec3<Real> force, torque;
};

/// Force and torque of a wall on grain \p i, which was within its reach when the rows were built.
template <WallUse walls, class Product, class P>
GPUDEM_RARE WallLoad<typename P::Real> wallLoad(const StepView<P> &s, int wall, std::uint32_t i, const FixedPosition &p,
                                                const Motion<typename P::Real> &m)
{
  using Real = typename P::Real;
  const Vec3<double> x = absolutePosition(p, s.cell[i], s.grid, s.frame);
  const ContactForce<Real> c = wallForce<walls, Product>(s.wall[wall], i, s.count, x, p.radius, m, s.dt, s.advanceSprings);
  return {c.force, c.moment - c.couple * (static_cast<Real>(p.radius) - c.shorter)};
}

/// \tparam walls, Product what of the wall code the kernel holds
/// \param anchor its bits say whether the grain was within reach of a wall when the rows were built
template <WallUse walls, class Product = AnyProduct, class P>
GPUDEM_HD void applyForceTerms(const StepView<P> &s, std::uint32_t i, const FixedPosition &p, std::uint32_t anchor,
                               Motion<typename P::Real> &m, Vec3<typename P::Real> &force,
                               Vec3<typename P::Real> &torque)
{
  using Real = typename P::Real;
  for (int k = 0; k < s.terms; ++k) {
    const TermView<Real> &term = s.term[k];
    if (!(m.word & term.role)) {
      if (term.before) term.before[i] = {Real(0), Real(0), Real(0)};
      continue;
    }
    if (term.before) term.before[i] = force;
    switch (term.kind) {
      case ForceTermKind::Gravity:
        force += term.value * m.mass;
        break;
      case ForceTermKind::Viscous:
        force -= Vec3<Real>{m.vx, m.vy, m.vz} * term.dragPerType[s.type[i]];
        break;
      case ForceTermKind::SetForce:
        if (term.prescribed & 1) force.x = term.value.x;
        if (term.prescribed & 2) force.y = term.value.y;
        if (term.prescribed & 4) force.z = term.value.z;
        break;
      case ForceTermKind::Freeze:
        force = {Real(0), Real(0), Real(0)};
        torque = {Real(0), Real(0), Real(0)};
        break;
      case ForceTermKind::Enforce2d:
        force.z = Real(0);
        torque.x = torque.y = Real(0);
        m.vz = m.wx = m.wy = Real(0);
        break;
      case ForceTermKind::Wall:
        if (walls != WallUse::None && (anchor & nearWallBit)) {
          const FixedPosition at = p;  // copies, or the originals would have to live in memory
          const Motion<Real> motion = m;
          const WallLoad<Real> load = wallLoad<walls, Product>(s, term.wall, i, at, motion);
          force += load.force;
          torque += load.torque;
        }
        break;
      case ForceTermKind::RegionWall:
        if (anchor & nearRegionBit) {
          force += term.load[i];
          torque += term.load[s.count + i];
        }
        break;
    }
  }
}

}  // namespace gpudem
