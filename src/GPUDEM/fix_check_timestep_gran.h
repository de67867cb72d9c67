// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_FIX_CHECK_TIMESTEP_GRAN_H
#define LMP_FIX_CHECK_TIMESTEP_GRAN_H

#include "fix.h"
#include "gpudem/timestep.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

/// fix check/timestep/gran: the time step against Rayleigh, Hertz and contact times and the largest move
class FixCheckTimestepGran : public Fix {
 public:
  FixCheckTimestepGran(class LAMMPS *lmp, int narg, char **arg);
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void end_of_step() override;
  double compute_vector(int n) override;

 private:
  /// Of the grains of one type; all ranks.
  struct TypeExtremes {
    double radius = 0, mass = 0;  ///< smallest; 0: no grain
  };
  struct Times {
    double rayleigh = 0, hertz = 0, contact = 0;  ///< shortest; 0: none is known (time)
    double proposal = 0;                          ///< for the wanted error (time)
  };

  void parse(int narg, char **arg);
  void readGrains();
  void readLaws();
  void updateTimes();
  void add(const gpudem::ContactModel &model, const TypeExtremes &a, const TypeExtremes &b);
  void check();
  void complain(const std::string &what, double fraction, double allowed);

  double rayleighAllowed = 0, hertzAllowed = 0, contactAllowed = 0, moveAllowed = 0;
  double givenSpeed = 0, wantedError = 0;
  bool warns = true, stops = false;

  std::vector<gpudem::ContactModel> pairs;               ///< [types][types]
  std::vector<gpudem::ContactModel> walls;
  std::vector<TypeExtremes> types, usedTypes;            ///< now; of the times
  double fastest = 0, usedSpeed = 0, furthest = 0;       ///< speeds (distance/time); move of a step in radii
  Times times;
  double said = 0;                                       ///< proposal that was printed
};

}  // namespace LAMMPS_NS
#endif
