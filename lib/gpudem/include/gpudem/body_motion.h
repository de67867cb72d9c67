// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Place and velocity of a rigid body, from motions that are put together.
#pragma once

#include <array>

namespace gpudem {

/// A point X of the body is at rotation X + displacement.
struct BodyMotion {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row
  std::array<double, 3> displacement{};                       ///< place of the body's origin (distance)
  std::array<double, 3> velocity{};                           ///< of the body's origin (distance/time)
  std::array<double, 3> angularVelocity{};                    ///< (radian/time)
};

/// Moved without turning.
BodyMotion displaced(const std::array<double, 3> &displacement, const std::array<double, 3> &velocity);
/// Turned by \p angle (radian), which changes with \p rate (radian/time), about the unit vector \p axis through
/// \p point (right-hand rule).
BodyMotion turned(const std::array<double, 3> &point, const std::array<double, 3> &axis, double angle, double rate);
/// Tilted by \p tilt (radian) about \p point, so that what lay along the unit vector \p axis leans to a side that goes
/// round the axis, \p angle and \p rate as above; the body does not spin: R = A(angle) B(tilt) A(-angle).
BodyMotion nutating(const std::array<double, 3> &point, const std::array<double, 3> &axis, double tilt, double angle,
                    double rate);
/// \p first, and all of it moved by \p second.
BodyMotion composed(const BodyMotion &second, const BodyMotion &first);

/// Place and velocity of the point \p x of the body.
std::array<double, 3> placeOf(const BodyMotion &motion, const std::array<double, 3> &x);
std::array<double, 3> velocityOf(const BodyMotion &motion, const std::array<double, 3> &x);

}  // namespace gpudem
