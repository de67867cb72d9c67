// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file One test body, every backend and precision that this machine has.
#pragma once

#include "gpudem/engine.h"
#include "testing/emulated_warp.h"

#include <gtest/gtest.h>

#include <string>

namespace gpudem::testing {

struct Backend {
  DeviceKind device;
  Precision precision;
  bool emulated = false;  ///< the kernels of the GPU, lane by lane on the CPU
  int warps = 1;          ///< as in EngineOptions
};

inline std::string backendName(const ::testing::TestParamInfo<Backend> &info)
{
  return std::string(info.param.emulated ? "Emulated" : info.param.device == DeviceKind::Cpu ? "Cpu" : "Gpu") +
         (info.param.precision == Precision::Double ? "Double" : "Mixed") +
         (info.param.warps > 1 ? "Teams" + std::to_string(info.param.warps) : "");
}

/// Fixture that makes the engine or skips where there is no GPU.
class OnBackend : public ::testing::TestWithParam<Backend> {
 protected:
  void SetUp() override
  {
    if (GetParam().device == DeviceKind::Gpu && gpuCount() == 0) GTEST_SKIP() << gpuProblem();
  }
  std::unique_ptr<Engine> make(int threads = 2) const
  {
    if (GetParam().emulated) return makeEmulatedEngine(GetParam().precision, GetParam().warps);
    return makeEngine({GetParam().device, GetParam().precision, threads, 0, GetParam().warps});
  }
  bool fine() const { return GetParam().precision == Precision::Double; }
};

#define GPUDEM_ON_ALL_BACKENDS(fixture)                                                                              \
  INSTANTIATE_TEST_SUITE_P(                                                                                          \
      All, fixture,                                                                                                  \
      ::testing::Values(Backend{DeviceKind::Cpu, Precision::Double}, Backend{DeviceKind::Cpu, Precision::Mixed},     \
                        Backend{DeviceKind::Cpu, Precision::Double, true},                                           \
                        Backend{DeviceKind::Cpu, Precision::Mixed, true},                                            \
                        Backend{DeviceKind::Cpu, Precision::Mixed, true, 4},                                         \
                        Backend{DeviceKind::Gpu, Precision::Double}, Backend{DeviceKind::Gpu, Precision::Mixed},     \
                        Backend{DeviceKind::Gpu, Precision::Double, false, 4},                                       \
                        Backend{DeviceKind::Gpu, Precision::Mixed, false, 4}),                                       \
      backendName)

}  // namespace gpudem::testing
