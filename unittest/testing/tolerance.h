// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Tolerances as a type: relative to a stated magnitude, per precision.
#pragma once

#include "gpudem/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gpudem::testing {

/// |a - b| <= relative * magnitude. The magnitude is that of the quantity's scale, not of a or b.
struct Tolerance {
  double relative;
  double magnitude;
  double absolute() const { return relative * magnitude; }
};

/// Round-off of one evaluation, amplified by at most \p operations.
inline Tolerance roundOff(Precision p, double magnitude, double operations = 16)
{
  return {operations * (p == Precision::Double ? 2.3e-16 : 1.2e-7), magnitude};
}

/// Paths of many grains that collide: round-off, that of \p operations to begin with, grows about tenfold in a hundred
/// steps of the clouds used here.
inline Tolerance alongThePath(Precision p, double magnitude, double hundredSteps, double operations)
{
  return {std::pow(10.0, hundredSteps) * operations * (p == Precision::Double ? 1e-14 : 2e-7), magnitude};
}

/// A sum of weights, each of which balancing rounds to about a thousandth of the mean one.
inline Tolerance weightRounding(double magnitude)
{
  return {1e-3, magnitude};
}

inline ::testing::AssertionResult near(double a, double b, const Tolerance &t)
{
  if (std::abs(a - b) <= t.absolute()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a << " and " << b << " differ by " << std::abs(a - b) << ", more than "
                                       << t.absolute() << " (" << t.relative << " of " << t.magnitude << ")";
}

/// Corners, areas and volumes of built-in shapes: coordinates of order 1 in double precision, sums over some 10^5 triangles.
constexpr double shapeRoundOff = 1e-11;

}  // namespace gpudem::testing
