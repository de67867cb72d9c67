// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The words of fix wall/gran/sdf: law, surface, what is done with the surface.
#ifndef LMP_GPUDEM_SURFACE_ARGUMENTS_H
#define LMP_GPUDEM_SURFACE_ARGUMENTS_H

#include "gpudem/scene.h"
#include "gpudem/servo.h"
#include "surface_motion.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

/// Loads of every triangle, written as VTK files. No file: not wanted.
struct FacesOutput {
  int sampleEvery = 0, writeEvery = 0;  ///< steps
  std::string file;                     ///< with a * for the step
  double wear = 0.0;                    ///< coefficient of Archard (1/pressure)
};

struct SurfaceArguments {
  gpudem::WallSpec wall;  ///< law, mesh as placed, side, contacts per grain
  std::vector<SurfaceMove> moves;
  std::optional<gpudem::Array3> reference;  ///< point of the body to which torques refer (distance)
  std::string file;
  gpudem::MeshReport report;
  bool recordContacts = false;
  bool zones = false;  ///< sums for each zone of the file
  FacesOutput faces;
  std::optional<gpudem::Servo> servo;
  int servoEvery = 0;  ///< steps between two updates
};

/// Reads arg[3] on. Ends the run with a message that names the word, and what would be right.
SurfaceArguments readSurfaceArguments(LAMMPS *lmp, int narg, char **arg);

}  // namespace LAMMPS_NS
#endif
