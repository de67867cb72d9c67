// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What single contacts do to the triangles and zones of a surface: sums, pressure, shear stress, wear.
#pragma once

#include "gpudem/body_motion.h"
#include "gpudem/surface.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gpudem {

constexpr std::uint32_t noTriangle = 0xffffffffu;

/// One contact of a grain with a surface. Plain arrays: devices write it.
struct SurfaceTouch {
  double place[3];         ///< on the surface (distance)
  double force[3];         ///< on the surface, with the weight of the contact (force)
  double couple[3];        ///< torque on the surface about \c place: rolling, twisting, and the arm R of LAMMPS' walls
  double push;             ///< normal component, positive if the grain pushes (force)
  double slip;             ///< speed of the grain's surface along the wall's (distance/time)
  std::uint32_t triangle;  ///< of SurfaceMesh, or noTriangle
  std::int32_t tag;        ///< of the grain
};

/// Force, torque about \p origin, and number of contacts on each zone of the mesh: [zones][7].
std::vector<std::array<double, 7>> zoneSums(const SurfaceMesh &mesh, const std::vector<SurfaceTouch> &touches,
                                            const std::array<double, 3> &origin);

/// Loads of every triangle, sampled at some steps.
///
/// Wear is Archard's (J. Appl. Phys. 24 (1953) 981): depth = k p s, with the pressure p and the way s slid, k in
/// 1/pressure. A sample stands for the steps up to the next one.
class FaceLoads {
 public:
  /// \param wearCoefficient k (1/pressure)
  FaceLoads(std::shared_ptr<const SurfaceMesh> mesh, double wearCoefficient);

  /// Adds a sample that stands for the time \p span. \param motion of the body when the contacts were there
  void add(const std::vector<SurfaceTouch> &touches, const BodyMotion &motion, double span);
  /// Sums of this process, [triangles][valuesPerFace], to be added to those of other processes.
  std::vector<double> &sums() { return sums_; }
  const std::vector<double> &sums() const { return sums_; }
  std::int64_t samples() const { return samples_; }
  /// Volume worn off each triangle since the beginning, [triangles] (distance^3).
  std::vector<double> &wear() { return wear_; }
  /// Begin a new average; wear goes on.
  void restart();

  static constexpr std::size_t valuesPerFace = 5;  ///< push, force in the frame of the body x y z, contacts

  /// Legacy VTK file of the triangles at their place: pressure, shear_stress (a vector), contacts (mean number), wear
  /// (depth) and zone of each. \param sums of all processes \param wear likewise \throws Error if it cannot be written
  void write(const std::string &path, const BodyMotion &motion, const std::vector<double> &sums,
             const std::vector<double> &wear) const;

 private:
  std::shared_ptr<const SurfaceMesh> mesh_;
  std::vector<std::array<double, 3>> normal_;  ///< of unit length, in the frame of the body
  std::vector<double> area_;                   ///< (distance^2)
  double wearCoefficient_;                     ///< (1/pressure)
  std::vector<double> sums_, wear_;
  std::int64_t samples_ = 0;
};

}  // namespace gpudem
