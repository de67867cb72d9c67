// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Making neighbouring triangles agree about the side. Host only.
#pragma once

#include "gpudem/surface.h"

namespace gpudem {

/// Turns triangles so that neighbours across an edge of two agree, starting from the first of each part, and parts of
/// positive volume outward. A part inside another one, such as the inner skin of a hollow body, keeps the orientation
/// of the file: a cavity has its normals towards its middle.
/// \param[out] body [triangles] number of the part that a triangle belongs to; parts share no vertex
/// \return number of triangles turned
std::size_t orient(SurfaceMesh &mesh, std::vector<std::uint32_t> &body, std::uint32_t &bodies);

}  // namespace gpudem
