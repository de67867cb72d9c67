// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Building the tree of boxes. Host only.
#pragma once

#include "gpudem/surface.h"
#include "surface/surface_view.hpp"

#include <vector>

namespace gpudem {

struct SurfaceTree {
  std::vector<std::uint32_t> order;  ///< [triangles] of the mesh, as the leaves hold them
  std::vector<TreeNode> node;        ///< depth first
};

/// Halves by number across the longest side of the box of the triangles' centres, down to leafTriangles.
/// \param margin added to the boxes (distance)
SurfaceTree buildTree(const SurfaceMesh &mesh, double margin);

/// A few nodes, at most \p most, that hold all of \p wanted, places in the order, ascending and not empty, and little
/// else.
std::vector<std::uint32_t> nodesHolding(const SurfaceTree &tree, const std::vector<std::uint32_t> &wanted,
                                        std::size_t most);

}  // namespace gpudem
