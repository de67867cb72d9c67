// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "balance/slice_cuts.h"
#include "gpudem/errors.h"
#include "gpudem/slice_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gpudem {
namespace {

/// A mean particle weighs about this many units: fine enough for any aim, and 10^12 of them sum up exactly.
constexpr int unitsBits = 10;
/// Sums go out in pieces, since a count of numbers is an int.
constexpr std::int64_t piece = std::int64_t{1} << 24;

void checkOptions(const SliceGrid &grid, const SliceOptions &o)
{
  if (!(o.aim >= 1.0)) throw Error(fmt::format("balancing to an imbalance of {}: it cannot be below 1", o.aim));
  if (o.bins < 2) throw Error(fmt::format("balancing with {} bins per cut: at least 2 are needed", o.bins));
  if (o.rounds < 1) throw Error(fmt::format("balancing with {} refinements: at least 1 is needed", o.rounds));
  for (const SliceLevel &level : grid.levels) {
    const double smallest = o.smallest[level.axis];
    if (!(smallest >= 0.0) || !(o.farthest[level.axis] >= 0.0))
      throw Error(fmt::format("balancing: least width {} and farthest move {} must not be negative", smallest,
                              o.farthest[level.axis]));
    for (int g = 0; g < level.groups(); ++g) {
      const int parts = level.groupStart[g + 1] - level.groupStart[g];
      if (parts > 1 && parts * smallest > 1.0 + 1e-9)
        throw Error(
            fmt::format("balancing: {} parts along {} do not fit into the box, each being at least {:.4g} of it", parts,
                        "xyz"[level.axis], smallest));
    }
  }
}

/// Sums over ranks, counting what they cost.
class Sums {
 public:
  Sums(const SumOverRanks &sum, SliceReport &report) : sum_(sum), report_(report) {}

  void operator()(std::vector<double> &values) const
  {
    const std::int64_t n = static_cast<std::int64_t>(values.size());
    for (std::int64_t k = 0; k < n; k += piece) sum_(values.data() + k, static_cast<int>(std::min(piece, n - k)));
    ++report_.rounds;
    report_.summed += n;
  }

 private:
  const SumOverRanks &sum_;
  SliceReport &report_;
};

/// The weight of one unit, a power of two, and what a mean particle weighs in units.
struct Unit {
  double unit = 0.0, particle = 1.0;
};
Unit chooseUnit(const SliceParticles &particles, const Sums &sum)
{
  std::vector<double> counts(SliceParticles::exponents);
  particles.countExponents(counts.data());
  sum(counts);
  // the mean weight, to a factor of two, from integers only: every rank must come to the same answer
  double weight = 0.0, number = counts[0];
  for (int e = 1; e < SliceParticles::exponents; ++e) {
    weight += std::ldexp(counts[e], e - 129);
    number += counts[e];
  }
  if (weight == 0.0) return {};
  return {std::ldexp(1.0, std::ilogb(weight / number) - unitsBits), std::ldexp(1.0, unitsBits)};
}

SliceBins binsOfParts(const SliceLevel &level)
{
  SliceBins bins;
  bins.segmentStart = level.groupStart;
  bins.binStart.push_back(0);
  for (int g = 0; g < level.groups(); ++g)
    for (int k = level.groupStart[g]; k < level.groupStart[g + 1]; ++k) {
      bins.segmentLower.push_back(level.lower[k]);
      bins.segmentUpper.push_back(k + 1 < level.groupStart[g + 1] ? level.lower[k + 1] : 1.0);
      bins.binStart.push_back(k + 1);
    }
  return bins;
}

}  // namespace

SliceReport balanceSlices(SliceGrid &grid, SliceParticles &particles, const SliceOptions &options,
                          const SumOverRanks &sumOverRanks)
{
  checkOptions(grid, options);
  SliceReport report;
  const Sums sum(sumOverRanks, report);
  const Unit unit = chooseUnit(particles, sum);
  if (unit.unit == 0.0) return report;
  particles.begin(unit.unit);

  // a part is off by what both of its cuts miss, at every level
  const double tolerance = 0.5 * std::min(options.aim - 1.0, 0.5) / static_cast<double>(grid.levels.size());
  std::vector<double> weights;
  for (SliceLevel &level : grid.levels) {
    CutSearch search(level, options, tolerance, unit.particle);
    for (int round = 0; round < options.rounds && !search.done(); ++round) {
      const SliceBins bins = search.bins(options.bins);
      weights.assign(bins.bins(), 0.0);
      particles.count(level.axis, bins, weights.data());
      sum(weights);
      search.tighten(bins, weights);
    }
    report.moved += search.finish(level, options.smallest[level.axis]);
    if (&level == &grid.levels.back()) {
      const SliceBins bins = binsOfParts(level);
      weights.assign(bins.bins(), 0.0);
      particles.count(level.axis, bins, weights.data());
      sum(weights);
    }
    particles.descend(level);
  }

  double total = 0.0, most = 0.0;
  for (double w : weights) {
    total += w;
    most = std::max(most, w);
  }
  report.heaviest = most * unit.unit;
  if (total > 0.0) report.imbalance = most * grid.ranks / total;
  return report;
}

}  // namespace gpudem
