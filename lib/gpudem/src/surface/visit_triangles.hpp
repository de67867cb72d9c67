// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Walking the cells and the tree of a surface: the triangles within reach of a point.
#pragma once

#include "surface/surface_view.hpp"
#include "surface/triangle_point.hpp"

namespace gpudem {

/// Key of a cell; 21 bits for each direction.
GPUDEM_HD std::uint64_t cellKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  return static_cast<std::uint64_t>(x) << 42 | static_cast<std::uint64_t>(y) << 21 | z;
}
GPUDEM_HD std::uint32_t cellHash(std::uint64_t key)
{
  key *= 0x9e3779b97f4a7c15ull;
  return static_cast<std::uint32_t>(key >> 32);
}
constexpr std::uint64_t emptyCell = ~std::uint64_t{0};
constexpr std::uint32_t noNode = ~std::uint32_t{0};
constexpr double maxCells = 2097151.0;  // per direction

/// Place in cellNodes of the nodes that hold all triangles within the surface's reach of \p x, or noNode.
GPUDEM_HD std::uint32_t entryNodes(const SurfaceView &s, const Vec3<double> &x)
{
  const Vec3<double> at = (x - s.origin) * s.inverseCell;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < maxCells && at.y < maxCells && at.z < maxCells))
    return noNode;
  const std::uint64_t key = cellKey(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
                                    static_cast<std::uint32_t>(at.z));
  for (std::uint32_t k = cellHash(key) & s.cellMask;; k = (k + 1) & s.cellMask) {
    if (s.cellKey[k] == key) return s.cellEntry[k];
    if (s.cellKey[k] == emptyCell) return noNode;
  }
}

/// Squared distance of \p x from the box.
GPUDEM_HD float boxDistance2(const TreeNode &n, const Vec3<float> &x)
{
  float sum = 0.0f;
  const float at[3] = {x.x, x.y, x.z};
  GPUDEM_UNROLL
  for (int d = 0; d < 3; ++d) {
    const float below = n.lo[d] - at[d], above = at[d] - n.hi[d];
    const float out = below > above ? below : above;
    if (out > 0.0f) sum += out * out;
  }
  return sum;
}

/// May a node within reach hold a minimum of the distance from a point within \p room of \p x?
GPUDEM_HD bool mayHoldMinimum(const NormalCone &cone, const TreeNode &n, const Vec3<float> &x, float room = 0.0f)
{
  if (cone.cosine == allNormals) return true;
  const Vec3<float> branch{x.x - 0.5f * (n.lo[0] + n.hi[0]), x.y - 0.5f * (n.lo[1] + n.hi[1]),
                           x.z - 0.5f * (n.lo[2] + n.hi[2])};
  const Vec3<float> size{n.hi[0] - n.lo[0], n.hi[1] - n.lo[1], n.hi[2] - n.lo[2]};
  const float half = 0.5f * squareRoot(dot(size, size)) + room, away2 = dot(branch, branch) - half * half;
  if (away2 <= 0.0f) return true;
  // angle of branch and axis <= half angle of the cone + that of the box seen from x, times |branch|
  const float along = branch.x * cone.axis[0] + branch.y * cone.axis[1] + branch.z * cone.axis[2];
  const float needed = cone.cosine * squareRoot(away2) - cone.sine * half;
  return absolute(along) >= needed * 0.9999f - 1e-5f * squareRoot(away2);
}

enum class Wanted { All, Minima };

/// Squared \p reach for the boxes of single precision, which are rounded outward by as much as the coordinate.
GPUDEM_HD float coarseReach2(double reach)
{
  return static_cast<float>(reach * reach) * 1.00001f;
}

/// Calls visit(node number) for nodes that hold triangles and may be within \p reach of \p x, until it returns false; for
/// Minima it may leave out nodes that hold no minimum of the distance from any point within \p room of \p x.
template <Wanted wanted, class Visit>
GPUDEM_HD void visitNodes(const SurfaceView &s, const Vec3<double> &x, double reach, float room, const Visit &visit)
{
  const std::uint32_t entry = entryNodes(s, x);
  if (entry == noNode) return;
  const Vec3<float> coarse = x.as<float>();
  const float reach2 = coarseReach2(reach);
  const std::uint32_t *roots = s.cellNodes + entry;
  for (std::uint32_t r = 1; r <= roots[0]; ++r) {
    const std::uint32_t end = s.node[roots[r]].skip;
    for (std::uint32_t n = roots[r]; n < end;) {
      const TreeNode &node = s.node[n];
      if (boxDistance2(node, coarse) > reach2 ||
          (wanted == Wanted::Minima && !mayHoldMinimum(s.cone[n], node, coarse, room))) {
        n = node.skip;
        continue;
      }
      if (node.leaf != 0 && !visit(n)) return;
      ++n;
    }
  }
}

/// Calls visit(triangle number, nearest point, squared distance) if triangle \p k is within \p reach of \p x.
/// \return false once visit does
template <class Visit>
GPUDEM_HD bool visitTriangle(const SurfaceView &s, std::uint32_t k, const Vec3<double> &x, double reach, const Visit &visit)
{
  const SurfaceTriangle &t = s.triangle[k];
  const TrianglePoint p = nearestPoint(s.vertex[t.corner[0]] - x, s.vertex[t.corner[1]] - x, s.vertex[t.corner[2]] - x);
  const double distance2 = dot(p.branch, p.branch);
  return !(distance2 < reach * reach) || visit(k, p, distance2);
}

/// The same for the triangles of node \p n.
template <class Visit>
GPUDEM_HD bool visitTriangles(const SurfaceView &s, std::uint32_t n, const Vec3<double> &x, double reach,
                              const Visit &visit)
{
  const std::uint32_t leaf = s.node[n].leaf;
  for (std::uint32_t k = leaf >> 3, last = k + (leaf & 7u); k < last; ++k)
    if (!visitTriangle(s, k, x, reach, visit)) return false;
  return true;
}

/// Calls visit(triangle number, nearest point, squared distance) for triangles within \p reach of \p x, until it
/// returns false; for Minima it may leave out triangles that hold no minimum of the distance.
template <Wanted wanted = Wanted::All, class Visit>
GPUDEM_HD void visitNear(const SurfaceView &s, const Vec3<double> &x, double reach, const Visit &visit)
{
  visitNodes<wanted>(s, x, reach, 0.0f, [&](std::uint32_t n) { return visitTriangles(s, n, x, reach, visit); });
}

}  // namespace gpudem
