// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The backends that were compiled in.
#pragma once

#include "gpudem/engine.h"

#include <memory>
#include <string>

namespace gpudem {

std::unique_ptr<Engine> makeCpuEngine(const EngineOptions &options);
#ifdef GPUDEM_HAVE_CUDA
std::unique_ptr<Engine> makeGpuEngine(const EngineOptions &options);
/// \param problem set to the reason when the result is 0
int countGpus(std::string &problem);
#endif

}  // namespace gpudem
