// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Counting particles into bins, over plain arrays: what a device version replaces.
#pragma once

#include "gpudem/slice_grid.h"

namespace gpudem {

/// Positions along one axis, as fractions of the box.
struct AxisPositions {
  std::size_t count;
  const double *position;  // distance, one particle every \p stride numbers
  std::size_t stride;
  double origin;   // lower face of the box, distance
  double inverse;  // 1 / edge of the box, 1/distance

  double operator[](std::size_t i) const { return (position[i * stride] - origin) * inverse; }
};

/// Bin of a position in its group; outside the group's range: the nearest bin. On an edge: the bin above.
inline std::int64_t binOf(const SliceBins &bins, int group, double x)
{
  int low = bins.segmentStart[group], high = bins.segmentStart[group + 1] - 1;
  while (low < high) {
    const int middle = (low + high + 1) / 2;
    if (x < bins.segmentLower[middle]) high = middle - 1;
    else low = middle;
  }
  const std::int64_t n = bins.binStart[low + 1] - bins.binStart[low];
  if (n == 1) return bins.binStart[low];
  const double place =
      (x - bins.segmentLower[low]) / (bins.segmentUpper[low] - bins.segmentLower[low]) * static_cast<double>(n);
  // the quotient may round across an edge: the comparison with the edges decides, as it does for the finished cuts
  std::int64_t k = place < 0.0 ? 0 : (place >= static_cast<double>(n) ? n - 1 : static_cast<std::int64_t>(place));
  while (k > 0 && x < bins.edge(low, k)) --k;
  while (k + 1 < n && x >= bins.edge(low, k + 1)) ++k;
  return bins.binStart[low] + k;
}

/// Adds to weights[bin] the weight of each particle.
/// \param group   [count], the group of each particle
/// \param units   [count], integer weights, or null: each weighs \p alike
inline void countInBins(const AxisPositions &x, const int *group, const double *units, double alike,
                        const SliceBins &bins, double *weights)
{
  for (std::size_t i = 0; i < x.count; ++i) weights[binOf(bins, group[i], x[i])] += units ? units[i] : alike;
}

/// The group of each particle becomes the part of \p level that it is in.
inline void descendToParts(const AxisPositions &x, const SliceLevel &level, int *group)
{
  for (std::size_t i = 0; i < x.count; ++i) {
    int low = level.groupStart[group[i]], high = level.groupStart[group[i] + 1] - 1;
    while (low < high) {
      const int middle = (low + high + 1) / 2;
      if (x[i] < level.lower[middle]) high = middle - 1;
      else low = middle;
    }
    group[i] = low;
  }
}

}  // namespace gpudem
