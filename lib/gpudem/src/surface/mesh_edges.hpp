// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Edges of a triangle mesh and the triangles at each. Host only.
#pragma once

#include "gpudem/surface.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace gpudem {

/// Side \p corner of a triangle runs from its corner to the next one.
struct EdgeUse {
  std::uint32_t low, high;  ///< vertices, low < high
  std::uint32_t triangle;
  std::uint32_t corner : 2;
  std::uint32_t forward : 1;  ///< the triangle runs from low to high
};

/// All uses of all edges, those of one edge next to each other.
inline std::vector<EdgeUse> edgeUses(const SurfaceMesh &mesh)
{
  std::vector<EdgeUse> use;
  use.reserve(3 * mesh.triangle.size());
  for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t)
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.triangle[t][c], b = mesh.triangle[t][(c + 1) % 3];
      use.push_back({std::min(a, b), std::max(a, b), t, c & 3u, a < b ? 1u : 0u});
    }
  std::sort(use.begin(), use.end(), [](const EdgeUse &a, const EdgeUse &b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle < b.triangle;
  });
  return use;
}

/// f(first, last) for the uses of each edge.
template <class F>
void forEachEdge(const std::vector<EdgeUse> &use, const F &f)
{
  for (std::size_t i = 0, end = 0; i < use.size(); i = end) {
    while (end < use.size() && use[end].low == use[i].low && use[end].high == use[i].high) ++end;
    f(use.data() + i, use.data() + end);
  }
}

}  // namespace gpudem
