// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "wall_arguments.h"

#include "granular_model.h"
#include "gpudem_settings.h"

#include <cstring>

using namespace LAMMPS_NS;

WallArguments::WallArguments(LAMMPS *lmp, int narg, char **arg) : words_(arg, arg + narg)
{
  if (narg > 4 && strcmp(arg[3], "granular") == 0) {
    static const std::vector<std::string> stop{"xplane", "yplane", "zplane", "zcylinder", "region"};
    GranularWords words;
    const int next = readGranularWords(lmp, "Fix wall/gran", narg, arg, 4, stop, words);
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
