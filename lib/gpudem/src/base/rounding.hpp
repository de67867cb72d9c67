// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Sums whose rounding errors do not pile up.
///
/// A velocity that gains nearly the same small increment in every step is rounded the same way every time, and the
/// error grows with the number of steps. Rounding up or down with the probability of the part cut off makes the
/// error zero on average, so that it grows with the square root only (stochastic rounding; Croci et al., R. Soc.
/// Open Sci. 9 (2022) 211631). The choice comes from a hash of grain and step: the same bits in every run.
#pragma once

#include "base/annotate.hpp"

#include <cstdint>
#include <cstring>

namespace gpudem {

/// Well-mixed 32 bits of \p x (multiply and xor-shift).
GPUDEM_HD std::uint32_t mixBits(std::uint32_t x)
{
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

/// Random bits of one grain in one step.
class RoundingBits {
 public:
  GPUDEM_HD RoundingBits(std::uint32_t grain, std::uint32_t step) : state_(mixBits(grain ^ mixBits(step))) {}
  GPUDEM_HD std::uint32_t next()
  {
    state_ = state_ * 0x915f77f5u + 0x9e3779b9u;
    return state_ ^ (state_ >> 16);
  }

 private:
  std::uint32_t state_;
};

/// a + b in single precision, rounded up or down at random without bias.
GPUDEM_HD float addUnbiased(float a, float b, RoundingBits &random)
{
  const double sum = static_cast<double>(a) + static_cast<double>(b);
  std::uint64_t bits;
  memcpy(&bits, &sum, 8);
  constexpr std::uint64_t cut = 0x1fffffffu;  // the 29 bits that a float does not hold
  bits = (bits + (random.next() & cut)) & ~cut;
  double kept;
  memcpy(&kept, &bits, 8);
  return static_cast<float>(kept);
}
/// Double precision needs no such care.
GPUDEM_HD double addUnbiased(double a, double b, RoundingBits &)
{
  return a + b;
}

}  // namespace gpudem
