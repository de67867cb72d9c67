// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The launcher: an ordinary LAMMPS executable whose library registers GPUDEM's styles first.

#include "input.h"
#include "lammps.h"

#include <mpi.h>

#include <cstdio>
#include <exception>

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    lammps.input->file();
  } catch (const std::exception &e) {
    std::fprintf(stderr, "ERROR: %s\n", e.what());
    status = 1;
    MPI_Abort(MPI_COMM_WORLD, status);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return status;
}
