// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The only place that knows LAMMPS versions, and the only one that looks behind LAMMPS' access labels.
///
/// Written against 29 Sep 2021 (Update 2). Entries for later versions cite the dated list in
/// LAMMPS' doc/src/Developer_updating.rst.
#ifndef LMP_GPUDEM_LAMMPS_COMPAT_H
#define LMP_GPUDEM_LAMMPS_COMPAT_H

#include "thermo.h"
#include "variable.h"

#include <string>
#include <type_traits>
#include <vector>

#ifndef GPUDEM_LAMMPS_VERSION
#error "the build must define GPUDEM_LAMMPS_VERSION (yyyymmdd) from LAMMPS' version.h"
#endif
#if GPUDEM_LAMMPS_VERSION < 20210929 || GPUDEM_LAMMPS_VERSION > 20211231
#error "this version of GPUDEM supports LAMMPS 29 Sep 2021 only"
#endif

namespace LAMMPS_NS {
class Compute;
class Fix;
class FixWallGranRegion;
class Pair;
class PairGranular;
class PairHybrid;
class Region;

namespace GpudemCompat {

/// What thermodynamic output will call; LAMMPS keeps these lists private.
struct ThermoInputs {
  std::vector<Compute *> computes;
  std::vector<Fix *> fixes;
  std::vector<std::string> variables;
};
ThermoInputs thermoInputs(Thermo *thermo);

/// Coefficients of pair_style granular by type pair, which LAMMPS keeps private.
struct GranularTables {
  int **normalModel, **dampingModel, **tangentialModel, **rollModel, **twistModel, **limitDamping;
  double **young, **poisson;
  double ***normal, ***tangential, ***roll, ***twist;
  double **cutoff;
};
GranularTables granularTables(PairGranular *pair);
/// Which slots keep something, as pair_coeff would have found.
void setGranularHistory(PairGranular *pair, bool tangential, bool roll, bool twist);

/// Is \p fix a fix balance with weights?
bool weighs(const Fix *fix);

/// The sub-style of a hybrid that has only one and uses it for all pairs of \p types types, else null.
Pair *soleSubStyle(PairHybrid *hybrid, int types);

/// What fix wall/gran/region keeps, which LAMMPS keeps private.
struct RegionWall {
  Region *region;
  int most;       ///< contacts of one atom (tmax)
  int *contacts;  ///< [nmax] contacts of each atom; these arrays are null if the law keeps nothing
  int **face;     ///< [nmax][most] number of the face
};
RegionWall regionWall(FixWallGranRegion *fix);
/// [nmax][most][size_history] numbers of the contacts.
double ***&regionWallHistory(FixWallGranRegion *fix);

/// Numbers of a region, in its own units already; what its style does not have is zero.
struct RegionNumbers {
  double lo[3], hi[3], tilt[3], centre[3], normal[3];
  int axis;
  double radius, radiusHi;
};
/// \return false if the style of the region is not block, prism, sphere, cylinder, cone or plane
bool regionNumbers(Region *region, RegionNumbers &numbers);

/// How a region moves.
struct RegionMotion {
  const char *variable[4];            ///< names for x, y, z and the angle; null where it does not move
  const double *pivot, *unit, *axis;  ///< of the rotation: point, unit vector, the vector as the script gives it
};
RegionMotion regionMotion(Region *region);

/// Formula of an equal-style variable, empty if \p index is of another style.
std::string equalFormula(Variable *variable, int index);

}  // namespace GpudemCompat
}  // namespace LAMMPS_NS
#endif
