// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Uniform cells in 4x4x4 blocks, so that cells close in space are close in memory.
#pragma once

#include "base/particle.hpp"

namespace gpudem {

struct CellGrid {
  Vec3<double> lo;                ///< corner of cell (0,0,0) (distance)
  Vec3<double> size;              ///< edge of a cell (distance)
  Vec3<double> inverse;           ///< 1/size
  int nx, ny, nz;                 ///< cells with grains
  int blocksX, blocksY, blocksZ;  ///< ceil(n/4)
  bool wrapX, wrapY, wrapZ;       ///< periodic

  GPUDEM_HD std::uint32_t cells() const { return static_cast<std::uint32_t>(blocksX) * blocksY * blocksZ * 64u; }
  GPUDEM_HD std::uint32_t index(int cx, int cy, int cz) const
  {
    const std::uint32_t block = (static_cast<std::uint32_t>(cz >> 2) * blocksY + (cy >> 2)) * blocksX + (cx >> 2);
    return block * 64u + static_cast<std::uint32_t>(((cz & 3) * 4 + (cy & 3)) * 4 + (cx & 3));
  }
  GPUDEM_HD Vec3<int> coordinates(std::uint32_t cell) const
  {
    const std::uint32_t block = cell >> 6;
    const int inner = static_cast<int>(cell & 63u);
    const int bx = static_cast<int>(block % blocksX);
    const std::uint32_t rest = block / blocksX;
    const int by = static_cast<int>(rest % blocksY), bz = static_cast<int>(rest / blocksY);
    return {bx * 4 + (inner & 3), by * 4 + ((inner >> 2) & 3), bz * 4 + (inner >> 4)};
  }
  GPUDEM_HD Vec3<double> centre(std::uint32_t cell) const
  {
    const Vec3<int> c = coordinates(cell);
    return {lo.x + (c.x + 0.5) * size.x, lo.y + (c.y + 0.5) * size.y, lo.z + (c.z + 0.5) * size.z};
  }
  GPUDEM_HD static int locate(double x, double lo, double inverse, int n)
  {
    const double c = floor((x - lo) * inverse);
    return c <= 0 ? 0 : c >= n - 1 ? n - 1 : static_cast<int>(c);
  }
  GPUDEM_HD std::uint32_t cellOf(const Vec3<double> &x) const
  {
    return index(locate(x.x, lo.x, inverse.x, nx), locate(x.y, lo.y, inverse.y, ny), locate(x.z, lo.z, inverse.z, nz));
  }
};

/// Absolute position of a grain that sits in or near \p cell (distance).
GPUDEM_HD Vec3<double> absolutePosition(const FixedPosition &p, std::uint32_t cell, const CellGrid &grid,
                                        const Frame &frame)
{
  const Vec3<double> c = grid.centre(cell);
  return {toAbsolute(p.x, c.x, frame.origin.x, frame.inverse.x, frame.unit64.x),
          toAbsolute(p.y, c.y, frame.origin.y, frame.inverse.y, frame.unit64.y),
          toAbsolute(p.z, c.z, frame.origin.z, frame.inverse.z, frame.unit64.z)};
}

/// Which neighbouring cells along one axis: [first, last] offsets, each distinct cell once.
GPUDEM_HD void neighbourRange(int n, bool wrap, int c, int &first, int &last)
{
  first = -1;
  last = 1;
  if (wrap) {
    if (n == 1) first = last = 0;
    if (n == 2) first = 0;  // c and its only other cell
  } else {
    if (c == 0) first = 0;
    if (c == n - 1) last = 0;
  }
}
GPUDEM_HD int wrapCell(int c, int n)
{
  return c < 0 ? c + n : c >= n ? c - n : c;
}

/// Call visit(cell) for \p cell and each distinct cell around it.
template <class Visit>
GPUDEM_HD void forEachCellAround(const CellGrid &grid, std::uint32_t cell, Visit &&visit)
{
  const Vec3<int> c = grid.coordinates(cell);
  int x0, x1, y0, y1, z0, z1;
  neighbourRange(grid.nx, grid.wrapX, c.x, x0, x1);
  neighbourRange(grid.ny, grid.wrapY, c.y, y0, y1);
  neighbourRange(grid.nz, grid.wrapZ, c.z, z0, z1);
  for (int oz = z0; oz <= z1; ++oz)
    for (int oy = y0; oy <= y1; ++oy)
      for (int ox = x0; ox <= x1; ++ox)
        visit(grid.index(wrapCell(c.x + ox, grid.nx), wrapCell(c.y + oy, grid.ny), wrapCell(c.z + oz, grid.nz)));
}

}  // namespace gpudem
