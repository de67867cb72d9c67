// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Slice grid: slabs along one axis, then independent cuts inside each slab, placed so that all ranks carry equal weight.
///
/// Coordinates are fractions of the box, 0 to 1. No MPI here: sums over ranks come in as a function. Every number that is
/// summed is an integer held in a double, so sums are exact, and every rank finds the same cuts whatever the order of the sum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gpudem {

/// One level of the grid: each group of ranks (the whole box at level 0, a part of the level above below it) is cut into
/// parts along one axis. Parts are numbered through all groups, in the order of their ranks.
struct SliceLevel {
  int axis = 0;                 // 0, 1 or 2
  std::vector<int> groupStart;  // [groups + 1], first part of each group
  std::vector<int> firstRank;   // [parts + 1], part k holds the ranks firstRank[k] to firstRank[k + 1] - 1
  std::vector<double> lower;    // [parts], where the part begins along the axis, fraction of the box; 0 for the first of a group

  int groups() const { return static_cast<int>(groupStart.size()) - 1; }
  int parts() const { return static_cast<int>(lower.size()); }
};

/// The cut that a rank owns in the tree that halves the range of ranks.
struct TreeCut {
  int axis = -1;          // -1 for rank 0, which owns none
  double fraction = 0.0;  // where, fraction of the box
};

/// Sub-domains of all ranks. Each part is a node of the binary tree that halves the range of ranks (the lower half takes
/// the odd one), so that tree, whose node is a rank, an axis and a position, represents the grid for any number of ranks.
struct SliceGrid {
  int ranks = 1;
  std::vector<SliceLevel> levels;  // slabs first; parts of the last level hold one rank each

  /// Bounds of a rank along an axis: {lower, upper}, fractions of the box.
  std::array<double, 2> bounds(int rank, int axis) const;
  /// The node of the tree that a rank owns.
  TreeCut treeCut(int rank) const;
  /// The rank whose sub-domain holds a point; a point on a cut belongs to the upper side, one outside to the nearest part.
  int rankOf(const double *fraction) const;
};

/// What a slice grid should look like.
struct SliceRequest {
  int ranks = 1;
  int levels = 2;                                 // 1, 2 or 3
  int dimension = 3;                              // 2: no cuts along z
  std::string axes = "auto";                      // slab axis first, such as "xz"; auto: least surface between ranks
  std::array<double, 3> extent = {1, 1, 1};       // of the region to be divided, distance: decides number and axis of the slabs
  std::array<double, 3> smallest = {0, 0, 0};     // least width of a part along each axis, fraction of the box
};

/// Number of slabs, columns and cells for the least surface between ranks, with cuts that give equal volumes.
/// Throws Error: no ranks, levels or axes that do not exist or fit each other, a box too small for the ranks.
SliceGrid makeSliceGrid(const SliceRequest &request);

/// Surface between ranks that the numbers of parts of \p grid would give in a uniform region of this extent, distance^2.
double sliceSurface(const SliceGrid &grid, const std::array<double, 3> &extent);

/// Bins of a histogram: the range of each group is divided into segments, each of them into equal bins.
struct SliceBins {
  std::vector<int> segmentStart;      // [groups + 1], first segment of each group
  std::vector<double> segmentLower;   // [segments], fraction of the box
  std::vector<double> segmentUpper;   // [segments]
  std::vector<std::int64_t> binStart;  // [segments + 1], first bin of each segment

  std::int64_t bins() const { return binStart.back(); }
  /// Lower edge of bin k of a segment, 0 <= k <= its number of bins; rounded the same wherever it is computed.
  double edge(int segment, std::int64_t k) const
  {
    const std::int64_t n = binStart[segment + 1] - binStart[segment];
    if (k == 0) return segmentLower[segment];
    if (k == n) return segmentUpper[segment];
    return segmentLower[segment] +
           (segmentUpper[segment] - segmentLower[segment]) * (static_cast<double>(k) / static_cast<double>(n));
  }
};

/// The particles of one rank, wherever they live. Each belongs to a group of the level in work.
class SliceParticles {
 public:
  static constexpr int exponents = 256;  // classes of weight, see countExponents()

  virtual ~SliceParticles() = default;
  /// Adds to counts[e] the particles whose weight w has 2^(e-129) <= w < 2^(e-128) (e = 1 ... 255, the ends taking what
  /// is beyond them), and to counts[0] those of weight zero. Throws Error if a weight is negative or not a number.
  virtual void countExponents(double *counts) const = 0;
  /// All particles return to group 0; weights are counted in multiples of \p unit from now on, rounded.
  virtual void begin(double unit) = 0;
  /// Adds to weights[bin] the weight of the particles in each bin, in units. A particle on an edge is in the bin above it.
  virtual void count(int axis, const SliceBins &bins, double *weights) const = 0;
  /// The group of each particle becomes the part it is in.
  virtual void descend(const SliceLevel &level) = 0;
};

/// Particles in host arrays, which must outlive this object.
class HostSliceParticles : public SliceParticles {
 public:
  /// \param count     number of particles
  /// \param position  [count][3], distance
  /// \param weight    [count], not negative, or null: each weighs one
  /// \param origin    lower corner of the box, distance
  /// \param length    edges of the box, distance
  HostSliceParticles(std::size_t count, const double *position, const double *weight, const double *origin,
                     const double *length);

  void countExponents(double *counts) const override;
  void begin(double unit) override;
  void count(int axis, const SliceBins &bins, double *weights) const override;
  void descend(const SliceLevel &level) override;
  /// [count] the part of the level last descended to: after balanceSlices() the rank of each particle.
  const std::vector<int> &group() const { return group_; }

 private:
  const double *position_, *weight_;
  std::array<double, 3> origin_, inverse_;
  std::vector<int> group_;
  std::vector<double> units_;  // [count] integer weights, empty if all are alike
  double alike_ = 1.0;         // then each weighs this
};

/// How cuts are placed.
struct SliceOptions {
  double aim = 1.01;                           // cuts are refined until the imbalance is at most this; at least 1
  int bins = 16;                               // per cut and refinement, at least 2
  int rounds = 16;                             // refinements of a level at most
  std::array<double, 3> smallest = {0, 0, 0};  // least width of a part along each axis, fraction of the box
  std::array<double, 3> farthest = {2, 2, 2};  // a cut moves at most this far, fraction of the box
  bool betweenNeighbors = false;               // a cut stays between its old neighbours in its group
};

struct SliceReport {
  double imbalance = 1.0;   // largest weight of a rank over the mean weight; 1 if there is no weight
  double heaviest = 0.0;    // largest weight of a rank
  int rounds = 0;           // histograms counted and summed
  std::int64_t summed = 0;  // numbers summed over the ranks in all
  int moved = 0;            // cuts that changed
};

/// Sum n numbers over all ranks, in place, the result on every rank.
using SumOverRanks = std::function<void(double *values, int n)>;

/// Move the cuts of \p grid so that ranks carry equal weight. Collective. A cut that is good enough stays where it is, so that
/// particles do not change rank for nothing. Least widths come before limits of movement, and both before balance.
/// Without any weight nothing moves. Throws Error for options out of range and for a box too small for the ranks.
SliceReport balanceSlices(SliceGrid &grid, SliceParticles &particles, const SliceOptions &options, const SumOverRanks &sum);

}  // namespace gpudem
