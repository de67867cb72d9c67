// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a finished slice grid says: bounds, tree, owner of a point.
#include "gpudem/slice_grid.h"

#include <algorithm>

namespace gpudem {
namespace {

/// The part of a level that holds a rank.
int partOf(const SliceLevel &level, int rank)
{
  return static_cast<int>(std::upper_bound(level.firstRank.begin(), level.firstRank.end(), rank) -
                          level.firstRank.begin()) -
         1;
}

}  // namespace

std::array<double, 2> SliceGrid::bounds(int rank, int axis) const
{
  int group = 0;
  for (const SliceLevel &level : levels) {
    const int part = partOf(level, rank);
    if (level.axis == axis) {
      const bool last = part + 1 == level.groupStart[group + 1];
      return {level.lower[part], last ? 1.0 : level.lower[part + 1]};
    }
    group = part;
  }
  return {0.0, 1.0};
}

TreeCut SliceGrid::treeCut(int rank) const
{
  if (rank == 0) return {};
  // the cut lies between this rank and the one before it; the first level that separates them holds it
  for (const SliceLevel &level : levels) {
    const int part = partOf(level, rank);
    if (level.firstRank[part] == rank) return {level.axis, level.lower[part]};
  }
  return {};
}

int SliceGrid::rankOf(const double *fraction) const
{
  int group = 0;
  for (const SliceLevel &level : levels) {
    const auto first = level.lower.begin() + level.groupStart[group] + 1;
    const auto last = level.lower.begin() + level.groupStart[group + 1];
    group = level.groupStart[group] + static_cast<int>(std::upper_bound(first, last, fraction[level.axis]) - first);
  }
  return group;
}

}  // namespace gpudem
