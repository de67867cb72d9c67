// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "engine/engine_impl.hpp"
#include "testing/emulated_warp.h"

namespace gpudem::testing {

std::unique_ptr<Engine> makeEmulatedEngine(Precision precision)
{
  if (precision == Precision::Double)
    return std::make_unique<EngineImpl<EmulatedExec, Double>>(EmulatedExec(), precision);
  return std::make_unique<EngineImpl<EmulatedExec, Mixed>>(EmulatedExec(), precision);
}

}  // namespace gpudem::testing
