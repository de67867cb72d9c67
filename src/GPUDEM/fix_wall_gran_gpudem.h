// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_WALL_GRAN_GPUDEM_H
#define LMP_FIX_WALL_GRAN_GPUDEM_H

#include "fix_wall_gran.h"
#include "resident.h"
#include "wall_arguments.h"

#include <vector>

namespace LAMMPS_NS {

/// fix wall/gran/gpudem
class FixWallGranGpudem : private WallArguments, public FixWallGran, public ResidentFix {
 public:
  FixWallGranGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void init() override;
  void post_force(int vflag) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;

  int wallIndex() const { return wall; }
  /// Numbers kept per grain.
  int numbers() const { return use_history ? size_history : 0; }
  bool recordsContacts() const { return peratom_flag != 0; }
  /// What all local atoms keep, [nlocal][numbers()].
  void exportHistory(std::vector<double> &history) const;
  void importHistory(const std::vector<double> &history);
  /// The eight columns of the 'contacts' output, [nlocal][8].
  void importContacts(const std::vector<double> &columns);

 private:
  void describeLaw(gpudem::ContactLaw &law) const;

  std::string word;      ///< style as the script spells it
  int wall = -1;         ///< index in the scene
  double damping = 0.0;  ///< coefficient as the constructor read it
};

}  // namespace LAMMPS_NS
#endif
