// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Ways to divide a box among ranks: the slice grid, and what LAMMPS' shift and rcb converge to, written anew
/// here.
#pragma once

#include "gpudem/slice_grid.h"
#include "scenes.h"

#include <chrono>
#include <limits>
#include <memory>
#include <numeric>

namespace bench {

/// What a call cost beyond the work on the grains of a rank.
struct Cost {
  int sums = 0;              // reductions over ranks
  std::int64_t numbers = 0;  // that were reduced
};

class Division {
 public:
  virtual ~Division() = default;
  /// Divide anew, from what the last call left.
  virtual Cost divide(const std::vector<double> &x) = 0;
  virtual int rankOf(const double *point) const = 0;
  /// How many ranks have a sub-domain that overlaps the cube of half edge \p reach around a point.
  virtual int ranksWithin(const double *point, double reach) const = 0;
};

inline gpudem::SliceReport slices(gpudem::SliceGrid &grid, const std::vector<double> &x, double aim)
{
  const double origin[3] = {0, 0, 0};
  gpudem::HostSliceParticles particles(x.size() / 3, x.data(), nullptr, origin, box.data());
  gpudem::SliceOptions options;
  options.aim = aim;
  return gpudem::balanceSlices(grid, particles, options, [](double *, int) {});
}

class Slices : public Division {
 public:
  Slices(int ranks, int levels, const std::array<double, 3> &filled)
  {
    gpudem::SliceRequest request;
    request.ranks = ranks;
    request.levels = levels;
    request.extent = filled;
    grid_ = gpudem::makeSliceGrid(request);
  }
  Cost divide(const std::vector<double> &x) override
  {
    const auto report = slices(grid_, x, 1.01);
    return {report.rounds, report.summed};
  }
  int rankOf(const double *point) const override
  {
    const double f[3] = {point[0] / box[0], point[1] / box[1], point[2] / box[2]};
    return grid_.rankOf(f);
  }
  int ranksWithin(const double *point, double reach) const override { return within(0, 0, point, reach); }

 private:
  int within(std::size_t l, int group, const double *point, double reach) const
  {
    if (l == grid_.levels.size()) return 1;
    const gpudem::SliceLevel &level = grid_.levels[l];
    const int first = level.groupStart[group], last = level.groupStart[group + 1];
    const double lo = (point[level.axis] - reach) / box[level.axis], hi = (point[level.axis] + reach) / box[level.axis];
    const auto begin = level.lower.begin();
    int found = 0;
    for (auto k = std::upper_bound(begin + first + 1, begin + last, lo) - begin - 1;
         k < last && (k == first || level.lower[k] < hi); ++k)
      found += within(l + 1, static_cast<int>(k), point, reach);
    return found;
  }
  gpudem::SliceGrid grid_;
};

/// A grid of planes through the whole box, each axis balanced for itself: what balance shift converges to.
class Planes : public Division {
 public:
  explicit Planes(int ranks)
  {
    double least = std::numeric_limits<double>::max();
    for (int i = 1; i <= ranks; ++i)
      for (int j = 1; ranks % i == 0 && j <= ranks / i; ++j) {
        if (ranks / i % j) continue;
        const int k = ranks / i / j;
        const double surface = box[0] * box[1] / (i * j) + box[1] * box[2] / (j * k) + box[0] * box[2] / (i * k);
        if (surface >= least) continue;
        least = surface;
        n_ = {i, j, k};
      }
    for (int a = 0; a < 3; ++a) {
      gpudem::SliceRequest request;
      request.ranks = n_[a];
      request.levels = 1;
      request.axes = std::string(1, "xyz"[a]);
      axis_[a] = gpudem::makeSliceGrid(request);
    }
  }
  Cost divide(const std::vector<double> &x) override
  {
    Cost cost;
    for (auto &grid : axis_) {
      const auto report = slices(grid, x, 1.01);
      cost.sums += report.rounds;
      cost.numbers += report.summed;
    }
    return cost;
  }
  int rankOf(const double *point) const override
  {
    int rank = 0;
    const double f[3] = {point[0] / box[0], point[1] / box[1], point[2] / box[2]};
    for (int a = 0; a < 3; ++a) rank = rank * n_[a] + axis_[a].rankOf(f);
    return rank;
  }
  int ranksWithin(const double *point, double reach) const override
  {
    int found = 1;
    for (int a = 0; a < 3; ++a) {
      double lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0};
      lo[a] = (point[a] - reach) / box[a];
      hi[a] = (point[a] + reach) / box[a];
      found *= axis_[a].rankOf(hi) - axis_[a].rankOf(lo) + 1;
    }
    return found;
  }

 private:
  std::array<int, 3> n_{};
  std::array<gpudem::SliceGrid, 3> axis_;
};

/// Bisection at the median, across the axis that leaves the least narrow halves: what balance rcb finds.
class Bisection : public Division {
 public:
  explicit Bisection(int ranks) : ranks_(ranks), cut_(ranks) {}
  Cost divide(const std::vector<double> &x) override
  {
    std::vector<std::uint32_t> order(x.size() / 3);
    std::iota(order.begin(), order.end(), 0u);
    Point lo = box, hi = {0, 0, 0};
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        lo[a] = std::min(lo[a], x[3 * i + a]);
        hi[a] = std::max(hi[a], x[3 * i + a]);
      }
    split(x, order.data(), order.data() + order.size(), 0, ranks_ - 1, lo, hi);
    Cost cost;  // three medians, of a few bits each time, at every level; half of the grains change hands at each
    for (int size = ranks_; size > 1; size = (size + 1) / 2) ++cost.sums;
    return cost;
  }
  int rankOf(const double *point) const override
  {
    int low = 0, high = ranks_ - 1;
    while (low < high) {
      const int middle = low + (high - low) / 2 + 1;
      if (point[cut_[middle].axis] < cut_[middle].at) high = middle - 1;
      else low = middle;
    }
    return low;
  }
  int ranksWithin(const double *point, double reach) const override { return within(0, ranks_ - 1, point, reach); }

 private:
  struct Cut {
    int axis;
    double at;
  };
  void split(const std::vector<double> &x, std::uint32_t *first, std::uint32_t *last, int low, int high, Point lo,
             Point hi)
  {
    if (low == high) return;
    const int middle = low + (high - low) / 2 + 1;
    const std::size_t below = static_cast<std::size_t>(last - first) * (middle - low) / (high - low + 1);
    Cut best{0, 0.5 * (lo[0] + hi[0])};
    double widest = -1.0;
    for (int a = 0; a < 3 && last - first > 1; ++a) {
      std::nth_element(first, first + below, last,
                       [&](std::uint32_t i, std::uint32_t j) { return x[3 * i + a] < x[3 * j + a]; });
      const double at = x[3 * first[below] + a], narrow = std::min(at - lo[a], hi[a] - at);
      if (narrow <= widest) continue;
      widest = narrow;
      best = {a, at};
    }
    cut_[middle] = best;
    std::uint32_t *const cut =
        std::partition(first, last, [&](std::uint32_t i) { return x[3 * i + best.axis] < best.at; });
    Point upper = hi, lower = lo;
    upper[best.axis] = lower[best.axis] = best.at;
    split(x, first, cut, low, middle - 1, lo, upper);
    split(x, cut, last, middle, high, lower, hi);
  }
  int within(int low, int high, const double *point, double reach) const
  {
    if (low == high) return 1;
    const int middle = low + (high - low) / 2 + 1;
    const Cut &cut = cut_[middle];
    int found = 0;
    if (point[cut.axis] - reach < cut.at) found += within(low, middle - 1, point, reach);
    if (point[cut.axis] + reach > cut.at) found += within(middle, high, point, reach);
    return found;
  }
  int ranks_;
  std::vector<Cut> cut_;
};

}  // namespace bench
