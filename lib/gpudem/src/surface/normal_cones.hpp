// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Normals of the triangles below a node of the tree, to pass over nodes without a minimum of the distance.
///
/// At a minimum p of the distance from x the vector x - p is normal to the surface: along the normal of a face, or between the
/// normals of the faces that meet at an edge or corner (a proximal normal lies in the convex hull of the normals nearby:
/// Clarke, Optimization and Nonsmooth Analysis, 1983, section 2.5). So a node whose points see x under directions that
/// no normal of its triangles and their neighbours has holds no minimum. Spatialized normal cones: Johnson and Cohen, Proc.
/// I3D 2001, 129. Open edges and edges of more than two triangles have normals everywhere: their nodes are never passed
/// over.
#pragma once

#include "gpudem/surface.h"
#include "surface/surface_tree.hpp"

#include <vector>

namespace gpudem {

/// Cones of all nodes; see NormalCone.
std::vector<NormalCone> buildCones(const SurfaceMesh &mesh, const SurfaceTree &tree);

}  // namespace gpudem
