// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The motions of a surface, as keyword move of fix wall/gran/sdf gives them.
#ifndef LMP_GPUDEM_SURFACE_MOTION_H
#define LMP_GPUDEM_SURFACE_MOTION_H

#include "gpudem/body_motion.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

struct SurfaceMove {
  enum class Kind { Linear, Wiggle, Rotate, Nutate, Variable, Turn };
  Kind kind = Kind::Linear;
  std::array<double, 3> vector{};       ///< Linear: velocity; Wiggle: amplitude (distance/time, distance)
  std::array<double, 3> point{}, axis{};  ///< Rotate, Nutate, Turn: a point on the axis (distance), its unit vector
  double period = 0;                    ///< Wiggle, Rotate, Nutate (time)
  double tilt = 0;                      ///< Nutate (radian)
  std::vector<std::string> variable;    ///< Variable: displacement x y z, velocity x y z; Turn: angle, rate; "" is 0
};

/// Motion of the body at update->ntimestep: the moves one after the other. \param elapsed since the fix was defined
/// (time)
gpudem::BodyMotion bodyMotion(LAMMPS *lmp, const std::vector<SurfaceMove> &moves, double elapsed);

/// Name of a variable that reads particles, or is not there; empty if all can be evaluated ahead of the step.
std::string variableThatReadsParticles(LAMMPS *lmp, const std::vector<SurfaceMove> &moves);

/// Ends the run if a variable does not exist or is not of style equal.
void checkVariables(LAMMPS *lmp, const std::string &command, const std::vector<SurfaceMove> &moves);

}  // namespace LAMMPS_NS
#endif
