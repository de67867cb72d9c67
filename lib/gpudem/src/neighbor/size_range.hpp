// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The sizes of the grains: what is no size, and which ones the coordinates resolve. Host code.
#pragma once

#include "base/particle.hpp"
#include "gpudem/engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gpudem {

struct SizeRange {
  double smallest, largest;  ///< radii (distance)
};

/// \throws Error for a radius or mass that is no number above 0.
inline SizeRange sizeRange(const HostParticles &host, double largestToCome)
{
  SizeRange range{largestToCome, largestToCome};
  for (std::size_t i = 0; i < host.count; ++i) {
    const double radius = host.radius[i], mass = host.mass[i];
    if (!(radius > 0.0) || !(mass > 0.0) || !std::isfinite(radius + mass))
      throw Error(fmt::format("atom {} has radius {:g} and mass {:g}; both must be numbers above 0", host.tag[i], radius, mass));
    range.smallest = i == 0 ? radius : std::min(range.smallest, radius);
    range.largest = std::max(range.largest, radius);
  }
  return range;
}

/// Smallest radius that coordinates in these windows resolve (distance): overlaps of a hundredth of the radius to one in a
/// hundred, and the search, which reads 32 bits, the radius to one in a hundred.
/// \param bits of a coordinate
inline double smallestResolved(const Frame &frame, int bits)
{
  const double window = std::max(frame.window.x, std::max(frame.window.y, frame.window.z));
  return window * std::max(1.0e4 * std::ldexp(1.0, -bits), 1.0e2 * std::ldexp(1.0, -32));
}

/// \throws Error if the windows, which must span several of the largest grains, are too coarse for the smallest.
inline void requireResolved(const SizeRange &sizes, const Frame &frame, int bits)
{
  const double least = smallestResolved(frame, bits);
  if (sizes.smallest >= least) return;
  throw Error(fmt::format("radii from {:g} to {:g}, a ratio of {:g}: next to the largest, coordinates of {} bits resolve no "
                          "radius below {:g}",
                          sizes.smallest, sizes.largest, sizes.largest / sizes.smallest, bits, least));
}

}  // namespace gpudem
