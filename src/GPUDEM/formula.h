// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Does a variable read particles? Decides whether it can be evaluated without copying them to the host.
#ifndef LMP_GPUDEM_FORMULA_H
#define LMP_GPUDEM_FORMULA_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

/// Which names a formula may contain besides arithmetic.
enum class FormulaScope {
  StepOnly,  ///< the step, the time and constants: may be evaluated ahead for queued steps
  Thermo,    ///< also thermo keywords and computes that read the device
};

/// True if evaluating the equal-style variable \p name touches no per-particle host array.
bool isHostFree(LAMMPS *lmp, const std::string &name, FormulaScope scope);

}  // namespace LAMMPS_NS
#endif
