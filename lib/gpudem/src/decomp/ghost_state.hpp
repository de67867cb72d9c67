// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a rank tells another about a grain: once all that its contacts need, then at every step what changed.
///
/// Coordinates are modulo the window and windows are the same on all ranks, so that the bits of a position are right
/// wherever they go: a ghost across a periodic face needs no shift.
#pragma once

#include "base/particle.hpp"

namespace gpudem {

/// What a step changes.
template <class P>
struct GhostState;
template <>
struct GhostState<Mixed> {
  std::uint32_t x, y, z;  ///< upper 32 bits of the coordinates
  std::uint32_t word;     ///< Motion::word, which holds their lower bits
  float vx, vy, vz, wx, wy, wz;
};
template <>
struct GhostState<Double> {
  std::uint64_t x, y, z;  ///< window/2^64
  double vx, vy, vz, wx, wy, wz;
};

/// What stays until rows are built anew.
struct GhostIdentity {
  double radius;  ///< (distance)
  double mass;
  std::int32_t tag;
  std::int32_t type;
  std::uint32_t mask;  ///< group bits
  std::uint32_t home;  ///< cell of the largest grains
  std::uint32_t word;  ///< Motion::word
  std::uint32_t unused;
};

template <class P>
struct GhostRecord {
  GhostState<P> state;
  GhostIdentity identity;
};

template <class Real, class State>
GPUDEM_HD void copyMotion(const Motion<Real> &m, State &g)
{
  g.vx = m.vx;
  g.vy = m.vy;
  g.vz = m.vz;
  g.wx = m.wx;
  g.wy = m.wy;
  g.wz = m.wz;
}
template <class Real, class State>
GPUDEM_HD void copyMotion(const State &g, Motion<Real> &m)
{
  m.vx = g.vx;
  m.vy = g.vy;
  m.vz = g.vz;
  m.wx = g.wx;
  m.wy = g.wy;
  m.wz = g.wz;
}

GPUDEM_HD GhostState<Mixed> ghostState(const PositionArrays<Mixed> &a, std::uint32_t i)
{
  const CoarsePosition c = a.coarse[i];
  const Motion<float> m = a.motion[i];
  GhostState<Mixed> g;
  g.x = c.x;
  g.y = c.y;
  g.z = c.z;
  g.word = m.word;
  copyMotion(m, g);
  return g;
}
GPUDEM_HD GhostState<Double> ghostState(const PositionArrays<Double> &a, std::uint32_t i)
{
  const FixedPosition p = loadPosition(a, i);
  GhostState<Double> g;
  g.x = p.x;
  g.y = p.y;
  g.z = p.z;
  copyMotion(a.motion[i], g);
  return g;
}

/// Radius, mass and role of the ghost at \p i stay.
GPUDEM_HD void setGhost(const PositionArrays<Mixed> &a, std::uint32_t i, const GhostState<Mixed> &g)
{
  CoarsePosition &c = a.coarse[i];
  c.x = g.x;
  c.y = g.y;
  c.z = g.z;
  copyMotion(g, a.motion[i]);
  a.motion[i].word = g.word;
}
GPUDEM_HD void setGhost(const PositionArrays<Double> &a, std::uint32_t i, const GhostState<Double> &g)
{
  CoarsePosition &c = a.coarse[i];
  FinePosition &f = a.fine[i];
  c.x = static_cast<std::uint32_t>(g.x >> 32);
  c.y = static_cast<std::uint32_t>(g.y >> 32);
  c.z = static_cast<std::uint32_t>(g.z >> 32);
  f.x = static_cast<std::uint32_t>(g.x);
  f.y = static_cast<std::uint32_t>(g.y);
  f.z = static_cast<std::uint32_t>(g.z);
  copyMotion(g, a.motion[i]);
}

GPUDEM_HD void setRadius(const PositionArrays<Mixed> &a, std::uint32_t i, double radius)
{
  a.coarse[i].radius = static_cast<float>(radius);
}
GPUDEM_HD void setRadius(const PositionArrays<Double> &a, std::uint32_t i, double radius)
{
  splitRadius(radius, a.coarse[i].radius, a.fine[i].radius);
}

/// Coordinates of a ghost before it has a place in the arrays.
GPUDEM_HD FixedPosition ghostPosition(const GhostState<Mixed> &g, std::uint32_t fineMask)
{
  return {joinByte(g.x, g.word, 0, fineMask), joinByte(g.y, g.word, 1, fineMask), joinByte(g.z, g.word, 2, fineMask),
          0.0};
}
GPUDEM_HD FixedPosition ghostPosition(const GhostState<Double> &g, std::uint32_t)
{
  return {g.x, g.y, g.z, 0.0};
}

template <class P>
struct PackStates {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  PositionArrays<P> in;
  const std::uint32_t *index;  ///< [messages' grains]
  GhostState<P> *out;
  GPUDEM_HD void operator()(std::uint32_t k) const { out[k] = ghostState(in, index[k]); }
};
template <class P>
struct UnpackStates {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const GhostState<P> *in;
  const std::uint32_t *order;  ///< [ghosts] place of each ghost in the messages
  std::uint32_t count;         ///< grains before the ghosts
  PositionArrays<P> out;
  GPUDEM_HD void operator()(std::uint32_t g) const { setGhost(out, count + g, in[order[g]]); }
};

/// Arrays of the grains that a record is made of.
template <class P>
struct GrainArrays {
  PositionArrays<P> position;
  std::int32_t *tag;
  int *type;
  std::uint32_t *mask, *home;
};

template <class P>
struct PackRecords {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  GrainArrays<P> in;
  const std::uint32_t *index;
  GhostRecord<P> *out;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const std::uint32_t i = index[k];
    const auto &motion = in.position.motion[i];
    GhostRecord<P> r;
    r.state = ghostState(in.position, i);
    r.identity = {loadPosition(in.position, i).radius,
                  static_cast<double>(motion.mass),
                  in.tag[i],
                  in.type[i],
                  in.mask[i],
                  in.home[i],
                  motion.word,
                  0u};
    out[k] = r;
  }
};
template <class P>
struct UnpackRecords {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  using Real = typename P::Real;
  const GhostRecord<P> *in;
  const std::uint32_t *order;
  std::uint32_t count;
  GrainArrays<P> out;
  PositionArrays<P> spare;  ///< the other buffers, in which what a step does not change must stand, too
  GPUDEM_HD void operator()(std::uint32_t g) const
  {
    const GhostRecord<P> r = in[order[g]];
    const std::uint32_t i = count + g;
    put(out.position, i, r);
    put(spare, i, r);
    out.tag[i] = r.identity.tag;
    out.type[i] = r.identity.type;
    out.mask[i] = r.identity.mask;
    out.home[i] = r.identity.home;
  }

 private:
  GPUDEM_HD void put(const PositionArrays<P> &a, std::uint32_t i, const GhostRecord<P> &r) const
  {
    a.motion[i].mass = static_cast<Real>(r.identity.mass);
    a.motion[i].word = r.identity.word;
    setRadius(a, i, r.identity.radius);
    setGhost(a, i, r.state);
  }
};

}  // namespace gpudem
