// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Combined shapes by dual contouring (Ju, Losasso, Schaefer and Warren, ACM Trans. Graph. 21 (2002) 339), with a
/// vertex for each sheet of a cell (Nielson, IEEE Visualization 2004, 489), so that the mesh is two-manifold.
///
/// There the vertex of a cell minimises the distances from the planes at its crossings. Here the surfaces themselves
/// are known: the vertex is where those that cross the cell meet, so flat faces are exact and edges and corners sharp,
/// on the curves where the exact bodies cut each other. Of libraries that combine bodies exactly, Open CASCADE 7.6 left
/// meshes open or lost parts where axes meet or surfaces touch, as round numbers have it, and CGAL's part for it is
/// under the GPL 3, which does not go with GPL-2.0-only.
#include "surface/combined_shape.hpp"

#include "surface/sign_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace gpudem {

namespace {

constexpr double mostNodes = 1e9, mostTriangles = 2e7;
constexpr double rounding = 1e-6;  // what is this part of the spacing away is there
constexpr const char *tooFine = "spacing is too small: it would take more than {:g} {}";

/// Where an edge of the grid meets the surface, and which.
struct Crossing {
  Vec3<double> at;
  int surface;
};

/// Crossings of a cell that belong to one vertex.
struct Sheet {
  std::vector<int> surfaces;  ///< each once
  int most;                   ///< that of most crossings
  Vec3<double> middle;        ///< of the crossings (distance)
};

class DualContour {
 public:
  /// \param reach how far from the crossings of a cell its vertex may be if that is outside the cell (cells)
  DualContour(const SolidTree &solid, double spacing, const Vec3<double> &shift, double reach)
      : solid_(solid), h_(spacing), reach_(reach), grid_(solid, spacing, shift)
  {
  }
  bool empty() const { return grid_.cells().empty(); }
  /// \return false if there are more triangles than allowed
  bool contour(SurfaceMesh &mesh);

 private:
  struct CellVertices {
    CellSheets sheets;
    std::uint32_t first;  ///< vertex of sheet 0
  };
  CellPlace corner(const CellPlace &cell, int k) const
  {
    return {cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2)};
  }
  Crossing crossing(const CellPlace &cell, const CellEdge &edge) const;
  bool meetsWithin(const CellPlace &cell, const std::vector<int> &surfaces, Vec3<double> &x) const;
  Sheet sheetOf(const CellPlace &cell, const CellSheets &sheets, int sheet) const;
  std::vector<int> around(const CellPlace &cell, const std::vector<int> &own) const;
  Vec3<double> vertex(const CellPlace &cell, const Sheet &sheet, const std::vector<int> &further) const;
  Vec3<double> meeting(const std::vector<int> &surfaces, Vec3<double> x) const;
  bool onBody(const Vec3<double> &x) const { return std::abs(solid_.at(x).distance) < rounding * h_; }
  bool within(const CellPlace &cell, const Vec3<double> &x) const { return grid_.cellAt(x) == cell; }
  bool alongEdge(const CellPlace &cell, const std::vector<int> &pair, Vec3<double> &x) const;
  void addFacets(const CellPlace &cell, int edge, SurfaceMesh &mesh) const;

  const SolidTree &solid_;
  double h_, reach_;
  SignGrid grid_;
  std::unordered_map<std::uint64_t, CellVertices> made_;
  std::unordered_map<std::uint64_t, std::vector<int>> surfaces_;  ///< that cross a cell
};

/// By regula falsi with the weights of Dowell and Jarratt (BIT 11 (1971) 168), which halve that of an end that stays.
Crossing DualContour::crossing(const CellPlace &cell, const CellEdge &edge) const
{
  Vec3<double> a = grid_.place(corner(cell, edge.low)), b = grid_.place(corner(cell, edge.high));
  double fa = solid_.at(a).distance, fb = solid_.at(b).distance;
  Vec3<double> x = a;
  SolidTree::Value v = solid_.at(a);
  for (int k = 0; k < 60 && std::abs(fb - fa) > 0.0; ++k) {
    x = a + (b - a) * (fa / (fa - fb));
    v = solid_.at(x);
    if (std::abs(v.distance) < 1e-14 * h_ || dot(b - a, b - a) < 1e-26 * h_ * h_) break;
    if ((v.distance > 0.0) == (fb > 0.0)) {
      b = x;
      fb = v.distance;
      fa *= 0.5;
    } else {
      a = x;
      fa = v.distance;
      fb *= 0.5;
    }
  }
  return {x, v.surface};
}

/// The point near \p x that all the surfaces share, by damped least squares (Levenberg, Quart. Appl. Math. 2 (1944)
/// 164): it does not move along a surface or an edge, and hardly across where two are nearly parallel.
Vec3<double> DualContour::meeting(const std::vector<int> &surfaces, Vec3<double> x) const
{
  constexpr double damping = 1e-2;
  for (int step = 0; step < 40; ++step) {
    Vec3<double> m[3] = {{damping, 0, 0}, {0, damping, 0}, {0, 0, damping}}, r{0, 0, 0};
    for (const int s : surfaces) {
      const SmoothSurface::Value v = solid_.surface(s).at(x);
      for (int d = 0; d < 3; ++d) m[d] += v.gradient * v.gradient[d];
      r += v.gradient * v.distance;
    }
    const Vec3<double> c = cross(m[1], m[2]);
    const double all = dot(m[0], c);
    const Vec3<double> move{dot(r, c) / all, dot(m[0], cross(r, m[2])) / all, dot(m[0], cross(m[1], r)) / all};
    x -= move;
    if (dot(move, move) < 1e-30 * h_ * h_) break;
  }
  return x;
}

/// Moves \p x along the edge of two surfaces into the middle of what the cell has of it.
bool DualContour::alongEdge(const CellPlace &cell, const std::vector<int> &pair, Vec3<double> &x) const
{
  for (int step = 0; step < 3; ++step) {
    const Vec3<double> t = cross(solid_.surface(pair[0]).at(x).gradient, solid_.surface(pair[1]).at(x).gradient);
    const Vec3<double> from = (x - grid_.place(cell)) * (1.0 / h_);
    double lo = -INFINITY, hi = INFINITY;
    for (int d = 0; d < 3; ++d) {
      if (t[d] == 0.0) continue;
      const double one = -from[d] / t[d], two = (1.0 - from[d]) / t[d];
      lo = std::max(lo, std::min(one, two));
      hi = std::min(hi, std::max(one, two));
    }
    if (!(lo < hi) || !std::isfinite(hi - lo)) return false;
    x = meeting(pair, x + t * (0.5 * (lo + hi) * h_));
    if (within(cell, x)) return true;
  }
  return false;
}

/// Where all these surfaces meet on the body, in this cell.
bool DualContour::meetsWithin(const CellPlace &cell, const std::vector<int> &surfaces, Vec3<double> &x) const
{
  x = meeting(surfaces, x);
  if (!within(cell, x) && !(surfaces.size() == 2 && alongEdge(cell, surfaces, x))) return false;
  for (const int s : surfaces)
    if (std::abs(solid_.surface(s).at(x).distance) > rounding * h_) return false;
  return onBody(x);
}

/// \p further surfaces cross cells around this one: their edge with one of its own may run through it between
/// crossings.
Vec3<double> DualContour::vertex(const CellPlace &cell, const Sheet &sheet, const std::vector<int> &further) const
{
  for (const Vec3<double> &tip : solid_.tips())
    if (within(cell, tip) && onBody(tip)) return tip;
  const std::vector<int> &own = sheet.surfaces;
  Vec3<double> x;
  const auto found = [&](std::vector<int> more) {
    more.insert(more.end(), own.begin(), own.end());
    return meetsWithin(cell, more, x = sheet.middle);
  };
  if (own.size() < 3) {
    for (std::size_t i = 0; own.size() == 1 && i < further.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (found({further[i], further[j]})) return x;
    for (const int s : further)
      if (found({s})) return x;
  }
  if (own.size() == 1) return meeting(own, sheet.middle);
  if (found({})) return x;
  for (std::size_t i = 0; own.size() > 2 && i < own.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (meetsWithin(cell, {own[j], own[i]}, x = sheet.middle)) return x;
  // an edge that reaches out of the cell between its crossings
  x = meeting(own, sheet.middle);
  const Vec3<double> off = x - sheet.middle;
  if (dot(off, off) < reach_ * reach_ * h_ * h_ && onBody(x)) return x;
  return meeting({sheet.most}, sheet.middle);
}

/// The facets across an edge of the grid: a quad of the four cells around it, cut along the diagonal that is on the
/// body.
void DualContour::addFacets(const CellPlace &cell, int number, SurfaceMesh &mesh) const
{
  const CellEdge edge = cellEdge(number);
  const int b = (edge.axis + 1) % 3, c = (edge.axis + 2) % 3;
  std::array<std::uint32_t, 4> v;
  for (std::size_t k = 0; k < 4; ++k) {
    const int u = k == 1 || k == 2, w = k >= 2;  // counter-clockwise seen from the upper end of the edge
    CellPlace around = cell;
    around[static_cast<std::size_t>(b)] += u - 1;
    around[static_cast<std::size_t>(c)] += w - 1;
    const CellVertices &m = made_.at(grid_.index(around));
    const int sameEdge = 4 * edge.axis + (1 - u) + 2 * (1 - w);
    v[k] = m.first + static_cast<std::uint32_t>(m.sheets.sheet[static_cast<std::size_t>(sameEdge)]);
  }
  if (!grid_.inside(corner(cell, edge.low))) std::swap(v[1], v[3]);
  const auto at = [&](std::size_t k) {
    const auto &p = mesh.vertex[v[k % 4]];
    return Vec3<double>{p[0], p[1], p[2]};
  };
  // how well each diagonal does: no triangle folded over, then the nearer to the body, then the less thin triangles
  double upright[2], off[2], area[2];
  for (std::size_t k = 0; k < 2; ++k) {
    upright[k] = area[k] = INFINITY;
    off[k] = std::abs(solid_.at((at(k) + at(k + 2)) * 0.5).distance);
    for (const std::size_t m : {k, k + 2}) {
      const Vec3<double> n = cross(at(m + 1) - at(m), at(m + 2) - at(m)),
                         x = (at(m) + at(m + 1) + at(m + 2)) * (1.0 / 3.0);
      const SolidTree::Value near = solid_.at(x);
      const double size = std::sqrt(dot(n, n)), out = near.sign * dot(solid_.surface(near.surface).at(x).gradient, n);
      area[k] = std::min(area[k], size);
      upright[k] = std::min(upright[k], size > 0.0 ? out / size : -1.0);
    }
  }
  constexpr double lean = 0.2;
  std::size_t first = area[1] > area[0];
  if (std::min(upright[0], upright[1]) < lean) first = upright[1] > upright[0];
  else if (std::abs(off[0] - off[1]) > 1e-3 * h_) first = off[1] < off[0];
  mesh.triangle.push_back({v[first], v[first + 1], v[first + 2]});
  mesh.triangle.push_back({v[first + 2], v[(first + 3) % 4], v[first]});
}

Sheet DualContour::sheetOf(const CellPlace &cell, const CellSheets &sheets, int sheet) const
{
  Sheet s{{}, -1, {0.0, 0.0, 0.0}};
  std::vector<int> all;
  for (int e = 0; e < 12; ++e) {
    if (sheets.sheet[static_cast<std::size_t>(e)] != sheet) continue;
    const Crossing c = crossing(cell, cellEdge(e));
    all.push_back(c.surface);
    s.middle += c.at;
  }
  s.middle = s.middle * (1.0 / static_cast<double>(all.size()));
  std::sort(all.begin(), all.end());
  s.surfaces = all;
  s.surfaces.erase(std::unique(s.surfaces.begin(), s.surfaces.end()), s.surfaces.end());
  for (const int k : s.surfaces)
    if (s.most < 0 || std::count(all.begin(), all.end(), k) > std::count(all.begin(), all.end(), s.most)) s.most = k;
  return s;
}

/// Surfaces that cross the 26 cells around, but for \p own.
std::vector<int> DualContour::around(const CellPlace &cell, const std::vector<int> &own) const
{
  std::vector<int> found;
  for (int k = 0; k < 27; ++k) {
    const auto at = surfaces_.find(grid_.index({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1}));
    if (at == surfaces_.end()) continue;
    for (const int s : at->second)
      if (std::find(own.begin(), own.end(), s) == own.end() && std::find(found.begin(), found.end(), s) == found.end())
        found.push_back(s);
  }
  return found;
}

bool DualContour::contour(SurfaceMesh &mesh)
{
  std::vector<Sheet> sheet;
  for (const CellPlace &cell : grid_.cells()) {
    const CellVertices made{grid_.sheets(cell), static_cast<std::uint32_t>(sheet.size())};
    std::vector<int> &surfaces = surfaces_[grid_.index(cell)];
    for (int s = 0; s < made.sheets.count; ++s) {
      sheet.push_back(sheetOf(cell, made.sheets, s));
      surfaces.insert(surfaces.end(), sheet.back().surfaces.begin(), sheet.back().surfaces.end());
    }
    made_.emplace(grid_.index(cell), made);
    if (static_cast<double>(sheet.size()) > mostTriangles / 2.0) return false;
  }
  for (const CellPlace &cell : grid_.cells()) {
    const CellVertices &made = made_.at(grid_.index(cell));
    for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(made.sheets.count); ++s) {
      const Sheet &of = sheet[made.first + s];
      // of two sheets in a cell, who has an edge between crossings is not known
      const Vec3<double> x = vertex(cell, of, made.sheets.count == 1 ? around(cell, of.surfaces) : std::vector<int>{});
      mesh.vertex.push_back({x.x, x.y, x.z});
    }
  }
  // every crossed edge is the first of its axis in one cell
  for (const CellPlace &cell : grid_.cells())
    for (int axis = 0; axis < 3; ++axis)
      if (grid_.sheets(cell).sheet[static_cast<std::size_t>(4 * axis)] >= 0) addFacets(cell, 4 * axis, mesh);
  mesh.zone.assign(mesh.triangle.size(), 0);
  return true;
}

/// Triangles that face into the body: where an edge crosses cells at their corners, facets may fold over.
std::size_t countFolded(const SolidTree &solid, const SurfaceMesh &mesh, double spacing)
{
  std::size_t folded = 0;
  for (const auto &t : mesh.triangle) {
    const auto at = [&](std::size_t c) {
      const auto &p = mesh.vertex[t[c]];
      return Vec3<double>{p[0], p[1], p[2]};
    };
    const Vec3<double> n = cross(at(1) - at(0), at(2) - at(0)), middle = (at(0) + at(1) + at(2)) * (1.0 / 3.0);
    const double size = std::sqrt(dot(n, n));
    if (!(size > 0.0)) continue;
    const Vec3<double> out = n * (0.25 * spacing / size);
    folded += solid.at(middle - out).distance > 0.1 * spacing && solid.at(middle + out).distance < -0.1 * spacing;
  }
  return folded;
}

}  // namespace

SurfaceMesh combinedSurface(const ParsedShape &p, double spacing)
{
  if (!(spacing > 0.0)) p.refuse("it needs the length of the cells that find its triangles, keyword spacing");
  const SolidTree solid(p);
  for (int d = 0; d < 3; ++d)
    if (!(solid.lo()[d] < solid.hi()[d])) p.refuse("nothing is left of it: the bodies have nothing in common");
  if (SignGrid::nodes(solid, spacing) > mostNodes) p.refuse(fmt::format(tooFine, mostNodes, "nodes of the grid"));
  SurfaceMesh best;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  // nodes should not lie on faces at round numbers: shifts without a ratio to the spacing, others where facets fold
  // over
  for (int attempt = 1; attempt <= 12 && fewest > 0; ++attempt) {
    const double a = 0.3819660113 * attempt, b = 0.7548776662 * attempt, c = 0.5698402910 * attempt;
    DualContour body(solid, spacing, {a - std::floor(a), b - std::floor(b), c - std::floor(c)},
                     attempt <= 8 ? 1.0 : 0.5 * (attempt % 2));
    if (body.empty()) continue;
    SurfaceMesh mesh;
    mesh.zoneName.push_back(p.name);
    if (!body.contour(mesh)) p.refuse(fmt::format(tooFine, mostTriangles, "triangles"));
    SurfaceMesh cleaned = mesh;
    const std::size_t bad =
        countFolded(solid, mesh, spacing) + (cleanSurface(cleaned).closed() ? 0 : mesh.triangle.size());
    if (bad >= fewest) continue;
    fewest = bad;
    best = std::move(mesh);
  }
  if (best.triangle.empty())
    p.refuse(fmt::format("nothing is left of it, or nothing as thick as the spacing, {:g}", spacing));
  return best;
}

}  // namespace gpudem
