// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From triangles as they come to a mesh whose sides agree, and a list of what is wrong with it.
#include "surface/mesh_edges.hpp"
#include "surface/orient.hpp"
#include "surface/weld.hpp"

#include "base/vec3.hpp"

#include <cmath>
#include <map>

namespace gpudem {

namespace {

using Point = std::array<double, 3>;
using Corners = std::array<std::uint32_t, 3>;

Vec3<double> vec(const Point &p)
{
  return {p[0], p[1], p[2]};
}
Point centre(const SurfaceMesh &m, const Corners &t)
{
  Point c{};
  for (std::size_t d = 0; d < 3; ++d) c[d] = (m.vertex[t[0]][d] + m.vertex[t[1]][d] + m.vertex[t[2]][d]) / 3.0;
  return c;
}
bool finite(const Point &p)
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

double diagonal(const SurfaceMesh &mesh)
{
  Point lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
  for (const Point &p : mesh.vertex)
    for (std::size_t d = 0; d < 3 && finite(p); ++d) {
      lo[d] = std::min(lo[d], p[d]);
      hi[d] = std::max(hi[d], p[d]);
    }
  return std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
}

/// Least height: twice the area over the longest side.
double height(const SurfaceMesh &mesh, const Corners &t)
{
  const Vec3<double> a = vec(mesh.vertex[t[0]]), b = vec(mesh.vertex[t[1]]), c = vec(mesh.vertex[t[2]]);
  const Vec3<double> n = cross(b - a, c - a);
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return longest > 0.0 ? std::sqrt(dot(n, n) / longest) : 0.0;
}

/// Smallest corner first, orientation kept.
Corners rotated(Corners t)
{
  while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
  return t;
}

/// Corners point at the first of the welded vertices.
std::size_t weldCorners(SurfaceMesh &mesh, double distance)
{
  std::vector<Point> sound = mesh.vertex;
  for (Point &p : sound)
    if (!finite(p)) p = {0.0, 0.0, 0.0};  // its triangles go
  const Welder welder(sound, distance);
  std::size_t welded = 0;
  for (std::uint32_t v = 0; v < mesh.vertex.size(); ++v) welded += finite(mesh.vertex[v]) && welder.same()[v] != v;
  for (Corners &t : mesh.triangle)
    for (std::uint32_t &v : t)
      if (finite(mesh.vertex[v])) v = welder.same()[v];
  return welded;
}

void removeBadTriangles(SurfaceMesh &mesh, MeshReport &report)
{
  std::vector<Corners> kept;
  std::vector<std::uint32_t> zone;
  std::map<Corners, bool> seen;
  for (std::uint32_t i = 0; i < mesh.triangle.size(); ++i) {
    const Corners &t = mesh.triangle[i];
    const auto bad = [&](MeshDefect defect) { report.defects.push_back({defect, centre(mesh, t), i}); };
    if (!finite(mesh.vertex[t[0]]) || !finite(mesh.vertex[t[1]]) || !finite(mesh.vertex[t[2]])) {
      bad(MeshDefect::NotFinite);
    } else if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || height(mesh, t) <= report.weldDistance) {
      bad(MeshDefect::Degenerate);
    } else if (seen.count(rotated(t))) {
      bad(MeshDefect::Duplicate);
    } else if (seen.count(rotated({t[0], t[2], t[1]}))) {
      bad(MeshDefect::Opposite);
    } else {
      seen[rotated(t)] = true;
      kept.push_back(t);
      zone.push_back(mesh.zone.empty() ? 0u : mesh.zone[i]);
    }
  }
  mesh.triangle.swap(kept);
  mesh.zone.swap(zone);
}

void removeUnusedVertices(SurfaceMesh &mesh)
{
  constexpr std::uint32_t unused = ~0u;
  std::vector<std::uint32_t> place(mesh.vertex.size(), unused);
  std::vector<Point> kept;
  for (Corners &t : mesh.triangle)
    for (std::uint32_t &v : t) {
      if (place[v] == unused) {
        place[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(mesh.vertex[v]);
      }
      v = place[v];
    }
  mesh.vertex.swap(kept);
}

void reportEdges(const SurfaceMesh &mesh, MeshReport &report)
{
  report.bodyClosed.assign(report.bodies, true);
  forEachEdge(edgeUses(mesh), [&](const EdgeUse *first, const EdgeUse *last) {
    const auto uses = last - first;
    if (uses == 2 && first[0].forward != first[1].forward) return;
    const Point &a = mesh.vertex[first->low], &b = mesh.vertex[first->high];
    const MeshDefect defect = uses == 1  ? MeshDefect::OpenEdge
                              : uses > 2 ? MeshDefect::NonManifold
                                         : MeshDefect::Unorientable;
    report.defects.push_back(
        {defect, {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])}, first->triangle});
    // a line where closed bodies meet does not open them, if as many triangles run one way as the other
    std::ptrdiff_t forward = 0;
    for (const EdgeUse *u = first; u != last; ++u) forward += u->forward;
    if (2 * forward != uses) report.bodyClosed[report.body[first->triangle]] = false;
  });
  for (const bool closed : report.bodyClosed) report.closedBodies += closed;
}

void measure(const SurfaceMesh &mesh, MeshReport &report)
{
  for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
    const Corners &t = mesh.triangle[i];
    const Vec3<double> a = vec(mesh.vertex[t[0]]), b = vec(mesh.vertex[t[1]]), c = vec(mesh.vertex[t[2]]);
    const Vec3<double> n = cross(b - a, c - a);
    report.area += 0.5 * std::sqrt(dot(n, n));
    if (report.bodyClosed[report.body[i]]) report.volume += dot(a, cross(b, c)) / 6.0;
  }
}

}  // namespace

MeshReport cleanSurface(SurfaceMesh &mesh, double weld)
{
  MeshReport report;
  report.weldDistance = weld * diagonal(mesh);
  if (!(report.weldDistance > 0.0)) throw Error("cleaning a surface: it has no extent, or the welding distance is 0");
  report.welded = weldCorners(mesh, report.weldDistance);
  removeBadTriangles(mesh, report);
  removeUnusedVertices(mesh);
  if (mesh.triangle.empty()) throw Error("cleaning a surface: no triangle is left\n" + report.text());
  report.turned = orient(mesh, report.body, report.bodies);
  reportEdges(mesh, report);
  measure(mesh, report);
  return report;
}

}  // namespace gpudem
