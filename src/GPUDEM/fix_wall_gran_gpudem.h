// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_WALL_GRAN_GPUDEM_H
#define LMP_FIX_WALL_GRAN_GPUDEM_H

#include "fix_wall_gran.h"
#include "resident.h"

#include <vector>

namespace LAMMPS_NS {

/// fix wall/gran/gpudem
class FixWallGranGpudem : public FixWallGran, public ResidentFix {
 public:
  FixWallGranGpudem(class LAMMPS *lmp, int narg, char **arg);
  void post_constructor() override { keepStockName(this, word.c_str()); }
  void post_force(int vflag) override;
  ResidentVerdict resident() override;
  void describe(gpudem::SceneSpec &scene) override;

  int wallIndex() const { return wall; }
  bool hasSprings() const { return use_history != 0; }
  bool recordsContacts() const { return peratom_flag != 0; }
  /// Springs of all local atoms, [nlocal][3].
  void exportSprings(std::vector<double> &spring) const;
  void importSprings(const std::vector<double> &spring);
  /// The eight columns of the 'contacts' output, [nlocal][8].
  void importContacts(const std::vector<double> &columns);

 private:
  std::string word;  ///< style as the script spells it
  int wall = -1;     ///< index in the scene
};

}  // namespace LAMMPS_NS
#endif
