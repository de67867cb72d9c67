// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "base/exec_cpu.hpp"
#include "engine/engine_impl.hpp"
#include "engine/make_engine.hpp"

namespace gpudem {

std::unique_ptr<Engine> makeCpuEngine(const EngineOptions &o)
{
  if (o.precision == Precision::Double)
    return std::make_unique<EngineImpl<CpuExec, Double>>(CpuExec(o.threads), o.precision, o.warps);
  return std::make_unique<EngineImpl<CpuExec, Mixed>>(CpuExec(o.threads), o.precision, o.warps);
}

}  // namespace gpudem
