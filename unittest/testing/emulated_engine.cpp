// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "engine/engine_impl.hpp"
#include "testing/emulated_warp.h"

namespace gpudem::testing {

std::unique_ptr<Engine> makeEmulatedEngine(Precision precision, int warps)
{
  if (precision == Precision::Double)
    return std::make_unique<EngineImpl<EmulatedExec, Double>>(EmulatedExec(), precision, warps);
  return std::make_unique<EngineImpl<EmulatedExec, Mixed>>(EmulatedExec(), precision, warps);
}

}  // namespace gpudem::testing
