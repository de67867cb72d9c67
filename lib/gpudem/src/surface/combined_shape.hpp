// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Union, intersection and difference of shapes.
#pragma once

#include "gpudem/surface.h"
#include "surface/shape_parse.hpp"

namespace gpudem {

/// Triangles of an operation, closed and two-manifold, in cells of length \p spacing.
/// \throws Error if nothing is left of the bodies
SurfaceMesh combinedSurface(const ParsedShape &shape, double spacing);

}  // namespace gpudem
