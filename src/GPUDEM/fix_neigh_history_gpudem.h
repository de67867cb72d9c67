// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_NEIGH_HISTORY_GPUDEM_H
#define LMP_FIX_NEIGH_HISTORY_GPUDEM_H

#include "fix_neigh_history.h"
#include "gpudem/engine.h"

#include <unordered_map>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// Stock contact history whose per-atom partner lists can be exchanged with the device.
///
/// Stock LAMMPS keeps springs in its neighbour lists and gathers them into per-atom lists when atoms move or a
/// restart is written. In the resident loop the springs live on the device; the per-atom lists are filled from
/// there, and the lists of neighbours need not exist at all.
class FixNeighHistoryGpudem : public FixNeighHistory {
 public:
  FixNeighHistoryGpudem(class LAMMPS *lmp, int narg, char **arg) : FixNeighHistory(lmp, narg, arg) {}
  void post_constructor() override;
  void pre_exchange() override;
  void post_neighbor() override;
  void write_restart(FILE *fp);

  /// Which numbers of a contact the device keeps: number d lies at \p place[d] here and has the sign mirror[d] seen
  /// from the partner. Without this call they are the three of a tangential spring.
  void setPlaces(const std::vector<int> &place, const std::vector<signed char> &mirror);

  /// Where the per-atom lists come from: those of the device hold both sides of every contact.
  enum class Source { Device, Elsewhere };
  /// Contacts of the local atoms; those which the partner does not hold are left out. Collective.
  void exportTo(gpudem::ContactHistory &history, Source source) const;
  void importFrom(const gpudem::ContactHistory &history);

  /// The run is resident: hooks that assume neighbour lists on the host do nothing.
  void enterResident() { resident = true; }
  /// Fill stock's lists from the per-atom ones, for host styles that look at neighbours.
  void fillHostLists() { FixNeighHistory::post_neighbor(); }
  /// Called before a restart is written while the run is on the device.
  void setSynchroniser(class VerletGpudem *owner) { synchroniser = owner; }

 private:
  using LongLists = std::unordered_map<int, std::vector<std::pair<tagint, int>>>;  ///< partners and where they stand
  int entryOf(int i, tagint wanted, LongLists &lists) const;
  const double *localCopy(int owner, int other, LongLists &lists) const;
  bool isSameContact(const double *mine, const double *theirs) const;

  std::vector<int> place{0, 1, 2};
  std::vector<signed char> mirror{-1, -1, -1};
  bool resident = false;                       ///< per-atom lists are the only host copy
  class VerletGpudem *synchroniser = nullptr;  ///< set while the device holds the springs
};

}  // namespace LAMMPS_NS
#endif
