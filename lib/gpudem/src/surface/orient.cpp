// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/orient.hpp"

#include "base/vec3.hpp"
#include "surface/mesh_edges.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace gpudem {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A part of the mesh and its box.
struct Part {
  std::array<double, 3> lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
  double volume = 0.0;  ///< signed, by the divergence theorem
  std::size_t turned = 0, triangles = 0;
  bool closed = true;
};

std::uint32_t root(std::vector<std::uint32_t> &parent, std::uint32_t v)
{
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/// Parts by shared vertices, numbered in the order of the triangles.
std::uint32_t numberParts(const SurfaceMesh &mesh, std::vector<std::uint32_t> &body)
{
  std::vector<std::uint32_t> parent(mesh.vertex.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const Corners &t : mesh.triangle)
    for (int c = 1; c < 3; ++c) parent[root(parent, t[static_cast<std::size_t>(c)])] = root(parent, t[0]);
  std::vector<std::uint32_t> number(mesh.vertex.size(), ~0u);
  std::uint32_t parts = 0;
  body.resize(mesh.triangle.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    std::uint32_t &n = number[root(parent, mesh.triangle[i][0])];
    if (n == ~0u) n = parts++;
    body[i] = n;
  }
  return parts;
}

/// Neighbours across edges of two triangles: three for each triangle, ~0u for none; disagreement in the lowest bit.
std::vector<std::array<std::uint32_t, 3>> neighbours(const SurfaceMesh &mesh, std::vector<bool> &open)
{
  std::vector<std::array<std::uint32_t, 3>> across(mesh.triangle.size(), {~0u, ~0u, ~0u});
  forEachEdge(edgeUses(mesh), [&](const EdgeUse *first, const EdgeUse *last) {
    if (last - first == 1) open[first->triangle] = true;
    if (last - first != 2) return;
    const std::uint32_t disagree = first[0].forward == first[1].forward;
    across[first[0].triangle][first[0].corner] = first[1].triangle << 1 | disagree;
    across[first[1].triangle][first[1].corner] = first[0].triangle << 1 | disagree;
  });
  return across;
}

double signedVolume(const SurfaceMesh &mesh, const Corners &t, bool turned, const std::array<double, 3> &origin)
{
  const auto corner = [&](std::uint32_t v) {
    const std::array<double, 3> &p = mesh.vertex[v];
    return Vec3<double>{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
  };
  return (turned ? -1.0 : 1.0) * dot(corner(t[0]), cross(corner(t[1]), corner(t[2]))) / 6.0;
}

bool within(const Part &a, const Part &b)
{
  for (std::size_t d = 0; d < 3; ++d)
    if (a.lo[d] < b.lo[d] || a.hi[d] > b.hi[d]) return false;
  return true;
}

}  // namespace

std::size_t orient(SurfaceMesh &mesh, std::vector<std::uint32_t> &body, std::uint32_t &bodies)
{
  const std::size_t count = mesh.triangle.size();
  bodies = numberParts(mesh, body);
  std::vector<bool> open(count, false);
  const auto across = neighbours(mesh, open);

  // spread the orientation of one triangle over all that hang together by edges; the majority stays as it is
  std::vector<char> turn(count, 0), seen(count, 0);
  std::vector<std::uint32_t> patch;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (seen[seed]) continue;
    patch.assign(1, seed);
    seen[seed] = 1;
    std::size_t turned = 0;
    for (std::size_t k = 0; k < patch.size(); ++k) {
      const std::uint32_t t = patch[k];
      turned += static_cast<std::size_t>(turn[t]);
      for (const std::uint32_t to : across[t]) {
        if (to == ~0u || seen[to >> 1]) continue;
        seen[to >> 1] = 1;
        turn[to >> 1] = static_cast<char>(turn[t] ^ static_cast<char>(to & 1u));
        patch.push_back(to >> 1);
      }
    }
    if (2 * turned > patch.size())
      for (const std::uint32_t t : patch) turn[t] ^= 1;
  }

  std::vector<Part> part(bodies);
  for (std::size_t i = 0; i < count; ++i) {
    Part &p = part[body[i]];
    for (const std::uint32_t v : mesh.triangle[i])
      for (std::size_t d = 0; d < 3; ++d) {
        p.lo[d] = std::min(p.lo[d], mesh.vertex[v][d]);
        p.hi[d] = std::max(p.hi[d], mesh.vertex[v][d]);
      }
    p.closed = p.closed && !open[i];
  }
  for (std::size_t i = 0; i < count; ++i)
    part[body[i]].volume += signedVolume(mesh, mesh.triangle[i], turn[i] != 0, part[body[i]].lo);
  std::vector<bool> insideOut(bodies, false);
  for (std::uint32_t b = 0; b < bodies; ++b) {
    if (!part[b].closed || part[b].volume >= 0.0) continue;
    insideOut[b] = true;
    for (std::uint32_t o = 0; o < bodies && bodies < 1000; ++o)  // a cavity; scenes of thousands of parts have none
      if (o != b && part[o].closed && part[o].volume > 0.0 && within(part[b], part[o])) insideOut[b] = false;
  }

  std::size_t turned = 0;
  for (std::size_t i = 0; i < count; ++i)
    if ((turn[i] != 0) != insideOut[body[i]]) {
      std::swap(mesh.triangle[i][1], mesh.triangle[i][2]);
      ++turned;
    }
  return turned;
}

}  // namespace gpudem
