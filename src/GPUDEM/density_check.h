// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_GPUDEM_DENSITY_CHECK_H
#define LMP_GPUDEM_DENSITY_CHECK_H

#include <map>
#include <string>
#include <utility>

namespace LAMMPS_NS {
class LAMMPS;

/// Warns, once per type, if grains differ from the density of their material by more than 1 %.
class DensityCheck {
 public:
  /// \param name of the material, for the warning
  /// \param density (mass/volume), 0 if it is not known
  void expect(int type, const std::string &name, double density);
  void forget(int type) { expected_.erase(type); }
  /// All ranks call.
  void operator()(LAMMPS *lmp);

 private:
  std::map<int, std::pair<std::string, double>> expected_;  ///< by type; gone once warned
};

}  // namespace LAMMPS_NS
#endif
