// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#pragma once

#include "gpudem/surface.h"

namespace gpudem {

/// Triangles of the zero of every level set of a .vdb file, extracted by dual contouring: the error is of second order in
/// the voxel size, and edges are rounded by about a voxel.
/// \throws Error if the file cannot be read or holds no level set, or if the library was built without OpenVDB
SurfaceMesh readLevelSet(const std::string &path);

}  // namespace gpudem
