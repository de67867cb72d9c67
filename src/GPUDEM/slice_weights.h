// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a particle weighs when sub-domains are balanced: LAMMPS' weights, and the contacts of a grain.
#ifndef LMP_GPUDEM_SLICE_WEIGHTS_H
#define LMP_GPUDEM_SLICE_WEIGHTS_H

#include "imbalance.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// One "weight style args" of a script. Each multiplies the weights that those before it left.
struct SliceWeight {
  std::string style;
  std::string name;                      // of the variable or the stored vector, empty for other styles
  std::unique_ptr<Imbalance> imbalance;  // null for count, which changes nothing
};

/// Read the words that follow "weight". A wrong word ends the run with a message that names it.
/// \param who   the command, as messages name it
/// \param used  the number of words read
SliceWeight makeSliceWeight(LAMMPS *lmp, const std::string &who, int narg, char **arg, int &used);

/// 1 + factor * contacts of the grain. Contacts are counted in the neighbour list of the pair style; one across a
/// sub-domain's border counts for the grain of each side (newton pair off) or for one of them (on).
class ContactWeight : public Imbalance {
 public:
  ContactWeight(LAMMPS *lmp, double factor) : Imbalance(lmp), factor_(factor) {}
  int options(int, char **) override { return 0; }
  void compute(double *weight) override;
  std::string info() override;
  /// Whether the neighbour list is that of the particles as they are: not so before a run has built one.
  void setListIsCurrent(bool current) { listIsCurrent_ = current; }

 private:
  double factor_;
  bool listIsCurrent_ = false;
  std::vector<int> contacts_;  // [nlocal]
};

}  // namespace LAMMPS_NS
#endif
