// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/servo.h"

#include <algorithm>

namespace gpudem {

void Servo::update(double now, double load)
{
  place = placeAt(now);
  since = now;
  const double wanted = std::clamp(gain * (target + load), -fastest, fastest);
  speed += smoothing * (wanted - speed);
}

BodyMotion Servo::motionAt(double now) const
{
  const double at = placeAt(now);
  if (kind == Kind::Torque) return turned(point, axis, at, speed);
  std::array<double, 3> displacement, velocity;
  for (std::size_t d = 0; d < 3; ++d) {
    displacement[d] = at * axis[d];
    velocity[d] = speed * axis[d];
  }
  return displaced(displacement, velocity);
}

}  // namespace gpudem
