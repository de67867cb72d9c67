// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The words of command and fix balance/slice.
#include "slice_balancer.h"

#include "balance.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "input.h"
#include "irregular.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

namespace {
constexpr const char *keywords = "axes, levels, weight, aim, width, moves, out";
}

int SliceBalancer::readAxes(int narg, char **arg)
{
  int used = 0;
  std::string axes;
  for (; used < narg && (strcmp(arg[used], "x") == 0 || strcmp(arg[used], "y") == 0 || strcmp(arg[used], "z") == 0);
       ++used)
    axes += arg[used];
  if (used) {
    axes_ = axes;
    return used;
  }
  if (strcmp(arg[0], "auto") != 0)
    fail(fmt::format("axes '{}' must be auto, or axes in the order of the cuts, such as x z", arg[0]));
  axes_ = "auto";
  return 1;
}

void SliceBalancer::readArguments(int narg, char **arg)
{
  threshold_ = utils::numeric(FLERR, arg[0], false, lmp);
  if (!(threshold_ >= 1.0))
    fail(fmt::format("threshold {} is below 1, the imbalance of equal loads; give 1.0 or more, such as 1.1", arg[0]));

  for (int k = 1; k < narg;) {
    const std::string word = arg[k++];
    if (strstr(" axes levels weight aim width moves out ", (" " + word + " ").c_str()) == nullptr)
      fail(fmt::format("unknown keyword '{}'; keywords are {}", word, keywords));
    if (k >= narg) fail(fmt::format("keyword {} has no value", word));
    if (word == "axes") {
      k += readAxes(narg - k, arg + k);
    } else if (word == "weight") {
      int used = 0;
      weights_.push_back(makeSliceWeight(lmp, who_, narg - k, arg + k, used));
      k += used;
    } else if (word == "levels") {
      levels_ = utils::inumeric(FLERR, arg[k], false, lmp);
      if (levels_ < 1 || levels_ > domain->dimension)
        fail(fmt::format("levels {} must be 1 to {} in {} dimensions", arg[k], domain->dimension, domain->dimension));
      ++k;
    } else if (word == "aim") {
      aim_ = utils::numeric(FLERR, arg[k], false, lmp);
      if (!(aim_ >= 1.0 && aim_ <= threshold_))
        fail(fmt::format("aim {} must be from 1 to the threshold, {}", arg[k], threshold_));
      ++k;
    } else if (word == "width") {
      width_ = utils::numeric(FLERR, arg[k], false, lmp);
      if (!(width_ > 0.0)) fail(fmt::format("width {} must be a distance above 0", arg[k]));
      ++k;
    } else if (word == "moves") {
      if (strcmp(arg[k], "free") != 0 && strcmp(arg[k], "near") != 0)
        fail(fmt::format("moves '{}' must be free or near", arg[k]));
      near_ = strcmp(arg[k], "near") == 0;
      ++k;
    } else {
      writer_ = std::make_unique<Balance>(lmp);
      writer_->options(0, 2, arg + k - 1);  // "out file"
      ++k;
    }
  }

  // an imbalance found at the threshold is removed well below it, or it would be back at once
  if (aim_ == 0.0) aim_ = std::min(1.01, 0.5 * (1.0 + threshold_));
  if (levels_ == 0) levels_ = axes_ == "auto" ? domain->dimension : static_cast<int>(axes_.size());
  if (axes_ != "auto" && static_cast<int>(axes_.size()) != levels_)
    fail(fmt::format("axes names {} axes, but levels is {}; name one axis for each level", axes_.size(), levels_));
  for (std::size_t k = 0; axes_ != "auto" && k < axes_.size(); ++k) {
    if (axes_.find(axes_[k], k + 1) != std::string::npos) fail(fmt::format("axes names {} twice", axes_[k]));
    if (axes_[k] == 'z' && domain->dimension == 2) fail("axes z: there are no cuts along z in two dimensions");
  }
  useTiledLayout();
}

void SliceBalancer::useTiledLayout()
{
  if (comm->nprocs == 1 || comm->style == 1) return;
  if (comm->me == 0) utils::logmesg(lmp, "{}: switching to comm_style tiled, which its sub-domains need\n", who_);
  input->one("comm_style tiled");
}
