// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/surface_cells.hpp"

#include "base/vec3.hpp"
#include "surface/surface_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace gpudem {

namespace {

constexpr std::size_t mostNodes = 12;  ///< of the tree for a cell: more would cost memory and save little

/// Halves the box of the mesh until cells are left, handing on the triangles that each half may meet.
class Finder {
 public:
  Finder(const SurfaceMesh &mesh, const SurfaceTree &tree, SurfaceCells &cells, double reach)
      : mesh_(mesh), tree_(tree), cells_(cells), reach_(reach)
  {
  }

  struct Block {
    std::uint32_t at[3];
    std::uint32_t size;  ///< cells along a side, a power of two
  };

  void descend(const Block &block, const std::vector<std::uint32_t> &candidates)
  {
    std::vector<std::uint32_t> meets;
    for (const std::uint32_t k : candidates)
      if (mayMeet(block, mesh_.triangle[tree_.order[k]])) meets.push_back(k);
    if (meets.empty()) return;
    if (block.size == 1) {
      const std::vector<std::uint32_t> nodes = nodesHolding(tree_, meets, mostNodes);
      found_.push_back({cellKey(block.at[0], block.at[1], block.at[2]), static_cast<std::uint32_t>(cells_.nodes.size())});
      cells_.nodes.push_back(static_cast<std::uint32_t>(nodes.size()));
      cells_.nodes.insert(cells_.nodes.end(), nodes.begin(), nodes.end());
      return;
    }
    const std::uint32_t half = block.size / 2;
    for (std::uint32_t c = 0; c < 8; ++c)
      descend({{block.at[0] + (c & 1u) * half, block.at[1] + (c >> 1 & 1u) * half, block.at[2] + (c >> 2) * half}, half},
              meets);
  }

  void fill()
  {
    std::size_t size = 2;
    while (size < 2 * found_.size() + 1) size *= 2;
    cells_.key.assign(size, emptyCell);
    cells_.entry.assign(size, noNode);
    const auto mask = static_cast<std::uint32_t>(size - 1);
    for (const auto &f : found_) {
      std::uint32_t k = cellHash(f.first) & mask;
      while (cells_.key[k] != emptyCell) k = (k + 1) & mask;
      cells_.key[k] = f.first;
      cells_.entry[k] = f.second;
    }
  }

 private:
  /// Boxes and the triangle's plane decide; more cells than needed do no harm.
  bool mayMeet(const Block &block, const std::array<std::uint32_t, 3> &t) const
  {
    Vec3<double> centre;
    const double half = 0.5 * block.size * cells_.size;
    for (int d = 0; d < 3; ++d) {
      const auto i = static_cast<std::size_t>(d);
      centre[d] = cells_.origin[i] + block.at[d] * cells_.size + half;
      const double a = mesh_.vertex[t[0]][i], b = mesh_.vertex[t[1]][i], c = mesh_.vertex[t[2]][i];
      const double far = (half + reach_) * (1.0 + 1e-9);
      if (std::min({a, b, c}) > centre[d] + far || std::max({a, b, c}) < centre[d] - far) return false;
    }
    const auto corner = [&](std::size_t c) {
      const std::array<double, 3> &p = mesh_.vertex[t[c]];
      return Vec3<double>{p[0], p[1], p[2]};
    };
    const Vec3<double> a = corner(0), n = cross(corner(1) - a, corner(2) - a);
    const double length = std::sqrt(dot(n, n)), spread = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    return std::abs(dot(n, centre - a)) <= (half * spread + reach_ * length) * (1.0 + 1e-9);
  }

  const SurfaceMesh &mesh_;
  const SurfaceTree &tree_;
  SurfaceCells &cells_;
  double reach_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> found_;
};

}  // namespace

SurfaceCells buildCells(const SurfaceMesh &mesh, const SurfaceTree &tree, double reach)
{
  SurfaceCells cells;
  cells.size = 2.0 * reach;
  double extent = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    double lo = INFINITY, hi = -INFINITY;
    for (const auto &p : mesh.vertex) {
      lo = std::min(lo, p[d]);
      hi = std::max(hi, p[d]);
    }
    cells.origin[d] = lo - 2.0 * reach;
    extent = std::max(extent, hi - lo + 4.0 * reach);
  }
  std::uint32_t side = 1;
  while (side * cells.size < extent && side < 1u << 20) side *= 2;
  if (side * cells.size < extent)
    throw Error("building a surface: its extent " + std::to_string(extent) + " is more than a million times the reach " +
                std::to_string(reach));
  std::vector<std::uint32_t> all(tree.order.size());
  for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
  Finder finder(mesh, tree, cells, reach);
  finder.descend({{0, 0, 0}, side}, all);
  finder.fill();
  return cells;
}

}  // namespace gpudem
