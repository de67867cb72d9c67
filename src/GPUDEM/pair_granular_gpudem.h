// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_PAIR_GRANULAR_GPUDEM_H
#define LMP_PAIR_GRANULAR_GPUDEM_H

#include "density_check.h"
#include "granular_model.h"
#include "pair_granular.h"
#include "resident.h"

#include <map>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// pair_style granular/gpudem
///
/// The contact laws are read and mixed here and written into the tables of the stock style, which serves restarts and
/// the loops that are not resident.
class PairGranularGpudem : public PairGranular, public ResidentPair {
 public:
  explicit PairGranularGpudem(LAMMPS *lmp) : PairGranular(lmp) {}

  void coeff(int narg, char **arg);
  void init_style();
  double init_one(int i, int j);
  void write_restart(FILE *fp);
  void read_restart(FILE *fp);
  void compute(int eflag, int vflag);
  double single(int i, int j, int itype, int jtype, double rsq, double factorCoul, double factorLj, double &fforce);
  void transfer_history(double *source, double *target);
  double atom2cut(int i);
  double radii2cut(double r1, double r2);

  void describeLaws(gpudem::SceneSpec &scene) const override;
  unsigned frozenMask() const override { return static_cast<unsigned>(freeze_group_bit); }
  double largestRadius() const override;
  void setVirial(const std::array<double, 6> &virial) override;

 private:
  const gpudem::ContactModel &model(int i, int j) const { return models_.at({std::min(i, j), std::max(i, j)}); }
  std::vector<gpudem::ContactModel> allModels() const;
  void coeffOfMaterials(int narg, char **arg);
  void set(int i, int j, const gpudem::ContactModel &model, double cutoff);
  void mixUnset();
  void writeTables(int i, int j);
  GranularWords readTables(int i, int j) const;
  void arrangeHistory();
  double largestGap(double radius1, double radius2) const;

  std::map<std::pair<int, int>, gpudem::ContactModel> models_;  ///< of types i <= j
  std::map<std::pair<int, int>, bool> mixed_;                   ///< the pair's law was mixed, not given
  DensityCheck densities_;                                      ///< of types set by a material file
  gpudem::HistoryLayout layout_;                                ///< of the device
  std::vector<int> stockPlace_;                                 ///< where LAMMPS keeps each number
  int stockSize_ = 0;                                           ///< numbers LAMMPS keeps per contact
  bool stockKnows_ = true;                                      ///< LAMMPS has all sub-models in use
};

}  // namespace LAMMPS_NS
#endif
