// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A wall of triangles for particles in the host's arrays, step by step: the same functions as the engine's.
#pragma once

#include "gpudem/engine.h"

namespace gpudem {

class SurfaceWall {
 public:
  /// \param spec of shape Surface
  /// \throws Error as Surface does
  explicit SurfaceWall(const WallSpec &spec);
  ~SurfaceWall();

  /// Adds forces and torques of the wall to those of \p particles (position, velocity, spin, radius, mass, mask, tag,
  /// force and torque must be there).
  /// \param kept [n][wallHistorySize(spec)], updated
  /// \param advance springs grow by \p timestep; false at LAMMPS' setup
  /// \param columns [n][8] flag, force, contact point, radius of the deepest contact; null if not wanted
  /// \throws Error naming the atom that touches too many places or went through a sheet
  WallSums apply(const HostParticles &particles, const BodyMotion &motion, double timestep, bool advance, double *kept,
                 double *columns);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace gpudem
