// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Arithmetic whose rounding must not be left to the compiler, bits, and atomics on the status word.
#pragma once

#include "base/annotate.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace gpudem {

/// a*b + c*d rounded product by product: contraction into a fused multiply-add would make the result
/// depend on which of the two grains asks, and the two sides of a contact must agree to the last bit.
GPUDEM_HD float symmetricSum(float a, float b, float c, float d)
{
#ifdef __CUDA_ARCH__
  return __fadd_rn(__fmul_rn(a, b), __fmul_rn(c, d));
#else
  return a * b + c * d;
#endif
}
GPUDEM_HD double symmetricSum(double a, double b, double c, double d)
{
#ifdef __CUDA_ARCH__
  return __dadd_rn(__dmul_rn(a, b), __dmul_rn(c, d));
#else
  return a * b + c * d;
#endif
}

/// 2^52 + 2^51: a double of this size has its integer in the lower bits.
constexpr double roundingShift = 6755399441055744.0;

/// Nearest integer of |x| < 2^51, halves to even: adding 2^52 + 2^51 leaves the integer in the lower bits. Unlike
/// the conversion instruction this fits the SIMD lanes of every processor.
GPUDEM_HD std::int64_t roundSmall(double x)
{
  const double sum = x + roundingShift, zero = roundingShift;
  std::int64_t bits, zeroBits;
  memcpy(&bits, &sum, 8);
  memcpy(&zeroBits, &zero, 8);
  return bits - zeroBits;
}

/// Nearest integer of |x| < 2^51.
GPUDEM_HD std::int64_t roundToInt(float x)
{
#ifdef __CUDA_ARCH__
  return __float2ll_rn(x);
#else
  return roundSmall(static_cast<double>(x));
#endif
}
/// Nearest integer of |x| < 2^63.
GPUDEM_HD std::int64_t roundToInt(double x)
{
#ifdef __CUDA_ARCH__
  return __double2ll_rn(x);
#else
  const double upper = (x * 0x1p-32 + roundingShift) - roundingShift;  // an integer
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(roundSmall(upper)) << 32) +
         roundSmall(x - upper * 0x1p32);
#endif
}

/// \p x as double, rounded to nearest. A GPU converts 64-bit integers slowly: here the halves become doubles by
/// their bit patterns (2^52 plus the integer), and one multiply-add joins and rounds them.
GPUDEM_HD double toDouble(std::int64_t x)
{
#ifdef __CUDA_ARCH__
  const double upper =
      __hiloint2double(0x43300000, static_cast<int>(x >> 32) ^ static_cast<int>(0x80000000)) - 4503601774854144.0;
  const double lower = __hiloint2double(0x43300000, static_cast<int>(x)) - 4503599627370496.0;
  return __fma_rn(upper, 4294967296.0, lower);
#else
  return static_cast<double>(x);
#endif
}
GPUDEM_HD double toDouble(std::int32_t x)
{
#ifdef __CUDA_ARCH__
  return __hiloint2double(0x43300000, x ^ static_cast<int>(0x80000000)) - 4503601774854144.0;  // 2^52 + 2^31
#else
  return static_cast<double>(x);
#endif
}

/// Byte \p k of \p word plus a constant that depends on the backend alone: differences are exact.
GPUDEM_HD float biasedByte(std::uint32_t word, int k)
{
#ifdef __CUDA_ARCH__
  return __uint_as_float(__byte_perm(word, 0x4b000000u, 0x7440u | static_cast<std::uint32_t>(k)));  // 2^23 + byte
#else
  return static_cast<float>(static_cast<std::int32_t>(word >> (8 * k) & 0xffu));
#endif
}

/// Ask for the memory at \p address, which will be read soon.
template <class T>
GPUDEM_HD void prefetchLine(const T *address)
{
#ifdef __CUDA_ARCH__
  asm volatile("prefetch.global.L1 [%0];" ::"l"(address));
#else
  __builtin_prefetch(address);
#endif
}

template <class Real>
GPUDEM_HD Real absolute(Real x)
{
  return x < Real(0) ? -x : x;
}

GPUDEM_HD float squareRoot(float x)
{
#ifdef __CUDA_ARCH__
  return sqrtf(x);
#else
  return std::sqrt(x);
#endif
}
GPUDEM_HD double squareRoot(double x)
{
#ifdef __CUDA_ARCH__
  return sqrt(x);
#else
  return std::sqrt(x);
#endif
}

/// Cube root of a positive number on the CPU, without branches or calls so that it fits SIMD lanes: a third of the
/// exponent for a start (5 % off), then Halley's iteration, which triples the digits. Zero stays zero.
template <int iterations>
double cubeRootInLanes(double x)
{
  std::int64_t bits;
  memcpy(&bits, &x, 8);
  const auto upper = static_cast<std::int32_t>(bits >> 32);
  // the exponent's bias of 1023 becomes 682; the last digits make the error symmetric
  const auto third = static_cast<std::int32_t>(static_cast<double>(upper) * (1.0 / 3.0) + 715094163.0);
  bits = static_cast<std::int64_t>(third) << 32;
  double y;
  memcpy(&y, &bits, 8);
  for (int k = 0; k < iterations; ++k) {
    const double cube = y * y * y;
    y *= (cube + 2.0 * x) / (2.0 * cube + x);
  }
  return x > 0.0 ? y : 0.0;
}

/// Cube root of a number that is not negative.
GPUDEM_HD float cubeRoot(float x)
{
#ifdef __CUDA_ARCH__
  return cbrtf(x);
#else
  return static_cast<float>(cubeRootInLanes<2>(static_cast<double>(x)));
#endif
}
GPUDEM_HD double cubeRoot(double x)
{
#ifdef __CUDA_ARCH__
  return cbrt(x);
#else
  return cubeRootInLanes<3>(x);
#endif
}

/// Quotient to two units in the last place in float (one instruction less than the exact one on a GPU).
GPUDEM_HD float divide(float a, float b)
{
#ifdef __CUDA_ARCH__
  return __fdividef(a, b);
#else
  return a / b;
#endif
}
GPUDEM_HD double divide(double a, double b)
{
  return a / b;
}

GPUDEM_HD float inverseSquareRoot(float x)
{
#ifdef __CUDA_ARCH__
  return rsqrtf(x);
#else
  return 1.0f / std::sqrt(x);
#endif
}
GPUDEM_HD double inverseSquareRoot(double x)
{
  return 1.0 / squareRoot(x);
}

GPUDEM_HD int lowestBit(std::uint32_t bits)
{
#ifdef __CUDA_ARCH__
  return __ffs(static_cast<int>(bits)) - 1;
#else
  return __builtin_ctz(bits);
#endif
}
GPUDEM_HD int bitCount(std::uint32_t bits)
{
#ifdef __CUDA_ARCH__
  return __popc(bits);
#else
  return __builtin_popcount(bits);
#endif
}
GPUDEM_HD int bitCount64(std::uint64_t bits)
{
#ifdef __CUDA_ARCH__
  return __popcll(bits);
#else
  return __builtin_popcountll(bits);
#endif
}

/// Number of pieces of \p size that hold \p count.
GPUDEM_HD std::uint32_t chunksOf(std::uint32_t count, std::uint32_t size)
{
  return (count + size - 1) / size;
}

/// Put \p value where \p expected stands. \return false if something else stands there
GPUDEM_HD bool atomicClaim(std::uint32_t *address, std::uint32_t expected, std::uint32_t value)
{
#ifdef __CUDA_ARCH__
  return atomicCAS(address, expected, value) == expected;
#else
  return __atomic_compare_exchange_n(address, &expected, value, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
#endif
}

/// Smallest value wins: deterministic whatever the order of the threads.
GPUDEM_HD void atomicLower(std::uint32_t *address, std::uint32_t value)
{
#ifdef __CUDA_ARCH__
  atomicMin(address, value);
#else
  std::uint32_t old = __atomic_load_n(address, __ATOMIC_RELAXED);
  while (value < old && !__atomic_compare_exchange_n(address, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
#endif
}

/// Largest value wins.
GPUDEM_HD void atomicRaise(std::uint32_t *address, std::uint32_t value)
{
#ifdef __CUDA_ARCH__
  atomicMax(address, value);
#else
  std::uint32_t old = __atomic_load_n(address, __ATOMIC_RELAXED);
  while (value > old && !__atomic_compare_exchange_n(address, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
#endif
}

/// The float of a pattern.
inline float floatOf(std::uint32_t bits)
{
  float x;
  memcpy(&x, &bits, 4);
  return x;
}

/// Pattern of a float; patterns of numbers that are not negative sort like the numbers.
GPUDEM_HD std::uint32_t bitsOf(float x)
{
  std::uint32_t bits;
  memcpy(&bits, &x, 4);
  return bits;
}

}  // namespace gpudem
