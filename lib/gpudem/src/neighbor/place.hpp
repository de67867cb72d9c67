// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Placing grains before the rows are built: wrap into the box, cell keys, extents, anchors.
#pragma once

#include "neighbor/levels.hpp"
#include "step/step_view.hpp"
#include "wall/analytic_wall.hpp"

namespace gpudem {

struct BoxView {
  Vec3<double> lo, hi;
  bool periodic[3];
};

/// \p distance the shorter way round.
/// \param period of the axis, 0 if it has none
GPUDEM_HD double shorterWay(double distance, double period)
{
  return period > 0.0 ? distance - period * floor(distance / period + 0.5) : distance;
}

/// LAMMPS' packed image flags, 10 bits each (imageint of 32 bits).
GPUDEM_HD int shiftImage(int image, int d, int by)
{
  const int low = 10 * d;
  const int flag = (image >> low) & 1023;
  return (image & ~(1023 << low)) | (((flag + by) & 1023) << low);
}

/// New cells of each grain, and its image flags wrapped. Fixed-point positions need no change.
template <class P>
struct PlaceGrains {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  PositionArrays<P> position;
  const std::uint32_t *cell;
  CellGrid oldGrid;
  LevelGrid levels;
  CellGrid newGrid;
  Frame frame;
  BoxView box;
  int *image;
  std::uint32_t *key;   ///< cells to search in, numbered through the levels
  std::uint32_t *home;  ///< cells of newGrid, null where they are the same

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    Vec3<double> x = absolutePosition(loadPosition(position, i), cell[i], oldGrid, frame);
    for (int d = 0; d < 3; ++d) {
      if (!box.periodic[d]) continue;
      const double length = box.hi[d] - box.lo[d];
      const int crossed = static_cast<int>(floor((x[d] - box.lo[d]) / length));
      if (crossed == 0) continue;
      x[d] -= crossed * length;
      image[i] = shiftImage(image[i], d, crossed);
    }
    key[i] = levels.cellOf(x, position.coarse[i].radius);
    if (home) home[i] = newGrid.cellOf(x);
  }
};

/// Positions from one choice of windows to another.
template <class P>
struct ReframeGrains {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  PositionArrays<P> position;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame from, to;

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    FixedPosition p = loadPosition(position, i);
    setCoordinates(p, absolutePosition(p, cell[i], grid, from), to);
    storePosition(position, i, p, position.motion[i].word);
  }
};

struct ExtentSum {
  double lo[3], hi[3];
  long long outside;
};
struct JoinExtents {
  GPUDEM_HD ExtentSum operator()(const ExtentSum &a, const ExtentSum &b) const
  {
    ExtentSum r;
    for (int d = 0; d < 3; ++d) {
      r.lo[d] = a.lo[d] < b.lo[d] ? a.lo[d] : b.lo[d];
      r.hi[d] = a.hi[d] > b.hi[d] ? a.hi[d] : b.hi[d];
    }
    r.outside = a.outside + b.outside;
    return r;
  }
};
template <class P>
struct GrainExtent {
  PositionArrays<P> position;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  BoxView box;
  bool seen;            ///< coordinates of periodic directions are the nearest to the middle
  Vec3<double> middle;  ///< (distance)
  GPUDEM_HD ExtentSum operator()(std::uint32_t i) const
  {
    Vec3<double> x = absolutePosition(loadPosition(position, i), cell[i], grid, frame);
    for (int d = 0; d < 3; ++d)
      if (seen && box.periodic[d]) x[d] = middle[d] + shorterWay(x[d] - middle[d], box.hi[d] - box.lo[d]);
    ExtentSum r{{x.x, x.y, x.z}, {x.x, x.y, x.z}, 0};
    for (int d = 0; d < 3; ++d)
      if (!box.periodic[d] && !(x[d] >= box.lo[d] && x[d] < box.hi[d])) r.outside = 1;
    return r;
  }
};

/// First and one-past-last grain of each occupied cell, from sorted keys.
struct CellRanges {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *key;
  std::uint32_t count;
  std::uint32_t *first, *end;  ///< [cells], zero where the cell is empty
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    if (i == 0 || key[i - 1] != key[i]) first[key[i]] = i;
    if (i + 1 == count || key[i + 1] != key[i]) end[key[i]] = i + 1;
  }
};

template <class T>
struct Gather {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *from;
  const T *in;
  T *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] = in[from[i]]; }
};

template <class T>
struct CopyValues {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const T *in;
  T *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] = in[i]; }
};

/// Gather for blocks of \p size numbers per grain: number k of all grains from \p first on.
template <class T>
struct GatherBlocks {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t size, first;
  const std::uint32_t *from;
  const std::uint32_t *keeps;  ///< [n] in the old order: 0 if all numbers are zero; null: any may be something
  const T *in;
  T *out;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const std::uint32_t i = first + k / size, old = from[i], d = k % size;
    const bool some = !keeps || keeps[old] != 0u;
    out[static_cast<std::size_t>(size) * i + d] = some ? in[static_cast<std::size_t>(size) * old + d] : T(0);
  }
};

struct FillOnes {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] = 1u; }
};

/// Quantised position and near-wall bit; springs of walls out of reach are forgotten.
template <class P>
struct SetAnchors {
  using Real = typename P::Real;
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  PositionArrays<P> position;
  const Motion<Real> *motion;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  AnchorRule rule;
  double room;  ///< how far a grain may move until the next rebuild (distance)
  int walls;
  WallView<Real> wall[maxWalls];
  double wallLoReach[maxWalls], wallHiReach[maxWalls];  ///< how far a wiggling plane moves up and down
  double wallPull[maxWalls];                            ///< gap across which the wall still pulls on a grain (distance)
  std::uint32_t *anchor;

  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const CoarsePosition c = position.coarse[i];
    std::uint32_t a =
        ((c.x >> rule.shiftX) & 1023u) | ((c.y >> rule.shiftY) & 1023u) << 10 | ((c.z >> rule.shiftZ) & 1023u) << 20;
    if (walls > 0) {
      const FixedPosition p = loadPosition(position, i);
      const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
      const std::uint32_t roles = motion[i].word;
      for (int w = 0; w < walls; ++w) {
        if ((roles & wall[w].role) && within(w, x, p.radius + wallPull[w] + room)) a |= nearWallBit;
      }
      if (!(a & nearWallBit))
        for (int w = 0; w < walls; ++w)
          for (int d = 0; wall[w].history && d < wall[w].historySize; ++d)
            wall[w].history[static_cast<std::size_t>(wall[w].historySize) * i + d] = Real(0);
    }
    anchor[i] = a;
  }

 private:
  GPUDEM_HD bool within(int w, const Vec3<double> &x, double reach) const
  {
    const WallView<Real> &v = wall[w];
    if (v.shape == WallShape::Cylinder) {
      const double rho = squareRoot(x.x * x.x + x.y * x.y);
      return absolute(v.radius - rho) <= reach;
    }
    const double z = x[v.axis];
    const bool nearLo = z - (v.lo + wallHiReach[w]) <= reach && (v.lo + wallLoReach[w]) - z <= reach;
    const bool nearHi = (v.hi + wallLoReach[w]) - z <= reach && z - (v.hi + wallHiReach[w]) <= reach;
    return nearLo || nearHi;
  }
};

}  // namespace gpudem
