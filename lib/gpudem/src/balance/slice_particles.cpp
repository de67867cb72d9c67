// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "balance/slice_histogram.h"
#include "gpudem/errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gpudem {

HostSliceParticles::HostSliceParticles(std::size_t count, const double *position, const double *weight,
                                       const double *origin, const double *length)
    : position_(position), weight_(weight), group_(count)
{
  for (int a = 0; a < 3; ++a) {
    origin_[a] = origin[a];
    inverse_[a] = 1.0 / length[a];
  }
}

void HostSliceParticles::countExponents(double *counts) const
{
  if (!weight_) {
    counts[129] += static_cast<double>(group_.size());
    return;
  }
  for (std::size_t i = 0; i < group_.size(); ++i) {
    const double w = weight_[i];
    if (!(w >= 0.0) || !std::isfinite(w))
      throw Error(fmt::format(
          "balancing: particle {} of this rank has weight {}; a weight must be a number, not negative", i, w));
    int exponent = 0;
    std::frexp(w, &exponent);  // w < 2^exponent
    ++counts[w == 0.0 ? 0 : std::clamp(exponent + 128, 1, exponents - 1)];
  }
}

void HostSliceParticles::begin(double unit)
{
  std::fill(group_.begin(), group_.end(), 0);
  units_.clear();
  alike_ = std::nearbyint(1.0 / unit);
  if (!weight_) return;
  units_.resize(group_.size());
  // nearbyint, not a cast: a single weight may exceed what an integer holds
  for (std::size_t i = 0; i < group_.size(); ++i) units_[i] = std::nearbyint(weight_[i] / unit);
}

void HostSliceParticles::count(int axis, const SliceBins &bins, double *weights) const
{
  countInBins({group_.size(), position_ + axis, 3, origin_[axis], inverse_[axis]}, group_.data(),
              units_.empty() ? nullptr : units_.data(), alike_, bins, weights);
}

void HostSliceParticles::descend(const SliceLevel &level)
{
  descendToParts({group_.size(), position_ + level.axis, 3, origin_[level.axis], inverse_[level.axis]}, level,
                 group_.data());
}

}  // namespace gpudem
