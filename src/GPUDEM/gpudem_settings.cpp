// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem_settings.h"

#include "error.h"
#include "lammps.h"

#include "gpudem/scene.h"

#include <cstdlib>
#include <map>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace {
std::map<LAMMPS *, GpudemSettings> &instances()
{
  static std::map<LAMMPS *, GpudemSettings> all;
  return all;
}

std::string oneOf(const std::string &keyword, const std::string &value, std::initializer_list<const char *> choices)
{
  std::string list;
  for (const char *c : choices) {
    if (value == c) return value;
    list += list.empty() ? c : std::string(", ") + c;
  }
  throw std::invalid_argument("'" + value + "' is no value of '" + keyword + "'; choose from " + list);
}

int wholeNumber(const std::string &keyword, const std::string &value, int least, int most = 0)
{
  std::size_t used = 0;
  int n = least - 1;
  try {
    n = std::stoi(value, &used);
  } catch (const std::exception &) {
    used = 0;
  }
  if (most > 0 && used == value.size() && n > most)
    throw std::invalid_argument("'" + value + "' is too much for '" + keyword + "'; there are at most " +
                                std::to_string(most));
  if (used != value.size() || used == 0 || n < least)
    throw std::invalid_argument("'" + value + "' is no value of '" + keyword + "'; give a whole number of at least " +
                                std::to_string(least));
  return n;
}
}  // namespace

std::string GpudemSettings::keywords()
{
  return "device, precision, threads, neighbor, levels, warps, conventions, info";
}

bool GpudemSettings::set(const std::string &keyword, const std::string &value)
{
  if (keyword == "device") device = oneOf(keyword, value, {"auto", "gpu", "cpu"});
  else if (keyword == "precision") precision = oneOf(keyword, value, {"double", "mixed"});
  else if (keyword == "threads") threads = value == "auto" ? 0 : wholeNumber(keyword, value, 1);
  else if (keyword == "neighbor") neighbor = oneOf(keyword, value, {"auto", "single", "multigrid"});
  else if (keyword == "levels") levels = value == "auto" ? 0 : wholeNumber(keyword, value, 1, gpudem::mostLevels);
  else if (keyword == "warps") {
    const std::string chosen = oneOf(keyword, value, {"auto", "1", "4"});
    warps = chosen == "auto" ? 0 : std::stoi(chosen);
  }
  else if (keyword == "conventions") conventions = oneOf(keyword, value, {"corrected", "lammps"});
  else if (keyword == "info") verbose = oneOf(keyword, value, {"yes", "no"}) == "yes";
  else return false;
  ++version;
  return true;
}

GpudemSettings &LAMMPS_NS::gpudemSettings(LAMMPS *lmp)
{
  const auto found = instances().find(lmp);
  if (found != instances().end()) return found->second;
  GpudemSettings &s = instances()[lmp];
  const struct {
    const char *name, *keyword;
  } variables[] = {{"GPUDEM_DEVICE", "device"},
                   {"GPUDEM_PRECISION", "precision"},
                   {"GPUDEM_THREADS", "threads"},
                   {"GPUDEM_WARPS", "warps"}};
  for (const auto &v : variables) {
    const char *value = std::getenv(v.name);
    if (!value || !*value) continue;
    try {
      s.set(v.keyword, value);
    } catch (const std::invalid_argument &e) {
      lmp->error->all(FLERR, "Environment variable {}: {}", v.name, e.what());
    }
  }
  return s;
}

void LAMMPS_NS::resetGpudemSettings(LAMMPS *lmp)
{
  instances().erase(lmp);
}
