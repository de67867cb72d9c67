// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The code of the GPU on the CPU: the lanes of a warp, or of a team of warps, as coroutines that meet where lanes
/// work together.
///
/// Between two meetings the lanes run one after the other in an order that changes from meeting to meeting, so that what
/// reads shared memory without a warpSync() before finds other values than it should. Lanes that do not meet (one leaves
/// while others wait) are an error.
#pragma once

#include "base/exec_cpu.hpp"
#include "base/warp.hpp"
#include "gpudem/engine.h"

#include <functional>
#include <memory>

namespace gpudem::testing {

/// body() in each lane of a team of \p warps (at most 8); a lane finds its numbers by warpLane() and teamWarp().
void runTeam(std::uint32_t warps, const std::function<void()> &body);

/// The CPU backend with the kernels of the GPU.
class EmulatedExec : public CpuExec {
 public:
  static constexpr bool onGpu = true;

  EmulatedExec() : CpuExec(1) {}
  std::string name() const { return "emulated GPU"; }

  template <class F>
  void forEachWarp(std::uint32_t count, const F &f, Start = Start::InTurn) const
  {
    for (std::uint32_t first = 0; first < count; first += 32) {
      typename F::Shared shared;
      runTeam(1, [&] {
        const std::uint32_t i = first + warpLane();
        f(i, i < count, shared);
      });
    }
  }
  template <class F>
  void forEachTeam(std::uint32_t units, const F &f, Start = Start::InTurn) const
  {
    for (std::uint32_t unit = 0; unit < units; ++unit) {
      typename F::Shared shared;
      runTeam(F::teamWarps, [&] { f(unit, shared); });
    }
  }
  std::uint32_t fewWarps() const { return 0; }
};

std::unique_ptr<Engine> makeEmulatedEngine(Precision precision, int warps = 1);

}  // namespace gpudem::testing
