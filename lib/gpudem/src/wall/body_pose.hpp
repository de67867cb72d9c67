// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Place and motion of a rigid body at one step, as a launch carries it.
#pragma once

#include "base/vec3.hpp"
#include "gpudem/body_motion.h"

#include <algorithm>
#include <cmath>

namespace gpudem {

/// A point X of the body is at row . X + displacement.
struct BodyPose {
  Vec3<double> row[3];          ///< of the rotation
  Vec3<double> displacement;    ///< (distance)
  Vec3<double> velocity, spin;  ///< of the body's origin (distance/time), of the body (radian/time)

  GPUDEM_HD Vec3<double> turned(const Vec3<double> &v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  GPUDEM_HD Vec3<double> turnedBack(const Vec3<double> &v) const
  {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z;
  }
  GPUDEM_HD Vec3<double> toBody(const Vec3<double> &x) const { return turnedBack(x - displacement); }
  /// Velocity of the body's material at \p x.
  GPUDEM_HD Vec3<double> velocityAt(const Vec3<double> &x) const { return velocity + cross(spin, x - displacement); }
};

inline BodyPose bodyPose(const BodyMotion &m)
{
  BodyPose p;
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(3 * d);
    p.row[d] = {m.rotation[k], m.rotation[k + 1], m.rotation[k + 2]};
  }
  p.displacement = {m.displacement[0], m.displacement[1], m.displacement[2]};
  p.velocity = {m.velocity[0], m.velocity[1], m.velocity[2]};
  p.spin = {m.angularVelocity[0], m.angularVelocity[1], m.angularVelocity[2]};
  return p;
}

/// Largest distance between the places of a point of the box \p lo to \p hi of the body in two poses (distance). The
/// distance is a convex function of the point, so a corner has it.
inline double largestMove(const BodyPose &a, const BodyPose &b, const Vec3<double> &lo, const Vec3<double> &hi)
{
  double most2 = 0.0;
  for (int c = 0; c < 8; ++c) {
    const Vec3<double> corner{c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z};
    const Vec3<double> move = a.turned(corner) + a.displacement - b.turned(corner) - b.displacement;
    most2 = std::max(most2, dot(move, move));
  }
  return std::sqrt(most2);
}

}  // namespace gpudem
