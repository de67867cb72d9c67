// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The motion that all grains share. Only displacements against each other wear the rows out, so each grain's
/// displacement since the rows were built is measured in a frame that moves with the middle of all velocities.
#pragma once

#include "base/particle.hpp"

#include <algorithm>
#include <cmath>

namespace gpudem {

/// Smallest box around the velocities of some grains (distance/time).
struct VelocityRange {
  float lo[3], hi[3];
};
struct JoinRanges {
  GPUDEM_HD VelocityRange operator()(const VelocityRange &a, const VelocityRange &b) const
  {
    VelocityRange r;
    for (int d = 0; d < 3; ++d) {
      r.lo[d] = a.lo[d] < b.lo[d] ? a.lo[d] : b.lo[d];
      r.hi[d] = a.hi[d] > b.hi[d] ? a.hi[d] : b.hi[d];
    }
    return r;
  }
};
template <class Real>
struct GrainVelocity {
  const Motion<Real> *motion;
  GPUDEM_HD VelocityRange operator()(std::uint32_t i) const
  {
    const Motion<Real> m = motion[i];
    const float x = static_cast<float>(m.vx), y = static_cast<float>(m.vy), z = static_cast<float>(m.vz);
    return {{x, y, z}, {x, y, z}};
  }
};

class CommonDrift {
 public:
  void forget() { *this = CommonDrift(); }

  /// The rows are new. \param mostRoom for room() (distance)
  void start(const VelocityRange &range, double timestep, double skin, double mostRoom)
  {
    steps_ = 0;
    double spread2 = 0.0;
    for (int d = 0; d < 3; ++d) {
      step_[d] = 0.5 * timestep * (static_cast<double>(range.lo[d]) + static_cast<double>(range.hi[d]));
      const double half = 0.5 * timestep * (static_cast<double>(range.hi[d]) - static_cast<double>(range.lo[d]));
      spread2 += half * half;
    }
    const double common = std::sqrt(dot(step_, step_)), spread = std::sqrt(spread2);
    // the frame leaves the walls behind: what may reach them is marked with this much more room
    room_ = std::min(mostRoom, 0.625 * skin * common / std::max(spread, 1e-9 * common));
    if (!(common > 0.1 * spread) || !std::isfinite(common)) {
      step_ = {0.0, 0.0, 0.0};
      room_ = 0.0;
    }
  }

  const Vec3<double> &perStep() const { return step_; }
  /// Displacement of the frame once the coming drift is done (distance).
  Vec3<double> next() const { return step_ * (steps_ + 1.0); }
  /// Largest displacement of the frame before the next rebuild (distance).
  double room() const { return room_; }
  bool spent() const { return std::sqrt(dot(step_, step_)) * steps_ > room_; }
  void drifted(int steps) { steps_ += steps; }
  int steps() const { return steps_; }  ///< since the rows were built

 private:
  Vec3<double> step_{0.0, 0.0, 0.0};
  double room_ = 0.0;
  int steps_ = 0;
};

/// A displacement in units of the coarse coordinates, modulo the window.
inline std::uint32_t coarseUnits(double displacement, double unit32)
{
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(displacement / unit32)));
}

}  // namespace gpudem
