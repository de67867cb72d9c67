// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file When the marks of the inner list must be refreshed (contact_warp.hpp). Host code.
///
/// A mark is right as long as no grain moved by more than half of the inner skin since all distances were measured.
/// The host plans a number of steps between two measurements from the longest step seen; the device stops the queue at
/// a step that is longer than planned.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace gpudem {

class InnerList {
 public:
  /// \param skin       of the rows
  /// \param resolution of a displacement (distance)
  void setSkin(double skin, double resolution)
  {
    skin_ = share * skin;
    resolution_ = resolution;
    forget();
  }

  /// Inner reach less contact (distance).
  float skin() const { return static_cast<float>(skin_); }

  /// Squared displacement of a step that the plan allows for (distance^2).
  float stepLimit2() const
  {
    if (planned_ == 0) return std::numeric_limits<float>::infinity();
    const double limit = std::max(0.0, 0.5 * skin_ / planned_ - resolution_);
    return static_cast<float>(limit * limit);
  }

  /// Must the next evaluation of the force measure all distances?
  bool due() const { return drifts_ > planned_; }
  void measured() { drifts_ = 0; }
  void drifted() { ++drifts_; }
  void forget() { drifts_ = never; }

  /// Plan anew. \param longestStep2 largest squared displacement of a step that was seen, 0 if none was
  void plan(float longestStep2)
  {
    if (!(longestStep2 > 0.0f)) return;
    const double step = 1.1 * std::sqrt(static_cast<double>(longestStep2)) + resolution_;
    const int wanted = static_cast<int>(std::min<double>(most, 0.5 * skin_ / step));
    if (wanted >= planned_ && 4 * wanted <= 5 * planned_) return;
    planned_ = wanted;
    forget();
  }

 private:
  static constexpr int most = 32, never = 1 << 30;
  static constexpr double share = 0.2;  ///< of the skin; 0.1 and 0.3 are 1 % apart from it

  double skin_ = 0.0, resolution_ = 0.0;
  int planned_ = 0;      ///< drifts between two measurements
  int drifts_ = never;   ///< since the last measurement
};

}  // namespace gpudem
