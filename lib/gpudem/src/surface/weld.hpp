// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Vertices that are the same point up to a distance. Host only.
#pragma once

#include "gpudem/surface.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace gpudem {

/// Maps each point to the first one within \p distance of it, by cells of twice that size.
class Welder {
 public:
  Welder(const std::vector<std::array<double, 3>> &point, double distance)
      : point_(point), distance_(distance), same_(point.size())
  {
    cell_.reserve(point.size());
    for (std::uint32_t i = 0; i < point.size(); ++i) same_[i] = place(i);
  }
  const std::vector<std::uint32_t> &same() const { return same_; }

 private:
  std::uint32_t place(std::uint32_t i)
  {
    // a ball of the welding distance reaches into two cells in each direction at most
    long lo[3], hi[3];
    for (std::size_t d = 0; d < 3; ++d) {
      lo[d] = index(point_[i][d] - distance_);
      hi[d] = index(point_[i][d] + distance_);
    }
    for (long x = lo[0]; x <= hi[0]; ++x)
      for (long y = lo[1]; y <= hi[1]; ++y)
        for (long z = lo[2]; z <= hi[2]; ++z) {
          const auto range = cell_.equal_range(key(x, y, z));
          for (auto it = range.first; it != range.second; ++it)
            if (near(it->second, i)) return it->second;
        }
    cell_.emplace(key(index(point_[i][0]), index(point_[i][1]), index(point_[i][2])), i);
    return i;
  }
  long index(double x) const { return std::lround(std::floor(x / (2.0 * distance_))); }
  static std::uint64_t key(long x, long y, long z)
  {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ull;
    h = (h ^ h >> 29 ^ static_cast<std::uint64_t>(y)) * 0xbf58476d1ce4e5b9ull;
    return (h ^ h >> 32 ^ static_cast<std::uint64_t>(z)) * 0x94d049bb133111ebull;
  }
  bool near(std::uint32_t a, std::uint32_t b) const
  {
    double sum = 0.0;
    for (std::size_t d = 0; d < 3; ++d) sum += (point_[a][d] - point_[b][d]) * (point_[a][d] - point_[b][d]);
    return sum <= distance_ * distance_;
  }

  const std::vector<std::array<double, 3>> &point_;
  double distance_;
  std::vector<std::uint32_t> same_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cell_;  // first points only
};

}  // namespace gpudem
