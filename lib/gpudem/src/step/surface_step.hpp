// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A wall of triangles ahead of the contacts of a step, and which grains it may reach.
#pragma once

#include "base/warp.hpp"
#include "step/observables.hpp"
#include "step/step_view.hpp"
#include "surface/group_contacts.hpp"
#include "wall/surface_wall.hpp"

namespace gpudem {

/// One surface at one step.
template <class P>
struct SurfaceStepView {
  using Real = typename P::Real;

  std::uint32_t count, sequence;  ///< as in StepView
  Status *status;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t flatRole;  ///< as in RegionStep
  Real dt;
  bool advance;
  WallView<Real> wall;
  int mostContacts;
  SurfaceAt at;
  const std::uint32_t *nearGrain;  ///< grains near the surface
  const std::uint32_t *nearList;   ///< [NearList::most][nearGrains] see NearList
  const float *nearGap;            ///< likewise
  const Vec3<double> *nearFrom;    ///< [nearGrains] centres when this was listed, in the frame of the body (distance)
  std::uint32_t *nearSlots;        ///< [nearGrains] SurfaceSlots::inUse
  std::uint32_t nearGrains;
  Vec3<Real> *load;  ///< [n] forces, [n] torques; those of grains that are not near are zero
  const std::uint32_t *touchAt;  ///< [n] first place of a grain in \c touch
  SurfaceTouch *touch;           ///< mostContacts for every near grain, or null

  GPUDEM_HD GrainAtSurface<Real> grain(std::uint32_t i, const Motion<Real> &m) const
  {
    GrainAtSurface<Real> g;
    const FixedPosition p = loadPosition(position, i, m.word);
    g.index = i;
    g.x = absolutePosition(p, cell[i], grid, frame);
    g.inBody = at.pose.toBody(g.x);
    g.radius = p.radius;
    g.motion = m;
    if (m.word & flatRole) g.motion.vz = g.motion.wx = g.motion.wy = Real(0);
    return g;
  }
  /// Of the k-th near grain.
  GPUDEM_HD SurfaceSlots<Real> slots(std::uint32_t k) const
  {
    return {wall.history + static_cast<std::size_t>(wall.historySize) * nearGrain[k], mostContacts,
            wall.historySize / mostContacts, nearSlots[k]};
  }
  GPUDEM_HD NearList list(std::uint32_t k, const Vec3<double> &inBody) const
  {
    const Vec3<float> way = (inBody - nearFrom[k]).template as<float>();
    return {nearList + k, nearGap + k, nearGrains, squareRoot(dot(way, way)) * 1.000001f};
  }
  GPUDEM_HD SurfaceTouch *touchesOf(std::uint32_t i) const { return touch ? touch + touchAt[i] : nullptr; }
  GPUDEM_HD void write(std::uint32_t i, const SurfaceLoad<Real> &l) const
  {
    load[i] = l.force;
    load[count + i] = l.torque;
    if (l.trouble == SurfaceTrouble::Crowded) atomicLower(&status->crowded, i);
    if (l.trouble == SurfaceTrouble::Crossed) atomicLower(&status->crossed, i);
  }
};

/// Loads of the grains near a surface, one lane each. \tparam Law AnyWallLaw or ModelWallLaw
template <class P, class Law>
struct SurfaceStep : SurfaceStepView<P> {
  using Real = typename P::Real;
  static constexpr int blockSize = 64;
  static constexpr int minimumBlocks = P::fine ? 5 : 8;  // 128 registers in mixed: the loads of more warps overlap

  GPUDEM_HD explicit SurfaceStep(const SurfaceStepView<P> &v) : SurfaceStepView<P>(v) {}
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const SurfaceStepView<P> &s = *this;
    letNextStart();
    if (s.sequence > s.status->lastAllowed) return;
    const std::uint32_t i = s.nearGrain[k];
    const Motion<Real> m = s.motion[i];
    SurfaceLoad<Real> l{};
    if (m.word & s.wall.role) {
      const GrainAtSurface<Real> g = s.grain(i, m);
      SurfaceSlots<Real> slots = s.slots(k);
      l = surfaceLoad<Law>(s.wall, s.at, slots, g, s.count, s.dt, s.advance, s.list(k, g.inBody), s.touchesOf(i));
      s.nearSlots[k] = slots.inUse;
    }
    s.write(i, l);
    waitForEarlier();  // who waits for this launch waits for those before it
  }
};

/// The same by several lanes for each grain: where the grains are too few to fill the chip, what counts is the time that
/// the grain of most contacts takes.
template <class P, class Law>
struct SurfaceGroupStep : SurfaceStepView<P> {
  using Real = typename P::Real;
  static constexpr int blockSize = 64;
  static constexpr int minimumBlocks = P::fine ? 5 : 8;
  static constexpr std::uint32_t lanes = 4;  ///< of a group

  struct Group {
    SurfaceContacts contacts;
    union {  // first the one, then the other: shared memory limits how many warps are at work
      GroupScratch<lanes> scratch;
      ContactLoad<Real> load[maxSurfaceSlots];
    };
    int slot[maxSurfaceSlots];
  };
  /// What the lanes of a warp share.
  struct Shared {
    Group group[warpWidth / lanes];
  };

  GPUDEM_HD explicit SurfaceGroupStep(const SurfaceStepView<P> &v) : SurfaceStepView<P>(v) {}
  /// All lanes of a warp call this; there are nearGrains groups.
  GPUDEM_HD void operator()(std::uint32_t thread, bool inRange, Shared &shared) const
  {
    const SurfaceStepView<P> &s = *this;
    letNextStart();
    if (s.sequence > s.status->lastAllowed) return;
    const std::uint32_t k = inRange ? thread / lanes : 0u, i = s.nearGrain[k], member = warpLane() % lanes;
    Group &group = shared.group[warpLane() / lanes];
    SurfaceContacts &c = group.contacts;
    const Motion<Real> m = s.motion[i];
    const bool wanted = inRange && (m.word & s.wall.role), leads = member == 0;
    const GrainAtSurface<Real> g = s.grain(i, m);
    SurfaceSlots<Real> slots = s.slots(k);
    const NearList list = s.list(k, g.inBody);
    GroupSearch<lanes>(s.at.surface, g.inBody, holdingReach<Law>(s.wall, slots, g.radius), list, c, group.scratch)
        .find(wanted);
    SurfaceTrouble trouble = SurfaceTrouble::None;
    if (wanted && leads) trouble = takeSlots(s.at, slots, c, g.radius, group.slot);
    warpSync();
    SurfaceTouch *touches = s.touchesOf(i);
    for (int n = static_cast<int>(member); wanted && n < c.count; n += static_cast<int>(lanes))
      group.load[n] = contactLoad<Law>(s.wall, s.at, slots, group.slot[n], c.contact[n], g, s.dt, s.advance,
                                       touches ? touches + n : nullptr);
    warpSync();
    if (inRange && leads) {
      SurfaceLoad<Real> l{};
      if (wanted) {
        l = sumOfContacts(s.wall, s.at, slots, c, group.slot, g, s.count, trouble, [&](int n) { return group.load[n]; });
        s.nearSlots[k] = slots.inUse;
      }
      s.write(i, l);
    }
    waitForEarlier();
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

/// Which grains a surface may reach before the next rebuild, or before the surface has moved by its share of margin.
/// The others feel nothing until then.
template <class P>
struct MarkNearSurface {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;

  std::uint32_t count, sequence;
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
  Vec3<Real> *load;  ///< [n] forces, [n] torques
  std::uint32_t *anchor;
  std::uint32_t *near;  ///< [n] 1 or 0; before, those that may keep something

  GPUDEM_HD Vec3<double> inBody(std::uint32_t i, const FixedPosition &p) const
  {
    return at.pose.toBody(absolutePosition(p, cell[i], grid, frame));
  }
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (sequence > status->lastAllowed) return;
    const bool mayKeep = near[i] != 0u;
    near[i] = 0u;
    if (motion[i].word & role) {
      const FixedPosition p = loadPosition(position, i, motion[i].word);
      bool found = false;
      visitNear(at.surface, inBody(i, p), p.radius + margin, [&](std::uint32_t, const TrianglePoint &, double) {
        found = true;
        return false;
      });
      if (found) {
        near[i] = 1u;
        anchor[i] |= nearRegionBit;
        return;
      }
    }
    const Vec3<Real> none{Real(0), Real(0), Real(0)};
    load[i] = load[count + i] = none;
    for (int d = 0; mayKeep && d < historySize; ++d) history[static_cast<std::size_t>(historySize) * i + d] = Real(0);
  }
};

/// Where near grains will find the surface, and which slots they use.
template <class P>
struct ListNear {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;

  MarkNearSurface<P> mark;
  double room;  ///< how far grain and surface may move (distance)
  const std::uint32_t *grain;  ///< [grains]
  std::uint32_t grains;
  int mostContacts;
  std::uint32_t *list;   ///< [NearList::most][grains]
  float *gap;            ///< likewise
  Vec3<double> *from;    ///< [grains] centres in the frame of the body (distance)
  std::uint32_t *slots;  ///< [grains] SurfaceSlots::inUse

  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    if (mark.sequence > mark.status->lastAllowed) return;
    const std::uint32_t i = grain[k];
    const FixedPosition p = loadPosition(mark.position, i, mark.motion[i].word);
    from[k] = mark.inBody(i, p);
    listNear(mark.at.surface, from[k], p.radius + mark.margin, room, list + k, gap + k, grains);
    slots[k] = slotsOf(mark.history + static_cast<std::size_t>(mark.historySize) * i, mostContacts, mark.historySize).inUse;
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
    const SurfaceSlots<const Real> slots =
        slotsOf(history + static_cast<std::size_t>(historySize) * i, mostContacts, historySize);
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
