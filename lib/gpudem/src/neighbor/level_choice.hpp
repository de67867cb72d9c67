// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file How many levels, and which sizes belong to each. Host code.
#pragma once

#include "neighbor/layout.hpp"
#include "neighbor/levels.hpp"

#include <array>
#include <vector>

namespace gpudem {

/// Cells that a level may have: keys of 32 bits are shared by all levels.
constexpr double mostCells = 2147483648.0;

/// Ratio of the largest radii of successive levels that takes the least time: lanes of the CPU test candidates of one
/// cell at the cost of few, so that it wants fewer and wider levels (bench/search.cpp, doc/neighbor.md).
constexpr double levelRatioOnCpu = 3.0, levelRatioOnGpu = 2.0;

/// Largest radius of each level, ascending. Sizes are binned by their ratio to the largest one; empty bins are left
/// out, and a level's cells fit the largest grain in it.
/// \param levels wanted, 0: as many as the sizes need
/// \param ratio of the largest sizes of successive levels, for levels = 0; sizes no further apart make one level
inline std::vector<float> chooseLevels(const double *radius, std::size_t count, double largest, int levels, double ratio)
{
  double smallest = largest;
  for (std::size_t i = 0; i < count; ++i) smallest = std::min(smallest, radius[i]);
  const double spread = std::log(largest / smallest);
  double width = levels > 0 ? spread / levels : std::log(ratio);
  if (levels == 0) width = std::max(width, spread / maxLevels);
  std::array<double, maxLevels> most{};
  if (!(spread > width)) return {std::nextafter(static_cast<float>(largest), HUGE_VALF)};
  const int bins = levels > 0 ? std::min(levels, maxLevels) : maxLevels;
  for (std::size_t i = 0; i < count; ++i) {
    const int bin = std::clamp(static_cast<int>(std::log(largest / radius[i]) / width), 0, bins - 1);
    most[bin] = std::max(most[bin], radius[i]);
  }
  most[0] = largest;
  std::vector<float> chosen;
  for (int bin = maxLevels - 1; bin >= 0; --bin)
    if (most[bin] > 0.0) chosen.push_back(std::nextafter(static_cast<float>(most[bin]), HUGE_VALF));
  return chosen;
}

/// Cells of all levels in the box.
/// \param home cells of the largest grains; the only ones where there is one level
/// \param gap across which grains in contact still pull on each other (distance)
inline LevelGrid levelGrid(const Box &box, const std::vector<float> &largest, const CellGrid &home, double gap, double skin)
{
  LevelGrid g{};
  g.levels = static_cast<int>(largest.size());
  for (int l = 0; l < g.levels; ++l) {
    g.largest[l] = largest[l];
    g.grid[l] = g.levels == 1 ? home : chooseGrid(box, 2.0 * largest[l] + gap + skin, mostCells / g.levels);
    g.firstCell[l + 1] = g.firstCell[l] + g.grid[l].cells();
  }
  return g;
}

}  // namespace gpudem
