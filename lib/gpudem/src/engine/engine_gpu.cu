// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "base/exec_gpu.cuh"
#include "engine/engine_impl.hpp"
#include "engine/make_engine.hpp"

namespace gpudem {

std::unique_ptr<Engine> makeGpuEngine(const EngineOptions &o)
{
  if (o.precision == Precision::Double)
    return std::make_unique<EngineImpl<GpuExec, Double>>(GpuExec(o.gpu), o.precision, o.warps);
  return std::make_unique<EngineImpl<GpuExec, Mixed>>(GpuExec(o.gpu), o.precision, o.warps);
}

int countGpus(std::string &problem)
{
  int n = 0;
  const cudaError_t status = cudaGetDeviceCount(&n);
  if (status != cudaSuccess) {
    cudaGetLastError();
    problem = cudaGetErrorString(status);
    return 0;
  }
  if (n == 0) problem = "the driver reports no device";
  return n;
}

}  // namespace gpudem
