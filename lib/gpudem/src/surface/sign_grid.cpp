// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/sign_grid.hpp"

#include <algorithm>
#include <cmath>

namespace gpudem {

namespace {

constexpr int block = 8;        // nodes, that one distance may decide
constexpr double margin = 1.5;  // cells around the body

/// The four edges around the face of a cell, and the corners between them: corner k is where edge k begins.
struct Face {
  std::array<int, 4> edge, corner;
};
Face cellFace(int axis, int side)
{
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  const auto corner = [&](int p, int q) { return side << axis | p << b | q << c; };
  // along b the next axis is c and the one after is the face's; along c these are the face's and b
  return {{4 * b + 0 + 2 * side, 4 * c + side + 2 * 1, 4 * b + 1 + 2 * side, 4 * c + side + 2 * 0},
          {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}};
}

bool bit(int corners, int k)
{
  return corners >> k & 1;
}

}  // namespace

CellEdge cellEdge(int edge)
{
  const int a = edge / 4, low = (edge & 1) << (a + 1) % 3 | (edge >> 1 & 1) << (a + 2) % 3;
  return {a, low, low | 1 << a};
}

double SignGrid::nodes(const SolidTree &solid, double spacing)
{
  double n = 1.0;
  for (int d = 0; d < 3; ++d) n *= (solid.hi()[d] - solid.lo()[d]) / spacing + 2.0 * margin + 2.0;
  return n;
}

SignGrid::SignGrid(const SolidTree &solid, double spacing, const Vec3<double> &shift) : solid_(solid), spacing_(spacing)
{
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    origin_[d] = solid.lo()[d] - (margin + shift[d]) * spacing;
    size_[k] = static_cast<int>(std::ceil((solid.hi()[d] - origin_[d]) / spacing + margin)) + 1;
  }
  inside_.assign(index({0, 0, size_[2]}), false);
  findSigns();
  separateSheets();
}

Vec3<double> SignGrid::place(const CellPlace &p) const
{
  return origin_ +
         Vec3<double>{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])} * spacing_;
}

CellPlace SignGrid::cellAt(const Vec3<double> &x) const
{
  CellPlace p;
  for (int d = 0; d < 3; ++d)
    p[static_cast<std::size_t>(d)] = static_cast<int>(std::floor((x[d] - origin_[d]) / spacing_));
  return p;
}

void SignGrid::findSigns()
{
  std::vector<CellPlace> near;
  for (int z = 0; z < size_[2]; z += block)
    for (int y = 0; y < size_[1]; y += block)
      for (int x = 0; x < size_[0]; x += block) {
        const CellPlace first{x, y, z};
        // one more than the block, so that its cells know all their corners
        const double half = 0.5 * block;
        const Vec3<double> centre = place(first) + Vec3<double>{half, half, half} * spacing_;
        const double distance = solid_.at(centre).distance;
        const CellPlace last{std::min(x + block, size_[0]), std::min(y + block, size_[1]),
                             std::min(z + block, size_[2])};
        if (std::abs(distance) <= 1.01 * std::sqrt(3.0) * half * spacing_) {
          near.push_back(first);
          fill(first, last);
        } else if (distance < 0.0) {
          for (int k = z; k < last[2]; ++k)
            for (int j = y; j < last[1]; ++j)
              for (int i = x; i < last[0]; ++i) inside_[index({i, j, k})] = true;
        }
      }
  for (const CellPlace &first : near)
    findCells(first, {std::min(first[0] + block, size_[0] - 1), std::min(first[1] + block, size_[1] - 1),
                      std::min(first[2] + block, size_[2] - 1)});
}

void SignGrid::fill(const CellPlace &first, const CellPlace &last)
{
  for (int k = first[2]; k < last[2]; ++k)
    for (int j = first[1]; j < last[1]; ++j)
      for (int i = first[0]; i < last[0]; ++i) inside_[index({i, j, k})] = solid_.at(place({i, j, k})).distance <= 0.0;
}

void SignGrid::findCells(const CellPlace &first, const CellPlace &last)
{
  for (int k = first[2]; k < last[2]; ++k)
    for (int j = first[1]; j < last[1]; ++j)
      for (int i = first[0]; i < last[0]; ++i)
        if (crossed({i, j, k})) crossed_.push_back({i, j, k});
}

int SignGrid::corners(const CellPlace &c) const
{
  int all = 0;
  for (int k = 0; k < 8; ++k)
    all |= static_cast<int>(inside({c[0] + (k & 1), c[1] + (k >> 1 & 1), c[2] + (k >> 2)})) << k;
  return all;
}

bool SignGrid::crossed(const CellPlace &c) const
{
  for (std::size_t d = 0; d < 3; ++d)
    if (c[d] < 0 || c[d] + 1 >= size_[d]) return false;
  const int all = corners(c);
  return all != 0 && all != 255;
}

std::uint64_t SignGrid::face(const CellPlace &cell, int axis, int side) const
{
  CellPlace c = cell;
  c[static_cast<std::size_t>(axis)] += side;
  return 3 * index(c) + static_cast<std::uint64_t>(axis);
}

/// On a face with two corners inside that lie across: is what is inside connected there?
bool SignGrid::joinsInside(const CellPlace &cell, int axis, int side) const
{
  CellPlace c = cell;
  c[static_cast<std::size_t>(axis)] += side;
  Vec3<double> middle{0.5, 0.5, 0.5};
  middle[axis] = 0.0;
  const bool joins = solid_.at(place(c) + middle * spacing_).distance <= 0.0;
  return joins != (turned_.count(face(cell, axis, side)) > 0);
}

/// Nielson, IEEE Visualization 2004, 489: each loop of crossed edges around a cell is a sheet.
CellSheets SignGrid::sheets(const CellPlace &cell) const
{
  const int all = corners(cell);
  std::array<int, 12> root;
  for (int e = 0; e < 12; ++e) root[static_cast<std::size_t>(e)] = e;
  const auto find = [&](int e) {
    while (root[static_cast<std::size_t>(e)] != e) e = root[static_cast<std::size_t>(e)];
    return e;
  };
  const auto link = [&](int e, int f) { root[static_cast<std::size_t>(find(e))] = find(f); };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const Face f = cellFace(axis, side);
      std::array<int, 4> hit{};
      int hits = 0;
      for (std::size_t k = 0; k < 4; ++k)
        if (bit(all, f.corner[k]) != bit(all, f.corner[(k + 1) % 4])) hit[static_cast<std::size_t>(hits++)] = f.edge[k];
      if (hits == 2) {
        link(hit[0], hit[1]);
      } else if (hits == 4) {
        // edges k and k + 1 meet at corner k + 1: around corners 1 and 3, or around 0 and 2
        const bool aroundOdd = bit(all, f.corner[1]) != joinsInside(cell, axis, side);
        link(f.edge[aroundOdd ? 0 : 3], f.edge[aroundOdd ? 1 : 0]);
        link(f.edge[aroundOdd ? 2 : 1], f.edge[aroundOdd ? 3 : 2]);
      }
    }
  CellSheets s;
  s.count = 0;
  s.sheet.fill(-1);
  for (int e = 0; e < 12; ++e) {
    const CellEdge edge = cellEdge(e);
    if (bit(all, edge.low) == bit(all, edge.high)) continue;
    const auto first = static_cast<std::size_t>(find(e));
    if (s.sheet[first] < 0) s.sheet[first] = s.count++;
    s.sheet[static_cast<std::size_t>(e)] = s.sheet[first];
  }
  return s;
}

/// Where one sheet goes through a face twice in both of its cells, four facets would meet at one edge (Wenger,
/// Isosurfaces, CRC Press 2013): joining the face the other way cuts the sheets in two. Each turn makes more sheets, so
/// it ends.
void SignGrid::separateSheets()
{
  for (bool again = true; again;) {
    again = false;
    for (const CellPlace &cell : crossed_)
      for (int axis = 0; axis < 3; ++axis) {
        CellPlace other = cell;
        if (--other[static_cast<std::size_t>(axis)] < 0) continue;
        const Face low = cellFace(axis, 0), high = cellFace(axis, 1);
        const int all = corners(cell);
        const auto at = [&](std::size_t k) { return bit(all, low.corner[k]); };
        if (at(0) == at(1) || at(1) == at(2) || at(2) == at(3)) continue;
        const auto one = [](const CellSheets &s, const Face &f) {
          return s.sheet[static_cast<std::size_t>(f.edge[0])] == s.sheet[static_cast<std::size_t>(f.edge[2])] &&
                 s.sheet[static_cast<std::size_t>(f.edge[1])] == s.sheet[static_cast<std::size_t>(f.edge[3])] &&
                 s.sheet[static_cast<std::size_t>(f.edge[0])] == s.sheet[static_cast<std::size_t>(f.edge[1])];
        };
        if (!one(sheets(cell), low) || !one(sheets(other), high)) continue;
        const std::uint64_t key = face(cell, axis, 0);
        if (!turned_.erase(key)) turned_.insert(key);
        again = true;
      }
  }
}

}  // namespace gpudem
