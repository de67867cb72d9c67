// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Levels of grains by size, each with cells of its own: a search costs what the grains of similar size cost.
///
/// A grain of level l has a radius in (largest[l-1], largest[l]] and lies in a cell of grid l, whose edge is the reach
/// between the largest grains of that level. Partners of its own level are in the cells around; partners of a coarser
/// level L in the cells of grid L that meet its own cell grown by the reach between the levels. Who is of a finer
/// level is never searched for: the finer grain finds the coarser one (cross_levels.hpp). The scheme is the
/// hierarchical grid of Iwai, Hong and Greil, Int. J. Mod. Phys. C 10 (1999) 823, with the levels of Krijgsman, Ogarko
/// and Luding, Comput. Part. Mech. 1 (2014) 357.
#pragma once

#include "gpudem/scene.h"
#include "neighbor/cell_grid.hpp"

namespace gpudem {

constexpr int maxLevels = mostLevels;

struct LevelGrid {
  int levels;
  float largest[maxLevels];                ///< radius (distance), ascending
  CellGrid grid[maxLevels];
  std::uint32_t firstCell[maxLevels + 1];  ///< cells of all levels are numbered one level after the other

  GPUDEM_HD std::uint32_t cells() const { return firstCell[levels]; }
  GPUDEM_HD int levelOfRadius(float radius) const
  {
    int l = 0;
    while (l + 1 < levels && radius > largest[l]) ++l;
    return l;
  }
  GPUDEM_HD int levelOfCell(std::uint32_t cell) const
  {
    int l = 0;
    while (l + 1 < levels && cell >= firstCell[l + 1]) ++l;
    return l;
  }
  GPUDEM_HD std::uint32_t cellOf(const Vec3<double> &x, float radius) const
  {
    const int l = levelOfRadius(radius);
    return firstCell[l] + grid[l].cellOf(x);
  }
};

/// Call visit(cell) for \p cell and each distinct cell of its level around it.
template <class Visit>
GPUDEM_HD void forEachOwnCell(const LevelGrid &levels, std::uint32_t cell, Visit &&visit)
{
  const int l = levels.levelOfCell(cell);
  const std::uint32_t first = levels.firstCell[l];
  forEachCellAround(levels.grid[l], cell - first, [&](std::uint32_t c) { visit(first + c); });
}

/// Cells [first, last] of a coarser axis that meet the \p cells from \p c of a finer one, grown by \p reach; a periodic
/// axis may give numbers beyond its ends, each cell once.
GPUDEM_HD void coarserRange(int n, double size, int c, int cells, int nCoarse, double inverseCoarse, bool wrap,
                            double reach, int &first, int &last)
{
  const int end = c + cells < n ? c + cells : n;
  const double lo = floor((c * size - reach) * inverseCoarse), hi = floor((end * size + reach) * inverseCoarse);
  if (wrap) {
    const bool all = hi - lo + 1.0 >= nCoarse;
    first = all ? 0 : static_cast<int>(lo);
    last = all ? nCoarse - 1 : static_cast<int>(hi);
    return;
  }
  // the cells at the ends take the grains beyond them, too
  first = c == 0 || lo <= 0.0 ? 0 : lo >= nCoarse - 1 ? nCoarse - 1 : static_cast<int>(lo);
  last = end == n || hi >= nCoarse - 1 ? nCoarse - 1 : hi <= 0.0 ? 0 : static_cast<int>(hi);
}

/// Call visit(cell) for each cell of level \p coarser within \p reach of the cube of \p cells per edge that begins at
/// cell \p c of level \p own.
template <class Visit>
GPUDEM_HD void forEachCoarserCell(const LevelGrid &levels, int own, const Vec3<int> &c, int cells, int coarser,
                                  double reach, Visit &&visit)
{
  const CellGrid &fine = levels.grid[own], &g = levels.grid[coarser];
  int x0, x1, y0, y1, z0, z1;
  coarserRange(fine.nx, fine.size.x, c.x, cells, g.nx, g.inverse.x, g.wrapX, reach, x0, x1);
  coarserRange(fine.ny, fine.size.y, c.y, cells, g.ny, g.inverse.y, g.wrapY, reach, y0, y1);
  coarserRange(fine.nz, fine.size.z, c.z, cells, g.nz, g.inverse.z, g.wrapZ, reach, z0, z1);
  for (int z = z0; z <= z1; ++z)
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        visit(levels.firstCell[coarser] + g.index(wrapCell(x, g.nx), wrapCell(y, g.ny), wrapCell(z, g.nz)));
}
/// The same for one cell, numbered through the levels.
template <class Visit>
GPUDEM_HD void forEachCoarserCell(const LevelGrid &levels, std::uint32_t cell, int coarser, double reach, Visit &&visit)
{
  const int own = levels.levelOfCell(cell);
  forEachCoarserCell(levels, own, levels.grid[own].coordinates(cell - levels.firstCell[own]), 1, coarser, reach, visit);
}

}  // namespace gpudem
