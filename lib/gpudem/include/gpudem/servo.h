// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A body that moves until the load on it is the one that is asked for.
#pragma once

#include "gpudem/body_motion.h"

namespace gpudem {

/// An actuator that pushes a body along (or turns it about) an axis with a given force (torque): at each update its
/// speed goes a tenth of the way to one proportional to what the grains do not yet answer, up to a limit. The place
/// follows by integration, so that a load once reached is held with no error that remains.
///
/// Linear stability, g the gain, k and c stiffness and damping of the grains against the body, dt the time between
/// updates: v' = v + a (g (target - k x - c v) - v), x' = x + v' dt decays for g (k dt + 2 c) < 2 (2 - a)/a = 38, by
/// sqrt(1 - a) at each update if it oscillates, which it does for 4 g k dt > a.
class Servo {
 public:
  enum class Kind { Force, Torque };
  Kind kind = Kind::Force;
  std::array<double, 3> axis{};   ///< of unit length: where it pushes, or turns
  std::array<double, 3> point{};  ///< Torque: on the axis (distance)
  double target = 0;              ///< of the actuator (force, or force distance)
  double fastest = 0;             ///< limit of the speed (distance/time, or radian/time)
  double gain = 0;                ///< speed per missing load (distance/time/force, or radian/time/(force distance))

  static constexpr double smoothing = 0.1;  ///< a: dashpots answer the speed at once, which a = 1 would feed back

  double place = 0;  ///< at \c since (distance or radian)
  double speed = 0;  ///< from then on (distance/time or radian/time)
  double since = 0;  ///< time of the last update (time)

  /// \param load component of the grains' force (torque about the axis) along the axis: negative if they resist
  void update(double now, double load);
  double placeAt(double now) const { return place + speed * (now - since); }
  BodyMotion motionAt(double now) const;
};

}  // namespace gpudem
