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

/// granular file.gran GRAIN WALL
gpudem::ContactModel readMaterials(LAMMPS *lmp, int narg, char **arg)
{
  if (narg < 7)
    lmp->error->all(FLERR, "Fix wall/gran: after {} the materials of the grains and of the wall are missing", arg[4]);
  const MaterialFile file(lmp, "Fix wall/gran", arg[4]);
  const gpudem::ContactModel model = file.model(arg[5], arg[6], gpudem::Partner::Wall);
  utils::logmesg(lmp, "  {} at a wall of {}: {}\n", arg[5], arg[6], granularWords(model));
  return model;
}

}  // namespace

WallArguments::WallArguments(LAMMPS *lmp, int narg, char **arg) : words_(arg, arg + narg)
{
  if (narg > 4 && strcmp(arg[3], "granular") == 0) {
    static const std::vector<std::string> stop{"xplane", "yplane", "zplane", "zcylinder", "region"};
    GranularWords words;
    int next;
    if (MaterialFile::isName(arg[4])) {
      words.model = readMaterials(lmp, narg, arg);
      next = 7;
    } else {
      next = readGranularWords(lmp, "Fix wall/gran", narg, arg, 4, stop, words);
    }
    if (words.model.slipLever == 0.0) words.model.lever = 0.0;  // LAMMPS' torque arm at walls is the radius
    stockKnows = stockNumbers(words.model).known;
    const bool asStock = gpudemSettings(lmp).conventions == "lammps" && stockKnows;
    model = asStock ? stockWallModel(words.model) : words.model;
    words_.resize(4);
    for (const std::string &w : stockWallWords(*model)) words_.push_back(w);
    words_.insert(words_.end(), arg + next, arg + narg);
  }
  for (std::string &w : words_) pointers_.push_back(&w[0]);
}
