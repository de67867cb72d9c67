// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "wall_arguments.h"

#include "granular_model.h"
#include "gpudem_settings.h"
#include "material_file.h"

#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <cstring>

using namespace LAMMPS_NS;

namespace {

/// file.gran GRAIN WALL
gpudem::ContactModel readMaterials(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first)
{
  if (narg < first + 3)
    lmp->error->all(FLERR, "{}: after {} the materials of the grains and of the wall are missing", command, arg[first]);
  const MaterialFile file(lmp, command, arg[first]);
  const gpudem::ContactModel model = file.model(arg[first + 1], arg[first + 2], gpudem::Partner::Wall);
  utils::logmesg(lmp, "  {} at a wall of {}: {}\n", arg[first + 1], arg[first + 2], granularWords(model));
  return model;
}

}  // namespace

WallLaw LAMMPS_NS::readWallLaw(LAMMPS *lmp, const std::string &command, int narg, char **arg, int first,
                               const std::vector<std::string> &stop)
{
  WallLaw law;
  if (first < narg && MaterialFile::isName(arg[first])) {
    law.model = readMaterials(lmp, command, narg, arg, first);
    law.next = first + 3;
  } else {
    GranularWords words;
    law.next = readGranularWords(lmp, command, narg, arg, first, stop, words);
    law.model = words.model;
  }
  if (law.model.slipLever == 0.0) law.model.lever = 0.0;  // LAMMPS' torque arm at walls is the radius
  law.stockKnows = stockNumbers(law.model).known;
  if (gpudemSettings(lmp).conventions == "lammps" && law.stockKnows) law.model = stockWallModel(law.model);
  return law;
}

WallArguments::WallArguments(LAMMPS *lmp, int narg, char **arg) : words_(arg, arg + narg)
{
  if (narg > 4 && strcmp(arg[3], "granular") == 0) {
    const WallLaw law =
        readWallLaw(lmp, "Fix wall/gran", narg, arg, 4, {"xplane", "yplane", "zplane", "zcylinder", "region"});
    stockKnows = law.stockKnows;
    model = law.model;
    words_.resize(4);
    for (const std::string &w : stockWallWords(*model)) words_.push_back(w);
    words_.insert(words_.end(), arg + law.next, arg + narg);
  }
  for (std::string &w : words_) pointers_.push_back(&w[0]);
}
