// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The arrays of a surface, from its mesh.
#include "gpudem/surface.h"

#include "surface/mesh_edges.hpp"
#include "surface/normal_cones.hpp"
#include "surface/surface_cells.hpp"
#include "surface/surface_tree.hpp"
#include "surface/surface_view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace gpudem {

/// All arrays one after the other; the pointers of \c shape are offsets from the beginning.
struct Surface::Packed {
  std::vector<std::byte> memory;
  SurfaceView shape{};

  template <class T>
  void append(const T *&offset, const std::vector<T> &array)
  {
    constexpr std::size_t unit = 16;
    const std::size_t at = (memory.size() + unit - 1) / unit * unit;
    memory.resize(at + array.size() * sizeof(T));
    if (!array.empty()) std::memcpy(memory.data() + at, array.data(), array.size() * sizeof(T));
    offset = reinterpret_cast<const T *>(at);
  }
};

struct Surface::Arrays {
  std::vector<Vec3<double>> vertex;
  std::vector<SurfaceTriangle> triangle;
  std::vector<std::uint32_t> spokeStart, spoke, fan;
  std::vector<Vec3<float>> vertexNormal, edgeNormal;
  SurfaceTree tree;
  std::vector<NormalCone> cone;
  SurfaceCells cells;

  void connect(const SurfaceMesh &mesh);
  void makeNormals(const SurfaceMesh &mesh);
  void pack(Packed &to) const;

 private:
  void connectEdge(const SurfaceMesh &mesh, const std::vector<std::uint32_t> &place, const EdgeUse *first,
                   const EdgeUse *last);
};

namespace {

constexpr std::uint32_t noNumber = 0xffffffffu;

std::uint32_t opposite(const SurfaceMesh &mesh, const EdgeUse &u)
{
  return mesh.triangle[u.triangle][(u.corner + 2) % 3];
}

Vec3<double> unit(const Vec3<double> &v)
{
  const double length = std::sqrt(dot(v, v));
  return length > 0.0 ? v * (1.0 / length) : v;
}

/// The mesh with its vertices in the order in which the tree meets them: a leaf reads few lines of memory.
SurfaceMesh inOrderOf(const SurfaceTree &tree, const SurfaceMesh &mesh)
{
  SurfaceMesh sorted;
  sorted.triangle = mesh.triangle;
  sorted.zone = mesh.zone;
  std::vector<std::uint32_t> number(mesh.vertex.size(), noNumber);
  for (const std::uint32_t t : tree.order)
    for (std::uint32_t &v : sorted.triangle[t]) {
      if (number[v] == noNumber) {
        number[v] = static_cast<std::uint32_t>(sorted.vertex.size());
        sorted.vertex.push_back(mesh.vertex[v]);
      }
      v = number[v];
    }
  return sorted;
}

/// Place of each triangle of the mesh in the order of the tree.
std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t> &order)
{
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  return place;
}

}  // namespace

void Surface::Arrays::connectEdge(const SurfaceMesh &mesh, const std::vector<std::uint32_t> &place,
                                  const EdgeUse *first, const EdgeUse *last)
{
  ++spokeStart[first->low + 1];
  ++spokeStart[first->high + 1];
  if (last - first > 2) {
    const auto at = static_cast<std::uint32_t>(fan.size());
    fan.push_back(static_cast<std::uint32_t>(last - first));
    for (const EdgeUse *u = first; u != last; ++u) {
      fan.push_back(opposite(mesh, *u));
      triangle[place[u->triangle]].across[u->corner] = manyFaces | at;
    }
  } else if (last - first == 2) {
    triangle[place[first[0].triangle]].across[first[0].corner] = opposite(mesh, first[1]);
    triangle[place[first[1].triangle]].across[first[1].corner] = opposite(mesh, first[0]);
  }
}

void Surface::Arrays::connect(const SurfaceMesh &mesh)
{
  const std::vector<std::uint32_t> place = inverse(tree.order);
  vertex.reserve(mesh.vertex.size());
  for (const auto &p : mesh.vertex) vertex.push_back({p[0], p[1], p[2]});
  triangle.resize(mesh.triangle.size());
  for (std::uint32_t k = 0; k < triangle.size(); ++k) {
    const std::uint32_t t = tree.order[k];
    const auto &c = mesh.triangle[t];
    triangle[k] = {{c[0], c[1], c[2]}, {ownFace, ownFace, ownFace}, t, mesh.zone.empty() ? 0u : mesh.zone[t]};
  }
  spokeStart.assign(mesh.vertex.size() + 1, 0);
  const std::vector<EdgeUse> uses = edgeUses(mesh);
  forEachEdge(uses, [&](const EdgeUse *first, const EdgeUse *last) { connectEdge(mesh, place, first, last); });
  for (std::size_t v = 0; v < mesh.vertex.size(); ++v) spokeStart[v + 1] += spokeStart[v];
  spoke.resize(spokeStart.back());
  std::vector<std::uint32_t> at(spokeStart.begin(), spokeStart.end() - 1);
  forEachEdge(uses, [&](const EdgeUse *first, const EdgeUse *) {
    spoke[at[first->low]++] = first->high;
    spoke[at[first->high]++] = first->low;
  });
}

/// Normals of faces, weighted at a vertex with the angle of the face there (Baerentzen and Aanaes, IEEE Trans. Vis.
/// Comput. Graph. 11 (2005) 243): the sign of their product with the vector from the nearest point is that of the side.
void Surface::Arrays::makeNormals(const SurfaceMesh &mesh)
{
  const std::vector<std::uint32_t> place = inverse(tree.order);
  std::vector<Vec3<double>> normal(mesh.triangle.size()), sum(vertex.size(), Vec3<double>{0.0, 0.0, 0.0});
  for (std::size_t t = 0; t < normal.size(); ++t) {
    const auto &c = mesh.triangle[t];
    normal[t] = unit(cross(vertex[c[1]] - vertex[c[0]], vertex[c[2]] - vertex[c[0]]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<double> a = unit(vertex[c[(k + 1) % 3]] - vertex[c[k]]), b = unit(vertex[c[(k + 2) % 3]] - vertex[c[k]]);
      const Vec3<double> turn = cross(a, b);
      sum[c[k]] += normal[t] * std::atan2(std::sqrt(dot(turn, turn)), dot(a, b));
    }
  }
  for (const auto &v : sum) vertexNormal.push_back(v.as<float>());
  edgeNormal.resize(3 * normal.size());
  forEachEdge(edgeUses(mesh), [&](const EdgeUse *first, const EdgeUse *last) {
    Vec3<double> n{0.0, 0.0, 0.0};
    for (const EdgeUse *u = first; u != last; ++u) n += normal[u->triangle];
    for (const EdgeUse *u = first; u != last; ++u) edgeNormal[3 * place[u->triangle] + u->corner] = n.as<float>();
  });
}

Surface::Surface(const SurfaceMesh &given, double reach, SurfaceSide side) : packed_(new Packed)
{
  if (given.triangle.empty()) throw Error("building a surface: the mesh has no triangle");
  if (!(reach > 0.0) || !std::isfinite(reach))
    throw Error("building a surface: the reach is " + std::to_string(reach) + ", must be above 0");
  Arrays a;
  double largest = 0.0;
  for (const auto &p : given.vertex) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  // centres are rounded to float where they meet the boxes
  a.tree = buildTree(given, 2.4e-7 * (largest + 2.0 * reach));
  const SurfaceMesh mesh = inOrderOf(a.tree, given);
  a.cone = buildCones(mesh, a.tree);
  a.cells = buildCells(mesh, a.tree, reach);
  a.connect(mesh);
  if (side != SurfaceSide::Both) {
    forEachEdge(edgeUses(mesh), [&](const EdgeUse *first, const EdgeUse *last) {
      std::ptrdiff_t forward = 0;
      for (const EdgeUse *u = first; u != last; ++u) forward += u->forward;
      if (2 * forward == last - first) return;
      const auto &p = mesh.vertex[first->low], &q = mesh.vertex[first->high];
      throw Error(fmt::format("the surface has no inside: it is not closed at the edge from ({:g}, {:g}, {:g}) to "
                              "({:g}, {:g}, {:g})",
                              p[0], p[1], p[2], q[0], q[1], q[2]));
    });
    a.makeNormals(mesh);
  }
  a.pack(*packed_);
  packed_->shape.reach = reach;
  packed_->shape.side = side == SurfaceSide::Both ? 0 : side == SurfaceSide::Outside ? 1 : -1;
}

Surface::~Surface() = default;
Surface::Surface(Surface &&) noexcept = default;
Surface &Surface::operator=(Surface &&) noexcept = default;

void Surface::Arrays::pack(Packed &to) const
{
  SurfaceView &v = to.shape;
  to.append(v.vertex, vertex);
  to.append(v.triangle, triangle);
  to.append(v.node, tree.node);
  to.append(v.cone, cone);
  to.append(v.spokeStart, spokeStart);
  to.append(v.spoke, spoke);
  to.append(v.fan, fan);
  to.append(v.vertexNormal, vertexNormal);
  to.append(v.edgeNormal, edgeNormal);
  to.append(v.cellKey, cells.key);
  to.append(v.cellEntry, cells.entry);
  to.append(v.cellNodes, cells.nodes);
  v.cellMask = static_cast<std::uint32_t>(cells.key.size() - 1);
  v.triangles = static_cast<std::uint32_t>(triangle.size());
  v.vertices = static_cast<std::uint32_t>(vertex.size());
  v.nodes = static_cast<std::uint32_t>(tree.node.size());
  v.origin = {cells.origin[0], cells.origin[1], cells.origin[2]};
  v.inverseCell = 1.0 / cells.size;
}

namespace {
template <class T>
void rebase(const T *&offset, const std::byte *base)
{
  offset = reinterpret_cast<const T *>(base + reinterpret_cast<std::size_t>(offset));
}
}  // namespace

SurfaceView Surface::viewAt(const void *copy) const
{
  const auto *base = static_cast<const std::byte *>(copy);
  SurfaceView v = packed_->shape;
  rebase(v.vertex, base);
  rebase(v.triangle, base);
  rebase(v.node, base);
  rebase(v.cone, base);
  rebase(v.spokeStart, base);
  rebase(v.spoke, base);
  rebase(v.fan, base);
  rebase(v.vertexNormal, base);
  rebase(v.edgeNormal, base);
  rebase(v.cellKey, base);
  rebase(v.cellEntry, base);
  rebase(v.cellNodes, base);
  return v;
}

SurfaceView Surface::view() const
{
  return viewAt(data());
}

const void *Surface::data() const
{
  return packed_->memory.data();
}

std::size_t Surface::bytes() const
{
  return packed_->memory.size();
}

double Surface::reach() const
{
  return packed_->shape.reach;
}

}  // namespace gpudem
