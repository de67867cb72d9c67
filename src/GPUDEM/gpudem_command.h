// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_GPUDEM_COMMAND_H
#define LMP_GPUDEM_COMMAND_H

#include "command.h"

namespace LAMMPS_NS {

/// gpudem keyword value ...: device, precision and threads of the resident loop.
class GpudemCommand : public Command {
 public:
  explicit GpudemCommand(class LAMMPS *lmp) : Command(lmp) {}
  void command(int narg, char **arg) override;
};

}  // namespace LAMMPS_NS
#endif
