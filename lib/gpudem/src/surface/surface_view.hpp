// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The arrays that a query of the surface reads, on host or device.
#pragma once

#include "base/vec3.hpp"

#include <cstdint>

namespace gpudem {

/// A box of triangles. The tree lies in depth-first order, so that a walk needs no stack: the next node is the
/// following one if the box is within reach, else the one at \c skip.
struct alignas(16) TreeNode {
  float lo[3], hi[3];    ///< box, rounded outward (distance)
  std::uint32_t skip;    ///< first node behind this one's subtree
  std::uint32_t leaf;    ///< 0: inner node; else first triangle * 8 + number of triangles (1 to 7)
};
constexpr std::uint32_t leafTriangles = 4;

/// Directions, or their opposites, of all normals at the triangles below a node (surface/normal_cones.hpp).
struct NormalCone {
  float axis[3];        ///< of unit length
  float cosine, sine;   ///< of the half angle; cosine allNormals: any direction
};
constexpr float allNormals = -2.0f;

/// Corners of a triangle and what lies across its edges.
struct alignas(16) SurfaceTriangle {
  std::uint32_t corner[3];  ///< vertices
  std::uint32_t across[3];  ///< vertex opposite to edge corner[k] - corner[k+1] in the neighbour; ownFace; or manyFaces
                            ///< with an index into \c fan
  std::uint32_t original;   ///< number of the triangle in the mesh; the tree orders them by place
  std::uint32_t zone;
};
constexpr std::uint32_t ownFace = 0xffffffffu;    ///< nothing across: an open edge
constexpr std::uint32_t manyFaces = 0x80000000u;  ///< an edge of more than two triangles

/// Pseudonormals say which side of a nearest point a centre is on (Baerentzen and Aanaes 2005).
struct SurfaceView {
  const Vec3<double> *vertex;           ///< [vertices] (distance)
  const SurfaceTriangle *triangle;      ///< [triangles] in the order of the tree
  const TreeNode *node;                 ///< [nodes]
  const NormalCone *cone;               ///< [nodes]
  const std::uint32_t *spokeStart;      ///< [vertices + 1] into \c spoke
  const std::uint32_t *spoke;           ///< [2 * edges] the vertices that share an edge with a vertex
  const std::uint32_t *fan;             ///< for each edge of more than two triangles: number, then opposite vertices
  const Vec3<float> *vertexNormal;      ///< [vertices] angle-weighted; signed surfaces only, else null
  const Vec3<float> *edgeNormal;        ///< [3 * triangles] sum of the normals of the edge's triangles; likewise
  const std::uint64_t *cellKey;         ///< [cellMask + 1] hashed cells within reach of a triangle; ~0 is empty
  const std::uint32_t *cellEntry;       ///< [cellMask + 1] into \c cellNodes
  const std::uint32_t *cellNodes;       ///< per cell: number of nodes that hold all triangles within its reach, the nodes
  std::uint32_t cellMask;               ///< size of the table - 1, a power of two - 1
  std::uint32_t triangles, vertices, nodes;
  Vec3<double> origin;                  ///< of the cells (distance)
  double inverseCell;                   ///< (1/distance)
  double reach;                         ///< largest distance that may be asked for (distance)
  int side;                             ///< 0: both; 1: grains outside; -1: grains inside
};

}  // namespace gpudem
