// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What of a script runs on the device, what on the host, and why. Decided once per setup.
#ifndef LMP_GPUDEM_RESIDENT_PLAN_H
#define LMP_GPUDEM_RESIDENT_PLAN_H

#include "gpudem/scene.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class FixMoveGpudem;
class FixNeighHistoryGpudem;
class LAMMPS;
class ResidentFix;
class ResidentPair;
class ResidentWall;

struct ResidentPlan {
  bool possible = false;
  std::string reason;  ///< why the stock loop runs instead

  gpudem::SceneSpec scene;
  ResidentPair *pair = nullptr;
  FixNeighHistoryGpudem *history = nullptr;  ///< null for history-free pair styles
  std::vector<ResidentFix *> fixes;          ///< all whose work the device does
  std::vector<ResidentFix *> varying;        ///< those with a step-dependent term
  std::vector<ResidentWall *> walls;
  std::vector<FixMoveGpudem *> moves;

  bool hostIntegrates = false;       ///< a host fix acts at initial_integrate, post_integrate or final_integrate
  bool hostForces = false;           ///< a host fix acts at pre_force, pre_reverse or post_force
  bool hostRebuilds = false;         ///< a host fix acts at every reneighbouring
  std::vector<Fix *> scheduled;      ///< fixes that ask for reneighbouring at a step of their choice
  std::vector<Fix *> groups;         ///< LAMMPS' internal fixes that choose the members of dynamic groups
  std::vector<int> endOfStep;        ///< periods of the host fixes that act at end_of_step
  bool hostLists = false;            ///< a host style asked for a neighbour list
  bool hostGhosts = false;           ///< a host style tells ghosts on the host something, so LAMMPS must know them
  bool thermoOnDevice = true;        ///< thermodynamic output needs no particle on the host
  std::vector<std::string> onHost;   ///< for the log: what runs on the host, and when
  std::vector<std::string> skipped;  ///< for the log: what the scene does not need

  bool everyStep() const { return hostIntegrates || hostForces; }
};

/// Inspect the initialised LAMMPS instance (after lmp->init()).
ResidentPlan planResidentRun(LAMMPS *lmp);

}  // namespace LAMMPS_NS
#endif
