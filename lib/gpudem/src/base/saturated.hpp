// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Sums that stop at the largest number instead of starting anew, so that an overflow is seen at the end of a scan.
#pragma once

#include "base/annotate.hpp"

#include <cstdint>

namespace gpudem {

constexpr std::uint32_t saturated = 0xffffffffu;

/// Associative, as the smaller of saturated and the true sum.
struct AddSaturated {
  GPUDEM_HD std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const { return a > saturated - b ? saturated : a + b; }
};

}  // namespace gpudem
