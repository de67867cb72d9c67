// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Which nodes of a grid are inside a body, and how its surface goes through the cells.
#pragma once

#include "surface/solid_tree.hpp"

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace gpudem {

using CellPlace = std::array<int, 3>;

/// Corner c of a cell is at the bits of c, x first. Edge 4 a + u + 2 v runs along axis a, at u along the next axis and
/// v along the one after.
struct CellEdge {
  int axis, low, high;  ///< corners
};
CellEdge cellEdge(int edge);

/// Sheets of the surface in one cell: of each edge that it crosses, the sheet, else -1.
struct CellSheets {
  std::array<int, 12> sheet;
  int count;
};

/// Nodes around the body at a distance of the spacing, with a margin.
class SignGrid {
 public:
  /// \param shift of the nodes, a part of the spacing in each direction
  SignGrid(const SolidTree &solid, double spacing, const Vec3<double> &shift);
  /// Number of nodes that a grid would have.
  static double nodes(const SolidTree &solid, double spacing);

  bool inside(const CellPlace &node) const { return inside_[index(node)]; }
  Vec3<double> place(const CellPlace &node) const;
  CellPlace cellAt(const Vec3<double> &x) const;
  bool crossed(const CellPlace &cell) const;                        ///< does the surface go through it?
  const std::vector<CellPlace> &cells() const { return crossed_; }  ///< those that are crossed
  CellSheets sheets(const CellPlace &cell) const;
  std::uint64_t index(const CellPlace &p) const
  {
    return static_cast<std::uint64_t>(p[0]) +
           static_cast<std::uint64_t>(size_[0]) *
               (static_cast<std::uint64_t>(p[1]) +
                static_cast<std::uint64_t>(size_[1]) * static_cast<std::uint64_t>(p[2]));
  }

 private:
  void findSigns();
  void fill(const CellPlace &first, const CellPlace &last);
  void findCells(const CellPlace &first, const CellPlace &last);
  void separateSheets();
  int corners(const CellPlace &cell) const;
  std::uint64_t face(const CellPlace &cell, int axis, int side) const;
  bool joinsInside(const CellPlace &cell, int axis, int side) const;

  const SolidTree &solid_;
  double spacing_;
  Vec3<double> origin_;
  CellPlace size_;  ///< nodes
  std::vector<bool> inside_;
  std::vector<CellPlace> crossed_;
  std::unordered_set<std::uint64_t> turned_;  ///< faces of four crossings that are joined the other way
};

}  // namespace gpudem
