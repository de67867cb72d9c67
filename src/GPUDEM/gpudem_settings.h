// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Run-wide choices of one LAMMPS instance, set by the gpudem command or the environment.
#ifndef LMP_GPUDEM_SETTINGS_H
#define LMP_GPUDEM_SETTINGS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

struct GpudemSettings {
  std::string device = "auto";            ///< auto, gpu, cpu
  std::string precision = "mixed";        ///< mixed, double
  std::string conventions = "corrected";  ///< corrected; lammps: where LAMMPS 29 Sep 2021 is wrong, so are we
  int threads = 0;                        ///< CPU threads, 0 = automatic
  std::string neighbor = "auto";          ///< auto, single, multigrid
  int levels = 0;                         ///< of the multigrid, 0 = automatic
  int warps = 0;                          ///< that take 32 grains together on a GPU: 1, 4, 0 = automatic
  bool verbose = true;                    ///< print the block of choices at the start of a run
  int version = 0;                        ///< counts changes, so that an engine knows when it is out of date

  /// Apply one keyword. \return false if the keyword is unknown
  /// \throws std::invalid_argument naming the value and the choices
  bool set(const std::string &keyword, const std::string &value);
  static std::string keywords();
};

/// Settings of \p lmp; created from the environment (GPUDEM_DEVICE and its kind) on first use.
GpudemSettings &gpudemSettings(LAMMPS *lmp);
/// Forget them: a new instance, or the clear command.
void resetGpudemSettings(LAMMPS *lmp);

}  // namespace LAMMPS_NS
#endif
