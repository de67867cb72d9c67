// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The resident state of a grain and its modular fixed-point position.
///
/// A coordinate is kept as a fraction of a *window* of at least eight cells, in 32 bits (mixed) or 64
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
  std::uint32_t x, y, z;   ///< lower 32 bits of the modular coordinate
  std::uint32_t radius;    ///< the 29 bits of the radius' mantissa that a float cannot hold
};

template <class Real>
struct alignas(16) Motion;

template <>
struct alignas(16) Motion<float> {
  float vx, vy, vz;       ///< velocity (distance/time)
  float mass;
  float wx, wy, wz;       ///< spin (radian/time)
  std::uint32_t mask;     ///< LAMMPS group bits
};
template <>
struct alignas(16) Motion<double> {
  double vx, vy, vz;
  double mass;
  double wx, wy, wz;
  std::uint32_t mask;
  std::uint32_t spare;
};

/// Constants of the modular coordinates, the same for the whole life of an upload.
struct Frame {
  Vec3<double> origin;      ///< where coordinate 0 lies (distance)
  Vec3<double> window;      ///< period of the coordinate (distance)
  Vec3<double> inverse;     ///< 1/window
  Vec3<double> unit32;      ///< window/2^32
  Vec3<double> unit64;      ///< window/2^64
};

/// Position of \p x in its window, as 64-bit fraction.
GPUDEM_HD std::uint64_t toFraction(double x, double origin, double inverseWindow)
{
  double t = (x - origin) * inverseWindow;
  t -= floor(t);
  return static_cast<std::uint64_t>(t * 9007199254740992.0) << 11;  // 2^53, then to the top
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

/// Mixed precision: 32-bit coordinates, float velocities and forces.
struct Mixed {
  using Real = float;
  using Fixed = std::uint32_t;
  using Signed = std::int32_t;
  static constexpr bool fine = false;
};

/// Double precision: 64-bit coordinates, double everywhere.
struct Double {
  using Real = double;
  using Fixed = std::uint64_t;
  using Signed = std::int64_t;
  static constexpr bool fine = true;
};

template <class P>
struct FixedPosition {
  typename P::Fixed x, y, z;
  double radius;
};

/// Arrays of positions; \p fine is null in mixed precision.
struct PositionArrays {
  CoarsePosition *coarse;
  FinePosition *fine;
};

GPUDEM_HD std::uint64_t join(std::uint32_t upper, std::uint32_t lower)
{
  return (static_cast<std::uint64_t>(upper) << 32) | lower;
}

template <class P>
GPUDEM_HD FixedPosition<P> loadPosition(const PositionArrays &a, std::uint32_t i);

template <>
GPUDEM_HD FixedPosition<Mixed> loadPosition<Mixed>(const PositionArrays &a, std::uint32_t i)
{
  const CoarsePosition c = a.coarse[i];
  return {c.x, c.y, c.z, static_cast<double>(c.radius)};
}
template <>
GPUDEM_HD FixedPosition<Double> loadPosition<Double>(const PositionArrays &a, std::uint32_t i)
{
  const CoarsePosition c = a.coarse[i];
  const FinePosition f = a.fine[i];
  return {join(c.x, f.x), join(c.y, f.y), join(c.z, f.z), joinRadius(c.radius, f.radius)};
}

/// Upper bits of the coordinates, without the radius.
GPUDEM_HD CoarsePosition coarsePart(const FixedPosition<Mixed> &p) { return {p.x, p.y, p.z, 0.0f}; }
GPUDEM_HD CoarsePosition coarsePart(const FixedPosition<Double> &p)
{
  return {static_cast<std::uint32_t>(p.x >> 32), static_cast<std::uint32_t>(p.y >> 32),
          static_cast<std::uint32_t>(p.z >> 32), 0.0f};
}

/// \return the coarse part
GPUDEM_HD CoarsePosition storePosition(const PositionArrays &a, std::uint32_t i, const FixedPosition<Mixed> &p)
{
  CoarsePosition c = coarsePart(p);
  c.radius = static_cast<float>(p.radius);
  a.coarse[i] = c;
  return c;
}
GPUDEM_HD CoarsePosition storePosition(const PositionArrays &a, std::uint32_t i, const FixedPosition<Double> &p)
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
template <class P>
GPUDEM_HD Vec3<double> separation(const FixedPosition<P> &a, const FixedPosition<P> &b, const Frame &frame)
{
  using Signed = typename P::Signed;
  const Vec3<double> &unit = P::fine ? frame.unit64 : frame.unit32;
  return {static_cast<double>(static_cast<Signed>(a.x - b.x)) * unit.x,
          static_cast<double>(static_cast<Signed>(a.y - b.y)) * unit.y,
          static_cast<double>(static_cast<Signed>(a.z - b.z)) * unit.z};
}

GPUDEM_HD std::uint64_t widen(std::uint32_t x) { return static_cast<std::uint64_t>(x) << 32; }
GPUDEM_HD std::uint64_t widen(std::uint64_t x) { return x; }
template <class Fixed>
GPUDEM_HD Fixed narrow(std::uint64_t x);
template <>
GPUDEM_HD std::uint32_t narrow<std::uint32_t>(std::uint64_t x)
{
  return static_cast<std::uint32_t>((x + 0x80000000ull) >> 32);  // to nearest
}
template <>
GPUDEM_HD std::uint64_t narrow<std::uint64_t>(std::uint64_t x)
{
  return x;
}

/// Absolute coordinate of a grain known to be within half a window of \p near (distance).
template <class Fixed>
GPUDEM_HD double toAbsolute(Fixed x, double near, double origin, double inverseWindow, double unit64)
{
  const std::int64_t away = static_cast<std::int64_t>(widen(x) - toFraction(near, origin, inverseWindow));
  return near + static_cast<double>(away) * unit64;
}

}  // namespace gpudem
