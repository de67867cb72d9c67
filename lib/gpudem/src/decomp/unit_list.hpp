// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A step on some of its units of work: warps of 32 grains on the GPU, chunks of grains on the CPU.
///
/// Units with grains that other ranks see go first; while their motion travels the others follow.
#pragma once

#include "base/annotate.hpp"

#include <cstdint>

namespace gpudem {

struct UnitList {
  const std::uint32_t *unit;  ///< [count] numbers of the units
  std::uint32_t count;
};

template <class F>
struct OnChunks {
  F f;
  const std::uint32_t *chunk;
  void operator()(std::uint32_t k) const { f(chunk[k]); }
};

/// 1 for units that hold a grain of a message.
struct MarkUnits {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *index;
  std::uint32_t size;  ///< grains of a unit
  std::uint32_t *flag;
  GPUDEM_HD void operator()(std::uint32_t k) const { flag[index[k] / size] = 1u; }
};
struct InvertFlags {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t *flag;
  GPUDEM_HD void operator()(std::uint32_t k) const { flag[k] ^= 1u; }
};

}  // namespace gpudem
