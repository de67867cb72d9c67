// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The words of pair_coeff and fix wall/gran granular, and LAMMPS' own numbers for the same law.
#ifndef LMP_GPUDEM_GRANULAR_MODEL_H
#define LMP_GPUDEM_GRANULAR_MODEL_H

#include "gpudem/contact_model.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

/// A contact law as a script gives it.
struct GranularWords {
  gpudem::ContactModel model;
  double cutoff = -1.0;  ///< keyword cutoff (distance), negative if absent
};

/// Read a contact law from arg[first] on, up to the end or a word of \p stop.
/// \param command "Pair_coeff", "Fix wall/gran": begins the messages
/// \return index of the first word that was not read; ends the run with a message for wrong words
int readGranularWords(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first,
                      const std::vector<std::string> &stop, GranularWords &words);

/// The words that readGranularWords reads as \p model, with all digits.
std::string granularWords(const gpudem::ContactModel &model);

/// LAMMPS 29 Sep 2021 numbers its sub-models so.
struct StockNumbers {
  int normal = -1, damping = -1, tangential = -1, rolling = -1, twisting = -1;
  bool known = false;  ///< LAMMPS has all of these sub-models
};
StockNumbers stockNumbers(const gpudem::ContactModel &model);
/// The law of these numbers; parameters are left empty.
gpudem::ContactModel modelOfNumbers(const StockNumbers &numbers);

/// Argument of LAMMPS' "damping tsuji" for which its fit yields the dashpot coefficient \p alpha.
double stockTsujiArgument(double alpha);
/// Restitution for which RestitutionDamping yields \p alpha.
double restitutionOfCoefficient(double alpha, bool linear);

/// Words that make LAMMPS' fix wall/gran granular evaluate \p model as GPUDEM does: its modulus, its tangential
/// stiffness and its dashpot are corrected through the arguments.
std::vector<std::string> stockWallWords(const gpudem::ContactModel &model);
/// The law that LAMMPS' fix wall/gran granular would evaluate for \p model, its defects included.
gpudem::ContactModel stockWallModel(const gpudem::ContactModel &model);

}  // namespace LAMMPS_NS
#endif
