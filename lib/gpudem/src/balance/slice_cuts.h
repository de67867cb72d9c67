// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The search for the cuts of one level, from one summed histogram to the next.
#pragma once

#include "gpudem/slice_grid.h"

#include <vector>

namespace gpudem {

/// Cuts of one level, between known bounds that each histogram tightens.
class CutSearch {
 public:
  /// \param tolerance  share of a part's weight by which a cut may be off
  /// \param particle   weight of a mean particle: no cut is worth less than half of it
  CutSearch(const SliceLevel &level, const SliceOptions &options, double tolerance, double particle);

  bool done() const;
  /// Bins that tell where the cuts lie that are not found yet.
  SliceBins bins(int perCut) const;
  /// Tighten the bounds with the weights of bins(), summed over all ranks.
  void tighten(const SliceBins &bins, const std::vector<double> &weights);
  /// The cuts as found so far, least widths kept, written into \p level. Returns how many changed.
  int finish(SliceLevel &level, double smallest) const;

 private:
  struct Cut {
    double low, high;  // it lies between these, fractions of the box
    double old, at;    // where it was, and the best place known
    double goal;       // weight that should lie below it in its group
    double slack;      // by which it may miss that weight
    bool found;
  };
  void place(Cut &cut, const std::vector<double> &edges, const std::vector<double> &below) const;

  const SliceOptions &options_;
  std::vector<int> groupStart_;  // [groups + 1], first cut of each group
  std::vector<Cut> cuts_;
  std::vector<double> share_;  // [cuts], share of its group's ranks below it
  std::vector<int> fewest_;    // [cuts], ranks of the smaller of the two parts it separates
  std::vector<int> ranks_;     // [groups]
  double tolerance_, particle_;
  bool first_ = true;
};

}  // namespace gpudem
