// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Common declarations of parameters. Host code.
#pragma once

#include "gpudem/contact_model.h"

#include <cmath>
#include <limits>

namespace gpudem {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double aboveZero = std::numeric_limits<double>::min();

inline ParameterInfo notNegative(const char *name, const char *unit)
{
  return {name, unit, 0.0, unbounded, false};
}
inline ParameterInfo positive(const char *name, const char *unit)
{
  return {name, unit, aboveZero, unbounded, false};
}
inline ParameterInfo youngParameter()
{
  return positive("E", "pressure");
}
inline ParameterInfo poissonParameter()
{
  return {"nu", "-", std::nextafter(-1.0, 0.0), 0.5, false};
}
inline ParameterInfo frictionParameter(const char *name = "mu")
{
  return {name, "-", 0.0, 10000.0, false};
}
/// Second parameter of every normal sub-model; unit and range are those of the damping sub-model.
inline ParameterInfo dampingParameter()
{
  return {"eta", "see damping", 0.0, unbounded, false};
}

/// Moduli of a material in contact with itself: E* = E/(2 (1 - nu^2)), G* = E/(4 (2 - nu)(1 + nu)).
inline ContactModuli selfContact(double young, double poisson)
{
  return {young / (2.0 * (1.0 - poisson) * (1.0 + poisson)), young / (4.0 * (2.0 - poisson) * (1.0 + poisson)), true};
}

}  // namespace gpudem
