// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The identity permutation.
#pragma once

#include "base/annotate.hpp"

#include <cstdint>

namespace gpudem {

struct IdentityValues {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] = i; }
};

}  // namespace gpudem
