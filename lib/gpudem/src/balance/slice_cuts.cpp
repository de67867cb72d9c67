// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "balance/slice_cuts.h"

#include <algorithm>
#include <cmath>

namespace gpudem {
namespace {

/// Bounds closer than this are one place: many particles may share a coordinate, and no cut divides them.
constexpr double onePlace = 1e-13;  // fraction of the box
/// A group with few cuts gets at least this many bins, since a round costs a sum over all ranks.
constexpr int binsOfGroup = 256;

/// The nearest places (least squares) that keep the distance \p smallest from each other and from 0 and 1.
void keepApart(std::vector<double> &at, double smallest)
{
  const int n = static_cast<int>(at.size());
  bool apart = true;
  for (int i = 0; i <= n; ++i) apart = apart && (i < n ? at[i] : 1.0) - (i > 0 ? at[i - 1] : 0.0) >= smallest;
  if (apart) return;
  // less i times the distance, places need only be in order: pool neighbours that are not, and take their mean
  struct Pool {
    double sum;
    int count;
    double mean() const { return sum / count; }
  };
  std::vector<Pool> pools;
  for (int i = 0; i < n; ++i) {
    pools.push_back({at[i] - (i + 1) * smallest, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  int i = 0;
  const double most = std::max(0.0, 1.0 - (n + 1) * smallest);
  for (const Pool &pool : pools)
    for (int k = 0; k < pool.count; ++k, ++i) at[i] = std::clamp(pool.mean(), 0.0, most) + (i + 1) * smallest;
}

}  // namespace

CutSearch::CutSearch(const SliceLevel &level, const SliceOptions &options, double tolerance, double particle)
    : options_(options), tolerance_(tolerance), particle_(particle)
{
  groupStart_.push_back(0);
  for (int g = 0; g < level.groups(); ++g) {
    const int first = level.groupStart[g], last = level.groupStart[g + 1];
    const int ranks = level.firstRank[last] - level.firstRank[first];
    ranks_.push_back(ranks);
    for (int k = first + 1; k < last; ++k) {
      Cut cut{};
      cut.old = cut.at = level.lower[k];
      cut.low = std::max(0.0, cut.old - options.farthest[level.axis]);
      cut.high = std::min(1.0, cut.old + options.farthest[level.axis]);
      if (options.betweenNeighbors) {
        cut.low = std::max(cut.low, level.lower[k - 1]);
        cut.high = std::min(cut.high, k + 1 < last ? level.lower[k + 1] : 1.0);
      }
      cuts_.push_back(cut);
      share_.push_back(static_cast<double>(level.firstRank[k] - level.firstRank[first]) / ranks);
      fewest_.push_back(
          std::min(level.firstRank[k] - level.firstRank[k - 1], level.firstRank[k + 1] - level.firstRank[k]));
    }
    groupStart_.push_back(static_cast<int>(cuts_.size()));
  }
}

bool CutSearch::done() const
{
  return std::all_of(cuts_.begin(), cuts_.end(), [](const Cut &c) { return c.found; });
}

SliceBins CutSearch::bins(int perCut) const
{
  SliceBins bins;
  bins.segmentStart.push_back(0);
  bins.binStart.push_back(0);
  std::vector<double> points;
  std::vector<std::array<double, 2>> wanted;
  for (std::size_t g = 0; g + 1 < groupStart_.size(); ++g) {
    points = {0.0, 1.0};
    wanted.clear();
    for (int k = groupStart_[g]; k < groupStart_[g + 1]; ++k) {
      const Cut &cut = cuts_[k];
      if (cut.found) continue;
      points.insert(points.end(), {cut.low, cut.high});
      if (first_) points.push_back(cut.old);
      wanted.push_back({cut.low, cut.high});
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::sort(wanted.begin(), wanted.end());
    const int cuts = static_cast<int>(wanted.size());
    const int n = cuts ? std::max(perCut, binsOfGroup / cuts) : 1;
    double reach = 0.0;  // end of all intervals that begin at or before the point in work
    std::size_t next = 0;
    for (std::size_t p = 0; p + 1 < points.size(); ++p) {
      for (; next < wanted.size() && wanted[next][0] <= points[p]; ++next) reach = std::max(reach, wanted[next][1]);
      bins.segmentLower.push_back(points[p]);
      bins.segmentUpper.push_back(points[p + 1]);
      bins.binStart.push_back(bins.binStart.back() + (points[p] < reach ? n : 1));
    }
    bins.segmentStart.push_back(static_cast<int>(bins.segmentLower.size()));
  }
  return bins;
}

void CutSearch::tighten(const SliceBins &bins, const std::vector<double> &weights)
{
  std::vector<double> edges, below;
  for (std::size_t g = 0; g + 1 < groupStart_.size(); ++g) {
    if (groupStart_[g] == groupStart_[g + 1]) continue;
    edges.clear();
    below = {0.0};
    for (int s = bins.segmentStart[g]; s < bins.segmentStart[g + 1]; ++s)
      for (std::int64_t b = bins.binStart[s]; b < bins.binStart[s + 1]; ++b) {
        edges.push_back(bins.edge(s, b - bins.binStart[s]));
        below.push_back(below.back() + weights[b]);
      }
    edges.push_back(1.0);
    const double total = below.back();
    for (int k = groupStart_[g]; k < groupStart_[g + 1]; ++k) {
      Cut &cut = cuts_[k];
      if (cut.found) continue;
      if (total == 0.0) {  // nothing to divide: a cut that stays moves no rank's empty box about
        cut.found = true;
        continue;
      }
      cut.goal = share_[k] * total;
      cut.slack = std::max(tolerance_ * total * fewest_[k] / ranks_[g], 0.5 * particle_);
      place(cut, edges, below);
    }
  }
  first_ = false;
}

void CutSearch::place(Cut &cut, const std::vector<double> &edges, const std::vector<double> &below) const
{
  const auto index = [&](double x) { return std::lower_bound(edges.begin(), edges.end(), x) - edges.begin(); };
  if (first_ && std::abs(below[index(cut.old)] - cut.goal) <= cut.slack) {
    cut.found = true;
    return;
  }
  const auto low = index(cut.low), high = index(cut.high);
  // the last edge with at most the goal below it, and the one after it
  auto k = std::upper_bound(below.begin() + low, below.begin() + high + 1, cut.goal) - below.begin() - 1;
  if (k < low || k >= high) {  // the goal is beyond a limit of movement
    cut.at = k < low ? cut.low : cut.high;
    cut.found = true;
    return;
  }
  cut.low = edges[k];
  cut.high = edges[k + 1];
  const double missLow = cut.goal - below[k], missHigh = below[k + 1] - cut.goal;
  cut.at = missLow <= missHigh ? cut.low : cut.high;
  cut.found = std::min(missLow, missHigh) <= cut.slack || cut.high - cut.low <= onePlace;
}

int CutSearch::finish(SliceLevel &level, double smallest) const
{
  int moved = 0;
  std::vector<double> at;
  for (int g = 0; g < level.groups(); ++g) {
    at.clear();
    for (int k = groupStart_[g]; k < groupStart_[g + 1]; ++k) at.push_back(cuts_[k].at);
    keepApart(at, smallest);
    for (std::size_t k = 0; k < at.size(); ++k) {
      double &lower = level.lower[level.groupStart[g] + 1 + k];
      moved += lower != at[k];
      lower = at[k];
    }
  }
  return moved;
}

}  // namespace gpudem
