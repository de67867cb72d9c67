// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the words of a shape say: box(...), or shapes in shapes, difference(box(...),sphere(...)).
#pragma once

#include "gpudem/errors.h"

#include <string>
#include <vector>

namespace gpudem {

/// A shape and its values, or an operation and its operands.
struct ParsedShape {
  std::string text;                  ///< as it stands in the script
  std::string name;                  ///< box, ..., or union, intersection, difference
  std::vector<double> value;         ///< in the order of the words; an axis as 0, 1 or 2
  std::vector<ParsedShape> operand;  ///< of an operation, two or more, from left to right

  bool combined() const { return !operand.empty(); }
  /// \throws Error of this shape
  [[noreturn]] void refuse(const std::string &why) const;
};

/// Values are in their ranges: extents and radii above 0, ends in order; operands are closed.
/// \throws Error that names the shape and what would be right
ParsedShape parseShape(const std::string &text);

}  // namespace gpudem
