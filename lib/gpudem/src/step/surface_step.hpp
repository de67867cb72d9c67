// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A wall of triangles ahead of the contacts of a step, and which grains it may reach.
#pragma once

#include "step/observables.hpp"
#include "step/step_view.hpp"
#include "wall/surface_wall.hpp"

namespace gpudem {

/// One surface at one step: loads of the grains whose nearRegionBit is set.
template <class P>
struct SurfaceStep {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;

  std::uint32_t count, sequence;  ///< as in StepView
  Status *status;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *anchor, *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t flatRole;  ///< as in RegionStep
  Real dt;
  bool advance;
  WallView<Real> wall;
  int mostContacts;
  SurfaceAt at;
  const std::uint32_t *near;  ///< [n][nearTriangles], see listNear()
  Vec3<Real> *load;  ///< [n] forces, [n] torques
  const std::uint32_t *touchAt;  ///< [n] first place of a grain in \c touch
  SurfaceTouch *touch;           ///< mostContacts for every near grain, or null

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (sequence > status->lastAllowed || !(anchor[i] & nearRegionBit)) return;
    Motion<Real> m = motion[i];
    SurfaceLoad<Real> l{};
    const std::uint32_t *list = near + static_cast<std::size_t>(nearTriangles) * i;
    if ((m.word & wall.role) && *list != noNearTriangle) {
      if (m.word & flatRole) m.vz = m.wx = m.wy = Real(0);
      const FixedPosition p = loadPosition(position, i, m.word);
      const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
      const SurfaceSlots<Real> slots{wall.history + static_cast<std::size_t>(wall.historySize) * i, mostContacts,
                                     wall.historySize / mostContacts};
      l = surfaceLoad(wall, at, slots, i, count, x, p.radius, m, dt, advance, list,
                      touch ? touch + touchAt[i] : nullptr);
      if (l.trouble == SurfaceTrouble::Crowded) atomicLower(&status->crowded, i);
      if (l.trouble == SurfaceTrouble::Crossed) atomicLower(&status->crossed, i);
    }
    load[i] = l.force;
    load[count + i] = l.torque;
  }
};

/// How many touches a grain may have.
struct CountRoomForTouches {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *anchor;
  std::uint32_t mostContacts;
  std::uint32_t *room;  ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const { room[i] = anchor[i] & nearRegionBit ? mostContacts : 0u; }
};

/// How many it has. Unused places have no triangle.
struct CountTouches {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *at;
  const SurfaceTouch *touch;
  std::uint32_t *used;  ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    used[i] = 0;
    for (std::uint32_t k = at[i]; k < at[i + 1]; ++k) used[i] += touch[k].triangle != noTriangle;
  }
};

struct PackTouches {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *from, *to;
  const SurfaceTouch *touch;
  const std::int32_t *tag;
  SurfaceTouch *packed;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t at = to[i];
    for (std::uint32_t k = from[i]; k < from[i + 1]; ++k) {
      if (touch[k].triangle == noTriangle) continue;
      packed[at] = touch[k];
      packed[at++].tag = tag[i];
    }
  }
};

/// Which grains a surface may reach before the next rebuild, or before the surface has moved by its share of margin,
/// and with which triangles.
template <class P>
struct MarkNearSurface {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;

  std::uint32_t sequence;
  const Status *status;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t role;
  double margin;  ///< how far grain and surface may move, and the gap across which the wall pulls (distance)
  SurfaceAt at;
  Real *history;  ///< [n][historySize]
  int historySize;
  std::uint32_t *anchor;
  std::uint32_t *near;  ///< [n][nearTriangles]

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (sequence > status->lastAllowed) return;
    std::uint32_t *list = near + static_cast<std::size_t>(nearTriangles) * i;
    *list = noNearTriangle;
    if (motion[i].word & role) {
      const FixedPosition p = loadPosition(position, i, motion[i].word);
      const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
      if (listNear(at.surface, at.pose.toBody(x), p.radius + margin, list)) {
        anchor[i] |= nearRegionBit;
        return;
      }
    }
    for (int d = 0; d < historySize; ++d) history[static_cast<std::size_t>(historySize) * i + d] = Real(0);
  }
};

/// Force, torque about the body's origin, and number of contacts of one grain with a surface.
template <class P>
struct SurfaceTerms {
  using Real = typename P::Real;
  std::uint32_t count;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *anchor, *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t role;
  Vec3<double> origin;
  const Vec3<Real> *load;
  const Real *history;
  int mostContacts, historySize;

  GPUDEM_HD Sums<7> operator()(std::uint32_t i) const
  {
    Sums<7> r{};
    const std::uint32_t word = motion[i].word;
    if (!(anchor[i] & nearRegionBit) || !(word & role)) return r;
    const SurfaceSlots<const Real> slots{history + static_cast<std::size_t>(historySize) * i, mostContacts,
                                         historySize / mostContacts};
    for (int k = 0; k < mostContacts; ++k) r.value[6] += slots.used(k) ? 1.0 : 0.0;
    if (r.value[6] == 0.0) return r;
    const Vec3<double> x = absolutePosition(loadPosition(position, i, word), cell[i], grid, frame);
    const Vec3<double> force = load[i].template as<double>();
    const Vec3<double> torque = load[count + i].template as<double>() + cross(x - origin, force);
    for (int d = 0; d < 3; ++d) {
      r.value[d] = -force[d];
      r.value[3 + d] = -torque[d];
    }
    return r;
  }
};

}  // namespace gpudem
