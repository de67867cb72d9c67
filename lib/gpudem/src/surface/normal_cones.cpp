// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/normal_cones.hpp"

#include "surface/mesh_edges.hpp"

#include <algorithm>
#include <cmath>

namespace gpudem {

namespace {

/// Cones wider than this say nothing worth the look. They must stay below a right angle for the hull to be convex.
constexpr double widest = 1.3;

struct Cone {
  Vec3<double> axis{0.0, 0.0, 0.0};
  double half = M_PI;  ///< angle; M_PI: all directions
};

Vec3<double> unit(const Vec3<double> &v)
{
  const double length = std::sqrt(dot(v, v));
  return length > 0.0 ? v * (1.0 / length) : v;
}

double angle(const Vec3<double> &a, const Vec3<double> &b)
{
  const Vec3<double> turn = cross(a, b);
  return std::atan2(std::sqrt(dot(turn, turn)), dot(a, b));
}

Cone merged(const Cone &a, const Cone &b)
{
  // opposite axes have no middle
  if (a.half > widest || b.half > widest || dot(a.axis, b.axis) < std::cos(2.0 * widest)) return {};
  Cone c;
  c.axis = unit(a.axis + b.axis);
  c.half = std::max(angle(c.axis, a.axis) + a.half, angle(c.axis, b.axis) + b.half);
  return c.half > widest ? Cone{} : c;
}

/// Normals around each vertex; none where an edge there has not two triangles that agree.
std::vector<Cone> conesOfVertices(const SurfaceMesh &mesh)
{
  std::vector<Vec3<double>> normal, sum(mesh.vertex.size(), Vec3<double>{0.0, 0.0, 0.0});
  for (const auto &t : mesh.triangle) {
    const auto corner = [&](std::size_t c) {
      const auto &p = mesh.vertex[t[c]];
      return Vec3<double>{p[0], p[1], p[2]};
    };
    normal.push_back(unit(cross(corner(1) - corner(0), corner(2) - corner(0))));
    for (const std::uint32_t v : t) sum[v] += normal.back();
  }
  std::vector<Cone> cone(mesh.vertex.size());
  for (std::size_t v = 0; v < cone.size(); ++v) cone[v] = {unit(sum[v]), 0.0};
  for (std::size_t t = 0; t < normal.size(); ++t)
    for (const std::uint32_t v : mesh.triangle[t]) cone[v].half = std::max(cone[v].half, angle(cone[v].axis, normal[t]));
  forEachEdge(edgeUses(mesh), [&](const EdgeUse *first, const EdgeUse *last) {
    if (last - first == 2 && first[0].forward != first[1].forward) return;
    cone[first->low] = cone[first->high] = Cone{};
  });
  return cone;
}

}  // namespace

std::vector<NormalCone> buildCones(const SurfaceMesh &mesh, const SurfaceTree &tree)
{
  const std::vector<Cone> vertex = conesOfVertices(mesh);
  std::vector<Cone> cone(tree.node.size());
  for (std::size_t n = cone.size(); n-- > 0;) {  // children stand behind their parent
    const TreeNode &node = tree.node[n];
    if (node.leaf == 0) {
      cone[n] = merged(cone[n + 1], cone[tree.node[n + 1].skip]);
      continue;
    }
    const std::uint32_t begin = node.leaf >> 3;
    cone[n] = vertex[mesh.triangle[tree.order[begin]][0]];
    for (std::uint32_t k = begin; k < begin + (node.leaf & 7u); ++k)
      for (const std::uint32_t v : mesh.triangle[tree.order[k]]) cone[n] = merged(cone[n], vertex[v]);
  }
  std::vector<NormalCone> packed;
  for (const Cone &c : cone) {
    // rounding of the axis to float turns it by less than this
    const double half = c.half + 1e-6;
    if (c.half > widest) packed.push_back({{0.0f, 0.0f, 0.0f}, allNormals, 0.0f});
    else
      packed.push_back({{static_cast<float>(c.axis.x), static_cast<float>(c.axis.y), static_cast<float>(c.axis.z)},
                        static_cast<float>(std::cos(half)), static_cast<float>(std::sin(half))});
  }
  return packed;
}

}  // namespace gpudem
