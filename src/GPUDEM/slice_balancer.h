// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_GPUDEM_SLICE_BALANCER_H
#define LMP_GPUDEM_SLICE_BALANCER_H

#include "gpudem/slice_grid.h"
#include "pointers.h"
#include "slice_weights.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// What command and fix balance/slice share: reads the keywords, weighs particles, moves cuts, sub-domains and
/// particles. All calls but the constructor's are collective.
class SliceBalancer : protected Pointers {
 public:
  /// \param who  the command, as messages name it
  SliceBalancer(LAMMPS *lmp, std::string who);
  ~SliceBalancer() override;

  /// The threshold, then keywords. Switches to comm_style tiled if there are several ranks.
  void readArguments(int narg, char **arg);
  /// Before a run or a single use: checks what weights refer to.
  void init(bool fix);
  /// Weigh all particles.
  /// \param listIsCurrent  whether the neighbour list is that of the particles as they are
  void weigh(bool listIsCurrent);

  struct Load {
    double imbalance = 1.0;  // largest weight of a rank over the mean
    double most = 0.0;       // largest weight of a rank
  };
  /// As particles lie now, by the weights of weigh().
  Load load();

  struct Outcome {
    Load load;         // after it
    int rounds = 0;    // histograms summed over the ranks
    int cuts = 0;      // cuts that moved
    bigint moved = 0;  // particles that changed rank
  };
  /// Move cuts and particles. Particles must be in the box, their weights those of weigh().
  Outcome balance();

  double threshold() const { return threshold_; }
  /// Do all particles weigh the same?
  bool countsOnly() const { return weights_.empty(); }
  bool weighsByVariable() const;
  bool needsNeighbors() const;
  /// What the weights are, one line each.
  std::string info() const;
  /// Slabs and parts, for the log.
  std::string shape() const;
  double memoryUsage() const;

 private:
  int readAxes(int narg, char **arg);
  void useTiledLayout();
  std::array<double, 3> filledRegion() const;  // edges, distance
  bool chooseSlabs();                          // true: other slabs than before
  void applyToComm();
  void fail(const std::string &what) const;

  std::string who_;
  double threshold_ = 1.0;
  double aim_ = 0.0;     // 0: from the threshold
  double width_ = -1.0;  // least width of a sub-domain, distance; below 0: the skin
  int levels_ = 0;       // 0: one for each dimension, or as many as axes are named
  std::string axes_ = "auto";
  bool near_ = false;  // cuts stay between their neighbours
  std::vector<SliceWeight> weights_;
  std::vector<double> weight_;  // [nlocal], empty if all weigh one
  gpudem::SliceGrid grid_;
  std::unique_ptr<class Balance> writer_;  // of the file of keyword out, else null
  std::unique_ptr<class Irregular> irregular_;
};

}  // namespace LAMMPS_NS
#endif
