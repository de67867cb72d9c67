// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Distributions of particles to be divided, and slow but plain readings of a slice grid.
#pragma once

#include "gpudem/slice_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace gpudem::testing {

enum class Spread { Uniform, Clusters, Corner, Layer, Lattice };
constexpr Spread allSpreads[] = {Spread::Uniform, Spread::Clusters, Spread::Corner, Spread::Layer, Spread::Lattice};

/// Positions in the unit box, [count][3].
inline std::vector<double> spread(Spread kind, int count, std::mt19937 &random)
{
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::normal_distribution<double> near(0.0, 0.03);
  std::vector<double> x(3 * count);
  std::array<std::array<double, 3>, 4> centres{};
  for (auto &c : centres)
    for (double &v : c) v = 0.2 + 0.6 * any(random);  // whole clusters in the box
  for (int i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a) {
      double v = any(random);
      if (kind == Spread::Clusters) v = centres[i % 4][a] + near(random);
      if (kind == Spread::Corner) v = 1e-3 * v;
      if (kind == Spread::Layer && a == 2) v = 1e-6 * v;
      if (kind == Spread::Lattice) v = 0.05 * std::floor(20.0 * v);  // many share each coordinate
      x[3 * i + a] = std::clamp(v, 0.0, std::nextafter(1.0, 0.0));
    }
  return x;
}

/// Whether many particles share a coordinate, so that no cut divides them.
inline bool indivisible(Spread kind)
{
  return kind == Spread::Lattice;
}

/// Particles spread over several holders, as they are over ranks: each counts its own, and the counts add up.
class ScatteredParticles : public SliceParticles {
 public:
  ScatteredParticles(int holders, const std::vector<double> &position, const std::vector<double> &weight,
                     std::mt19937 &random)
      : position_(holders), weight_(holders)
  {
    for (std::size_t i = 0; i < position.size() / 3; ++i) {
      const std::size_t h = random() % holders;
      position_[h].insert(position_[h].end(), position.begin() + 3 * i, position.begin() + 3 * i + 3);
      if (!weight.empty()) weight_[h].push_back(weight[i]);
    }
    const double origin[3] = {0, 0, 0}, length[3] = {1, 1, 1};
    for (int h = 0; h < holders; ++h)
      parts_.emplace_back(position_[h].size() / 3, position_[h].data(), weight.empty() ? nullptr : weight_[h].data(),
                          origin, length);
  }
  void countExponents(double *counts) const override
  {
    for (const auto &p : parts_) p.countExponents(counts);
  }
  void begin(double unit) override
  {
    for (auto &p : parts_) p.begin(unit);
  }
  void count(int axis, const SliceBins &bins, double *weights) const override
  {
    for (const auto &p : parts_) p.count(axis, bins, weights);
  }
  void descend(const SliceLevel &level) override
  {
    for (auto &p : parts_) p.descend(level);
  }

 private:
  std::vector<std::vector<double>> position_, weight_;
  std::vector<HostSliceParticles> parts_;
};

inline SliceReport balanced(SliceGrid &grid, const std::vector<double> &position, const std::vector<double> &weight,
                            const SliceOptions &options, int holders = 1, unsigned seed = 1)
{
  std::mt19937 random(seed);
  ScatteredParticles particles(holders, position, weight, random);
  return balanceSlices(grid, particles, options, [](double *, int) {});
}

/// Weight on each rank, one particle after the other.
inline std::vector<double> loads(const SliceGrid &grid, const std::vector<double> &position,
                                 const std::vector<double> &weight)
{
  std::vector<double> load(grid.ranks, 0.0);
  for (std::size_t i = 0; i < position.size() / 3; ++i)
    load[grid.rankOf(&position[3 * i])] += weight.empty() ? 1.0 : weight[i];
  return load;
}

/// The rank at the end of a walk down the tree that halves the range of ranks, as LAMMPS' tiled layout walks it.
inline int rankByTree(const SliceGrid &grid, const double *point)
{
  int low = 0, high = grid.ranks - 1;
  while (low < high) {
    const int middle = low + (high - low) / 2 + 1;
    const TreeCut cut = grid.treeCut(middle);
    if (point[cut.axis] < cut.fraction) high = middle - 1;
    else low = middle;
  }
  return low;
}

/// The ranks whose bounds hold a point of the box.
inline std::vector<int> ranksAround(const SliceGrid &grid, const double *point)
{
  std::vector<int> found;
  for (int r = 0; r < grid.ranks; ++r) {
    bool inside = true;
    for (int a = 0; a < 3; ++a) {
      const auto b = grid.bounds(r, a);
      inside = inside && point[a] >= b[0] && point[a] < b[1];
    }
    if (inside) found.push_back(r);
  }
  return found;
}

}  // namespace gpudem::testing
