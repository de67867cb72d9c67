// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Choosing cells, windows and anchors from the box, the reach and the skin. Host code.
#pragma once

#include "neighbor/cell_grid.hpp"
#include "step/step_view.hpp"
#include "gpudem/engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gpudem {

/// Largest distance at which two grains are listed (distance).
/// \param pullOffGap gap across which grains in contact still pull on each other (distance)
inline double reachOf(const SceneSpec &scene, double pullOffGap, double skin)
{
  return 2.0 * scene.largestRadius + pullOffGap + skin;
}

/// Cells of at least one reach, larger if there were more than \p most of them.
inline CellGrid chooseGrid(const Box &box, double reach, double most)
{
  if (!(reach > 0.0)) throw Error("the largest radius plus the skin must be positive");
  CellGrid g{};
  for (double edge = reach;; edge *= 1.25) {
    for (int d = 0; d < 3; ++d) {
      const double length = box.hi[d] - box.lo[d];
      int n = 1;
      double size = std::max(length, reach);
      if (!(d == 2 && box.dimension == 2)) {
        if (box.periodic[d]) {
          n = std::max(1, static_cast<int>(std::min(2.0e9, std::floor(length / edge))));
          size = length / n;
        } else {
          n = std::max(1, static_cast<int>(std::min(2.0e9, std::ceil(length / edge))));
          size = edge;
        }
      }
      g.lo[d] = box.lo[d];
      g.size[d] = size;
      g.inverse[d] = 1.0 / size;
      (d == 0 ? g.nx : d == 1 ? g.ny : g.nz) = n;
      (d == 0 ? g.blocksX : d == 1 ? g.blocksY : g.blocksZ) = (n + 3) / 4;
      (d == 0 ? g.wrapX : d == 1 ? g.wrapY : g.wrapZ) = box.periodic[d] && !(d == 2 && box.dimension == 2);
    }
    const double cells = 64.0 * g.blocksX * g.blocksY * g.blocksZ;
    if (cells <= most) return g;
    if (edge > 1.0e6 * reach) throw Error(fmt::format("no cell grid of fewer than {:.0f} cells fits the box", most));
  }
}

/// Windows of at least eight cells; in a periodic direction the box is a whole number of them.
inline Frame chooseFrame(const Box &box, const CellGrid &grid)
{
  Frame f{};
  for (int d = 0; d < 3; ++d) {
    const bool wrap = d == 0 ? grid.wrapX : d == 1 ? grid.wrapY : grid.wrapZ;
    const int n = d == 0 ? grid.nx : d == 1 ? grid.ny : grid.nz;
    const double window = wrap ? (box.hi[d] - box.lo[d]) / std::max(1, n / 8) : 8.0 * grid.size[d];
    f.origin[d] = box.lo[d];
    f.window[d] = window;
    f.inverse[d] = 1.0 / window;
    f.unit32[d] = window / 4294967296.0;
    f.unit64[d] = window / 18446744073709551616.0;
  }
  return f;
}

/// Do the windows tell all candidates of a search apart? They are at most six cells away (cross_search.hpp: a block of four
/// finer cells, the reach and a cell), and may not seem closer than a reach when a window is taken off.
inline bool spansSearch(const Frame &frame, const Box &box, const CellGrid &grid)
{
  for (int d = 0; d < 3; ++d) {
    const bool wrap = d == 0 ? grid.wrapX : d == 1 ? grid.wrapY : grid.wrapZ;
    if (wrap && frame.window[d] > 0.99 * (box.hi[d] - box.lo[d])) continue;  // the whole box: distances are the least ones
    if (frame.window[d] < 7.0 * grid.size[d]) return false;
  }
  return true;
}

/// What a coarse test adds to a sum of radii so that it misses no contact: coordinates cut to 32 bits (distance).
inline float reachSlackOf(const Frame &frame)
{
  return static_cast<float>(4.0 * std::max(frame.unit32.x, std::max(frame.unit32.y, frame.unit32.z)));
}

/// Anchors whose quantum is a 64th to a 128th of the skin.
inline AnchorRule chooseAnchors(const Frame &frame, double skin)
{
  AnchorRule r{};
  double diagonal2 = 0.0, smallest = frame.window.x;
  for (int d = 0; d < 3; ++d) {
    const double quanta = skin / 64.0 / frame.unit32[d];
    const int shift = quanta >= 1.0 ? std::min(22, static_cast<int>(std::floor(std::log2(quanta)))) : 0;
    (d == 0 ? r.shiftX : d == 1 ? r.shiftY : r.shiftZ) = shift;
    const double half = 0.5 * std::ldexp(frame.unit32[d], shift);
    diagonal2 += half * half;
    smallest = std::min(smallest, frame.window[d]);
  }
  const double limit = 0.5 * skin - std::sqrt(diagonal2);
  r.limit2 = limit > 0.0 ? static_cast<float>(limit * limit) : -1.0f;
  r.stepLimit2 = limit > 0.0 ? static_cast<float>(0.0625 * skin * skin) : -1.0f;
  r.lost2 = static_cast<float>(smallest * smallest / 64.0);
  return r;
}

}  // namespace gpudem
