// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A wall as the resident loop sees it.
#ifndef LMP_GPUDEM_RESIDENT_WALL_H
#define LMP_GPUDEM_RESIDENT_WALL_H

#include "gpudem/engine.h"
#include "resident.h"

#include <vector>

namespace LAMMPS_NS {

/// A fix whose force term is a wall, with what grains keep about their contacts with it.
class ResidentWall : public ResidentFix {
 public:
  /// Entry of the scene's list of walls.
  int wallIndex() const { return wall; }
  /// Regions and surfaces have launches of their own, which no limit of the device counts.
  virtual bool isRegion() const { return false; }
  /// Numbers kept per grain.
  virtual int numbers() const = 0;
  /// What all local atoms keep, [nlocal][numbers()].
  virtual void exportHistory(std::vector<double> &history) = 0;
  virtual void importHistory(const std::vector<double> &history) = 0;
  virtual bool recordsContacts() const = 0;
  /// The eight columns of the 'contacts' output, [nlocal][8].
  virtual void importContacts(const std::vector<double> &columns) = 0;
  /// Do parts of the wall move, as variables say?
  virtual bool moves() const { return false; }
  /// Places and velocities of the parts at update->ntimestep.
  virtual std::vector<gpudem::PartMotion> motion() { return {}; }
  /// Does the wall move as one body?
  virtual bool bodyMoves() const { return false; }
  /// Its place and velocity at update->ntimestep.
  virtual gpudem::BodyMotion bodyMotion() { return {}; }
  /// Numbers of steps after which it must see what the grains do, counted from step 0.
  virtual std::vector<int> periods() const { return {}; }
  /// What the grains did to the wall at an event.
  virtual void setSums(const gpudem::WallSums &) {}

 protected:
  int wall = -1;
};

}  // namespace LAMMPS_NS
#endif
