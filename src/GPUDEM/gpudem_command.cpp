// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem_command.h"

#include "error.h"
#include "gpudem_settings.h"

#include <stdexcept>

using namespace LAMMPS_NS;

void GpudemCommand::command(int narg, char **arg)
{
  if (narg == 0)
    error->all(FLERR, "Command gpudem needs keyword value pairs; keywords are {}", GpudemSettings::keywords());
  GpudemSettings &settings = gpudemSettings(lmp);
  for (int k = 0; k < narg; k += 2) {
    if (k + 1 >= narg) error->all(FLERR, "Command gpudem: keyword '{}' has no value", arg[k]);
    try {
      if (!settings.set(arg[k], arg[k + 1]))
        error->all(FLERR, "Command gpudem: unknown keyword '{}'; keywords are {}", arg[k], GpudemSettings::keywords());
    } catch (const std::invalid_argument &e) {
      error->all(FLERR, "Command gpudem: {}", e.what());
    }
  }
}
