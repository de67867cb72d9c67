// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file One table of styles, two doors: `plugin load`, and interposition of LAMMPS::post_create() for a LAMMPS
/// without the PLUGIN package (the launcher lmp_gpudem, or this library as LD_PRELOAD).

#include "balance_slice.h"
#include "compute_erotate_sphere_gpudem.h"
#include "compute_ke_gpudem.h"
#include "compute_temp_gpudem.h"
#include "fix_balance_slice.h"
#include "fix_check_timestep_gran.h"
#include "fix_enforce2d_gpudem.h"
#include "fix_freeze_gpudem.h"
#include "fix_gravity_gpudem.h"
#include "fix_move_gpudem.h"
#include "fix_neigh_history_gpudem.h"
#include "fix_nve_sphere_gpudem.h"
#include "fix_setforce_gpudem.h"
#include "fix_viscous_gpudem.h"
#include "fix_wall_gran_gpudem.h"
#include "fix_wall_gran_region_gpudem.h"
#include "fix_wall_gran_sdf.h"
#include "gpudem_command.h"
#include "gpudem_settings.h"
#include "pair_gran_hertz_history_gpudem.h"
#include "pair_gran_hooke_gpudem.h"
#include "pair_gran_hooke_history_gpudem.h"
#include "pair_granular_gpudem.h"
#include "verlet_gpudem.h"

#include "error.h"
#include "force.h"
#include "command.h"
#include "input.h"
#include "lammps.h"
#include "lammpsplugin.h"
#include "modify.h"
#include "update.h"

#include <dlfcn.h>

#include <cstring>

using namespace LAMMPS_NS;

namespace {

template <class T>
Pair *makePair(LAMMPS *lmp)
{
  return new T(lmp);
}
template <class T>
Fix *makeFix(LAMMPS *lmp, int narg, char **arg)
{
  return new T(lmp, narg, arg);
}
template <class T>
Compute *makeCompute(LAMMPS *lmp, int narg, char **arg)
{
  return new T(lmp, narg, arg);
}
Integrate *makeVerlet(LAMMPS *lmp, int narg, char **arg)
{
  return new VerletGpudem(lmp, narg, arg);
}
template <class T>
Command *makeCommand(LAMMPS *lmp)
{
  return new T(lmp);
}

void registerStyles(LAMMPS *lmp)
{
  auto &pairs = *lmp->force->pair_map;
  pairs["gran/hooke/gpudem"] = &makePair<PairGranHookeGpudem>;
  pairs["gran/hooke/history/gpudem"] = &makePair<PairGranHookeHistoryGpudem>;
  pairs["gran/hertz/history/gpudem"] = &makePair<PairGranHertzHistoryGpudem>;
  pairs["granular/gpudem"] = &makePair<PairGranularGpudem>;

  auto &fixes = *lmp->modify->fix_map;
  fixes["NEIGH_HISTORY/gpudem"] = &makeFix<FixNeighHistoryGpudem>;
  fixes["nve/sphere/gpudem"] = &makeFix<FixNVESphereGpudem>;
  fixes["gravity/gpudem"] = &makeFix<FixGravityGpudem>;
  fixes["freeze/gpudem"] = &makeFix<FixFreezeGpudem>;
  fixes["viscous/gpudem"] = &makeFix<FixViscousGpudem>;
  fixes["setforce/gpudem"] = &makeFix<FixSetForceGpudem>;
  fixes["enforce2d/gpudem"] = &makeFix<FixEnforce2DGpudem>;
  fixes["wall/gran/gpudem"] = &makeFix<FixWallGranGpudem>;
  fixes["wall/gran/region/gpudem"] = &makeFix<FixWallGranRegionGpudem>;
  fixes["wall/gran/sdf"] = &makeFix<FixWallGranSdf>;
  fixes["move/gpudem"] = &makeFix<FixMoveGpudem>;
  fixes["balance/slice"] = &makeFix<FixBalanceSlice>;
  fixes["check/timestep/gran"] = &makeFix<FixCheckTimestepGran>;

  auto &computes = *lmp->modify->compute_map;
  computes["ke/gpudem"] = &makeCompute<ComputeKEGpudem>;
  computes["erotate/sphere/gpudem"] = &makeCompute<ComputeERotateSphereGpudem>;
  computes["temp/gpudem"] = &makeCompute<ComputeTempGpudem>;

  (*lmp->update->integrate_map)["verlet/gpudem"] = &makeVerlet;
  auto &commands = *lmp->input->command_map;
  commands["gpudem"] = &makeCommand<GpudemCommand>;
  commands["balance/slice"] = &makeCommand<BalanceSlice>;
}

bool suffixIsGpudem(LAMMPS *lmp)
{
  return lmp->suffix_enable &&
         ((lmp->suffix && strcmp(lmp->suffix, "gpudem") == 0) || (lmp->suffix2 && strcmp(lmp->suffix2, "gpudem") == 0));
}

/// LAMMPS made these before any style of ours was known.
void recreateDefaults(LAMMPS *lmp)
{
  if (!suffixIsGpudem(lmp)) return;
  for (const char *id : {"thermo_pe", "thermo_press", "thermo_temp"}) lmp->modify->delete_compute(id);
  lmp->modify->add_compute("thermo_temp all temp");
  lmp->modify->add_compute("thermo_press all pressure thermo_temp");
  lmp->modify->add_compute("thermo_pe all pe");
  char style[] = "verlet";
  char *arg[] = {style};
  lmp->update->create_integrate(1, arg, 1);
}

void checkVersion(LAMMPS *lmp)
{
  if (lmp->num_ver != GPUDEM_LAMMPS_VERSION)
    lmp->error->all(FLERR,
                    "GPUDEM was compiled for LAMMPS version {} but is loaded into version {}; rebuild it with "
                    "LAMMPS_SOURCE_DIR pointing to the sources of this LAMMPS",
                    GPUDEM_LAMMPS_VERSION, lmp->num_ver);
}

void install(LAMMPS *lmp)
{
  checkVersion(lmp);
  resetGpudemSettings(lmp);
  registerStyles(lmp);
  recreateDefaults(lmp);
}

}  // namespace

/// Interposed: LAMMPS calls this at the end of its construction and of the clear command.
void LAMMPS::post_create()
{
  install(this);
  using Original = void (*)(LAMMPS *);
  const auto original = reinterpret_cast<Original>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv"));
  if (!original) error->all(FLERR, "GPUDEM did not find LAMMPS::post_create() behind itself: link it before liblammps");
  original(this);
}

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *regfunc)
{
  (void)handle;
  (void)regfunc;  // registering in the maps needs no per-style call and survives in every version
  install(static_cast<LAMMPS *>(lmp));
}
