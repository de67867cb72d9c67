// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The resident state of a grain and its modular fixed-point position.
///
/// A coordinate is kept as a fraction of a *window* of at least eight cells, in 40 bits (mixed) or 64
/// (double), modulo the window. Grains that can meet are closer than half a window, so their exact
/// distance is one wrapping subtraction of integers: no cell offset, no minimum image, no cancellation,
/// the same accuracy wherever the grain is. In a periodic direction the box is a whole number of
/// windows, so images need no code at all. See doc/Howto_precision.md.
#pragma once

#include "base/real.hpp"
#include "base/vec3.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gpudem {

/// First 16 bytes of a grain: all that the search for contacts reads.
struct alignas(16) CoarsePosition {
  std::uint32_t x, y, z;  ///< upper 32 bits of the modular coordinate (window/2^32)
  float radius;           ///< mixed: the radius; double: its truncated upper part (distance)
};

/// The remaining bits, kept and read in double precision only.
struct alignas(16) FinePosition {
  std::uint32_t x, y, z;  ///< lower 32 bits of the modular coordinate
  std::uint32_t radius;   ///< the 29 bits of the radius' mantissa that a float cannot hold
};

template <class Real>
struct alignas(16) Motion;

template <>
struct alignas(16) Motion<float> {
  float vx, vy, vz;  ///< velocity (distance/time)
  float mass;
  float wx, wy, wz;    ///< spin (radian/time)
  std::uint32_t word;  ///< roles and, above them, the lower bits of the position: see Roles
};
template <>
struct alignas(16) Motion<double> {
  double vx, vy, vz;
  double mass;
  double wx, wy, wz;
  std::uint32_t word;  ///< roles
  std::uint32_t spare;
};

/// Constants of the modular coordinates, the same for the whole life of an upload.
struct Frame {
  Vec3<double> origin;   ///< where coordinate 0 lies (distance)
  Vec3<double> window;   ///< period of the coordinate (distance)
  Vec3<double> inverse;  ///< 1/window
  Vec3<double> unit32;   ///< window/2^32
  Vec3<double> unit64;   ///< window/2^64
};

/// Position of \p x in its window, as 64-bit fraction.
GPUDEM_HD std::uint64_t toFraction(double x, double origin, double inverseWindow)
{
  double t = (x - origin) * inverseWindow;
  t -= floor(t);
  return static_cast<std::uint64_t>(t * 9007199254740992.0) << 11;  // 2^53, then to the top
}

/// Coordinates as fractions of the window in units of 2^-64, whatever the precision that stores them.
struct FixedPosition {
  std::uint64_t x, y, z;
  double radius;
};

/// Coordinates of \p x; the radius stays.
GPUDEM_HD void setCoordinates(FixedPosition &p, const Vec3<double> &x, const Frame &frame)
{
  p.x = toFraction(x.x, frame.origin.x, frame.inverse.x);
  p.y = toFraction(x.y, frame.origin.y, frame.inverse.y);
  p.z = toFraction(x.z, frame.origin.z, frame.inverse.z);
}

/// Radius of double precision from its two stored parts.
GPUDEM_HD double joinRadius(float upper, std::uint32_t lower)
{
  double wide = upper;
  std::uint64_t bits;
  memcpy(&bits, &wide, 8);
  bits |= lower;
  memcpy(&wide, &bits, 8);
  return wide;
}
GPUDEM_HD void splitRadius(double radius, float &upper, std::uint32_t &lower)
{
  std::uint64_t bits;
  memcpy(&bits, &radius, 8);
  lower = static_cast<std::uint32_t>(bits & 0x1fffffffu);
  bits &= ~static_cast<std::uint64_t>(0x1fffffffu);
  double truncated;
  memcpy(&truncated, &bits, 8);
  upper = static_cast<float>(truncated);
}

/// Mixed precision: 40-bit coordinates, float velocities and forces.
struct Mixed {
  using Real = float;
  static constexpr bool fine = false;
};

/// Double precision: 64-bit coordinates, double everywhere.
struct Double {
  using Real = double;
  static constexpr bool fine = true;
};

/// Arrays of positions; \p fine is null in mixed precision, whose lower bits lie in the words of \p motion.
template <class P>
struct PositionArrays {
  CoarsePosition *coarse;
  FinePosition *fine;
  Motion<typename P::Real> *motion;
  std::uint32_t fineMask;  ///< mixed: see Roles
};

GPUDEM_HD std::uint64_t join(std::uint32_t upper, std::uint32_t lower)
{
  return (static_cast<std::uint64_t>(upper) << 32) | lower;
}

/// Eight bits of a coordinate from byte \p axis + 1 of the word.
GPUDEM_HD std::uint64_t joinByte(std::uint32_t upper, std::uint32_t word, int axis, std::uint32_t fineMask)
{
  return join(upper, (word >> (8 * axis + 8) & fineMask) << 24);
}

/// \param word of the grain's motion
GPUDEM_HD FixedPosition loadPosition(const PositionArrays<Mixed> &a, std::uint32_t i, std::uint32_t word)
{
  const CoarsePosition c = a.coarse[i];
  return {joinByte(c.x, word, 0, a.fineMask), joinByte(c.y, word, 1, a.fineMask), joinByte(c.z, word, 2, a.fineMask),
          static_cast<double>(c.radius)};
}
GPUDEM_HD FixedPosition loadPosition(const PositionArrays<Double> &a, std::uint32_t i, std::uint32_t)
{
  const CoarsePosition c = a.coarse[i];
  const FinePosition f = a.fine[i];
  return {join(c.x, f.x), join(c.y, f.y), join(c.z, f.z), joinRadius(c.radius, f.radius)};
}
template <class P>
GPUDEM_HD FixedPosition loadPosition(const PositionArrays<P> &a, std::uint32_t i)
{
  return loadPosition(a, i, P::fine ? 0u : a.motion[i].word);
}

/// Upper bits of the coordinates, without the radius.
GPUDEM_HD CoarsePosition coarsePart(const FixedPosition &p)
{
  return {static_cast<std::uint32_t>(p.x >> 32), static_cast<std::uint32_t>(p.y >> 32),
          static_cast<std::uint32_t>(p.z >> 32), 0.0f};
}

/// \param word of the grain's motion, takes the lower bits; the caller stores it
/// \return the coarse part
GPUDEM_HD CoarsePosition storePosition(const PositionArrays<Mixed> &a, std::uint32_t i, const FixedPosition &p,
                                       std::uint32_t &word)
{
  const std::uint64_t half = a.fineMask ? 1ull << 23 : 1ull << 31;  // to nearest
  const FixedPosition q{p.x + half, p.y + half, p.z + half, p.radius};
  CoarsePosition c = coarsePart(q);
  c.radius = static_cast<float>(p.radius);
  a.coarse[i] = c;
  if (a.fineMask)
    word = (word & 0xffu) | static_cast<std::uint32_t>(q.x >> 24 & 0xffu) << 8 |
           static_cast<std::uint32_t>(q.y >> 24 & 0xffu) << 16 | static_cast<std::uint32_t>(q.z >> 24 & 0xffu) << 24;
  return c;
}
GPUDEM_HD CoarsePosition storePosition(const PositionArrays<Double> &a, std::uint32_t i, const FixedPosition &p,
                                       std::uint32_t &)
{
  CoarsePosition c = coarsePart(p);
  FinePosition f;
  f.x = static_cast<std::uint32_t>(p.x);
  f.y = static_cast<std::uint32_t>(p.y);
  f.z = static_cast<std::uint32_t>(p.z);
  splitRadius(p.radius, c.radius, f.radius);
  a.coarse[i] = c;
  a.fine[i] = f;
  return c;
}

/// Exact vector from b to a (distance); exact as long as they are closer than half a window.
GPUDEM_HD Vec3<double> separation(const FixedPosition &a, const FixedPosition &b, const Frame &frame)
{
  return {toDouble(static_cast<std::int64_t>(a.x - b.x)) * frame.unit64.x,
          toDouble(static_cast<std::int64_t>(a.y - b.y)) * frame.unit64.y,
          toDouble(static_cast<std::int64_t>(a.z - b.z)) * frame.unit64.z};
}

/// Squared distance from the coarse coordinates; any two points closer than half a window.
GPUDEM_HD float distance2(const CoarsePosition &a, const CoarsePosition &b, const Vec3<float> &unit)
{
  const float dx = static_cast<float>(static_cast<std::int32_t>(a.x - b.x)) * unit.x;
  const float dy = static_cast<float>(static_cast<std::int32_t>(a.y - b.y)) * unit.y;
  const float dz = static_cast<float>(static_cast<std::int32_t>(a.z - b.z)) * unit.z;
  return dx * dx + dy * dy + dz * dz;
}

/// Could the grains touch? Coarse, and wrong to the safe side only.
GPUDEM_HD bool mayTouch(const CoarsePosition &c, const CoarsePosition &o, const Vec3<float> &unit, float reachSlack)
{
  const float reach = (c.radius + o.radius) * 1.000001f + reachSlack;
  return distance2(c, o, unit) < reach * reach;
}

/// Absolute coordinate of a grain known to be within half a window of \p near (distance).
GPUDEM_HD double toAbsolute(std::uint64_t x, double near, double origin, double inverseWindow, double unit64)
{
  const std::int64_t away = static_cast<std::int64_t>(x - toFraction(near, origin, inverseWindow));
  return near + static_cast<double>(away) * unit64;
}

}  // namespace gpudem
