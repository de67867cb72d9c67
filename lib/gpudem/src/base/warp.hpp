// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the 32 lanes of a warp do together, and the warps of a team; launches that overlap. All lanes must call each of these. On the host they are declared only:
/// the tests define them, and run the code of the GPU lane by lane (unittest/testing/emulated_warp.h).
#pragma once

#include "base/annotate.hpp"

#include <cstdint>
#include <cstring>

namespace gpudem {

constexpr std::uint32_t warpWidth = 32;

/// When a launch begins: after all before it, or on a GPU as soon as the one before lets it (letNextStart()).
enum class Start { InTurn, Early };

namespace host {
std::uint32_t lane();
std::uint32_t warp();
void meetTeam();
std::uint32_t gather(std::uint32_t value, std::uint32_t (*join)(const std::uint32_t *all, std::uint32_t argument),
                     std::uint32_t argument);
}  // namespace host

GPUDEM_HD std::uint32_t warpLane()
{
#ifdef __CUDA_ARCH__
  return threadIdx.x % warpWidth;
#else
  return host::lane();
#endif
}

/// Which warp of its team this is.
GPUDEM_HD std::uint32_t teamWarp()
{
#ifdef __CUDA_ARCH__
  return threadIdx.x / warpWidth;
#else
  return host::warp();
#endif
}

/// What the warps of a team wrote to their shared memory before is seen by all after.
GPUDEM_HD void teamSync()
{
#ifdef __CUDA_ARCH__
  __syncthreads();
#else
  host::meetTeam();
#endif
}

/// Bit k: \p condition of lane k.
GPUDEM_HD std::uint32_t warpBallot(bool condition)
{
#ifdef __CUDA_ARCH__
  return __ballot_sync(0xffffffffu, condition);
#else
  const auto join = [](const std::uint32_t *all, std::uint32_t) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < warpWidth; ++k) bits |= all[k] << k;
    return bits;
  };
  return host::gather(condition ? 1u : 0u, join, 0);
#endif
}

GPUDEM_HD bool warpAny(bool condition)
{
#ifdef __CUDA_ARCH__
  return __any_sync(0xffffffffu, condition);
#else
  return warpBallot(condition) != 0;
#endif
}

/// \p value of lane \p from.
GPUDEM_HD std::uint32_t warpShuffle(std::uint32_t value, std::uint32_t from)
{
#ifdef __CUDA_ARCH__
  return __shfl_sync(0xffffffffu, value, static_cast<int>(from));
#else
  return host::gather(value, [](const std::uint32_t *all, std::uint32_t k) { return all[k]; }, from);
#endif
}

/// \p value, of any number of words, of lane \p from.
template <class T>
GPUDEM_HD T warpTake(const T &value, std::uint32_t from)
{
  std::uint32_t words[sizeof(T) / 4];
  memcpy(words, &value, sizeof value);
  for (std::uint32_t &word : words) word = warpShuffle(word, from);
  T other;
  memcpy(&other, words, sizeof other);
  return other;
}

/// Sum over the lanes, in the same order each time.
template <class Real>
GPUDEM_HD Real warpSum(Real value)
{
  for (std::uint32_t apart = warpWidth / 2; apart > 0; apart /= 2) value += warpTake(value, warpLane() ^ apart);
  return value;
}

/// Largest \p value of all lanes.
GPUDEM_HD std::uint32_t warpMax(std::uint32_t value)
{
#ifdef __CUDA_ARCH__
  return __reduce_max_sync(0xffffffffu, value);
#else
  const auto join = [](const std::uint32_t *all, std::uint32_t) {
    std::uint32_t most = 0;
    for (std::uint32_t k = 0; k < warpWidth; ++k) most = all[k] > most ? all[k] : most;
    return most;
  };
  return host::gather(value, join, 0);
#endif
}

/// What the lanes wrote to their shared memory before is seen by all after.
GPUDEM_HD void warpSync()
{
#ifdef __CUDA_ARCH__
  __syncwarp();
#else
  warpBallot(false);
#endif
}

/// From here on a launch that was made with Start::Early may begin while this one goes on.
GPUDEM_HD void letNextStart()
{
#ifdef __CUDA_ARCH__
  asm volatile("griddepcontrol.launch_dependents;");
#endif
}
/// What the launches before wrote is seen after this. A launch made with Start::Early must call it.
GPUDEM_HD void waitForEarlier()
{
#ifdef __CUDA_ARCH__
  asm volatile("griddepcontrol.wait;" ::: "memory");
#endif
}

/// Clear bits of a word that several lanes may change at a time.
GPUDEM_HD void clearShared(std::uint32_t *word, std::uint32_t bits)
{
#ifdef __CUDA_ARCH__
  atomicAnd(word, ~bits);
#else
  *word &= ~bits;
#endif
}

/// The word as other multiprocessors left it, past this one's cache.
GPUDEM_HD std::uint32_t readFresh(const std::uint32_t *word)
{
#ifdef __CUDA_ARCH__
  return __ldcg(word);
#else
  return *word;
#endif
}

}  // namespace gpudem
