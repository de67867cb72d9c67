// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The arguments of fix wall/gran, with those of a contact law put so that stock LAMMPS evaluates it rightly.
#ifndef LMP_GPUDEM_WALL_ARGUMENTS_H
#define LMP_GPUDEM_WALL_ARGUMENTS_H

#include "gpudem/contact_model.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

/// A law that follows FSTYLE granular.
struct WallLaw {
  gpudem::ContactModel model;  ///< under the conventions in force
  bool stockKnows = true;      ///< LAMMPS has all of its sub-models
  int next = 0;                ///< index of the first word behind it
};
/// Read it from arg[first] on, up to a word of \p stop. \param command begins the messages, which end the run
WallLaw readWallLaw(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first,
                    const std::vector<std::string> &stop);

/// Read before the stock constructor, which does not know all sub-models. FSTYLE other than granular passes unchanged.
class WallArguments {
 public:
  WallArguments(LAMMPS *lmp, int narg, char **arg);

  int count() { return static_cast<int>(pointers_.size()); }
  char **words() { return pointers_.data(); }

  std::optional<gpudem::ContactModel> model;  ///< FSTYLE granular
  bool stockKnows = true;                     ///< LAMMPS has all of its sub-models

 private:
  std::vector<std::string> words_;
  std::vector<char *> pointers_;
};

}  // namespace LAMMPS_NS
#endif
