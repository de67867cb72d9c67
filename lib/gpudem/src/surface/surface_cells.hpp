// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Cells near the surface: a grain elsewhere is rejected by one look, and one nearby enters the tree deep down.
#pragma once

#include "gpudem/surface.h"
#include "surface/surface_tree.hpp"

#include <vector>

namespace gpudem {

struct SurfaceCells {
  std::vector<std::uint64_t> key;    ///< [a power of two] open addressing
  std::vector<std::uint32_t> entry;  ///< [the same] into \c nodes
  std::vector<std::uint32_t> nodes;  ///< for each cell: how many nodes of the tree, and these
  std::array<double, 3> origin;      ///< (distance)
  double size;                       ///< (distance)
};

/// Cells of size 2 \p reach that come within \p reach of a triangle.
SurfaceCells buildCells(const SurfaceMesh &mesh, const SurfaceTree &tree, double reach);

}  // namespace gpudem
