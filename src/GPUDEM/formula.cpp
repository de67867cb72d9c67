// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "formula.h"

#include "compute.h"
#include "input.h"
#include "lammps.h"
#include "lammps_compat.h"
#include "modify.h"
#include "resident.h"
#include "variable.h"

#include <cctype>
#include <cstring>
#include <set>

using namespace LAMMPS_NS;

namespace {
const std::set<std::string> functions = {"sqrt",    "exp",       "ln",      "log",     "abs",      "sin",      "cos",
                                         "tan",     "asin",      "acos",    "atan",    "atan2",    "ceil",     "floor",
                                         "round",   "ramp",      "stagger", "logfreq", "logfreq2", "logfreq3", "stride",
                                         "stride2", "vdisplace", "swiggle", "cwiggle", "PI"};
const std::set<std::string> clockWords = {"step", "elapsed", "elaplong", "dt", "time"};
const std::set<std::string> thermoWords = {"cpu",  "tpcpu", "spcpu", "cpuremain", "part",   "timeremain", "atoms",
                                           "temp", "press", "pe",    "ke",        "etotal", "vol",        "lx",
                                           "ly",   "lz",    "xlo",   "xhi",       "ylo",    "yhi",        "zlo",
                                           "zhi",  "pxx",   "pyy",   "pzz",       "pxy",    "pxz",        "pyz"};

bool readsDevice(LAMMPS *lmp, const std::string &id)
{
  const int index = lmp->modify->find_compute(id);
  if (index < 0) return false;
  Compute *compute = lmp->modify->compute[index];
  return dynamic_cast<ResidentCompute *>(compute) || strcmp(compute->style, "pressure") == 0 ||
         strcmp(compute->style, "pe") == 0;
}

bool allowed(LAMMPS *lmp, const std::string &word, FormulaScope scope)
{
  if (functions.count(word) || clockWords.count(word)) return true;
  if (word.compare(0, 2, "v_") == 0) return isHostFree(lmp, word.substr(2), scope);
  if (scope == FormulaScope::StepOnly) return false;
  if (word.compare(0, 2, "c_") == 0) return readsDevice(lmp, word.substr(2));
  return thermoWords.count(word) > 0;
}
}  // namespace

bool LAMMPS_NS::isHostFree(LAMMPS *lmp, const std::string &name, FormulaScope scope)
{
  const int index = lmp->input->variable->find(name.c_str());
  if (index < 0) return false;
  const std::string formula = GpudemCompat::equalFormula(lmp->input->variable, index);
  Variable *variable = lmp->input->variable;
  if (formula.empty())  // index, string, loop, ...: text that is fixed during a run
    return !variable->atomstyle(index) && !variable->equalstyle(index) && !variable->vectorstyle(index);
  for (std::size_t k = 0; k < formula.size();) {
    const unsigned char c = formula[k];
    if (std::isdigit(c) || c == '.') {  // a number with its exponent
      while (k < formula.size() && (std::isalnum(static_cast<unsigned char>(formula[k])) || formula[k] == '.')) ++k;
    } else if (std::isalpha(c) || c == '_') {
      std::size_t end = k;
      while (end < formula.size() && (std::isalnum(static_cast<unsigned char>(formula[end])) || formula[end] == '_'))
        ++end;
      if (!allowed(lmp, formula.substr(k, end - k), scope)) return false;
      k = end;
    } else {
      ++k;
    }
  }
  return true;
}
