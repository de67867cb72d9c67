// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The CPU backend: threads over grains, the same interface as exec_gpu.cuh.
#pragma once

#include "base/buffer.hpp"
#include "base/saturated.hpp"
#include "base/warp.hpp"
#include "gpudem/errors.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace gpudem {

/// Where and how loops run. Results never depend on the number of threads.
class CpuExec {
 public:
  static constexpr bool onGpu = false;
  template <class T>
  using Array = Buffer<CpuExec, T>;
  template <class T>
  using HostArray = Array<T>;  ///< host memory from and to which copies are fast

  explicit CpuExec(int threads) : threads_(std::max(1, threads)) {}

  std::string name() const { return "CPU, " + std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads"); }
  std::size_t capacity() const { return 0; }

  static void *allocate(std::size_t bytes, const char *name)
  {
    void *p = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!p)
      throw OutOfMemory("out of memory: array '" + std::string(name) + "' needs " + std::to_string(bytes) + " bytes");
    return p;
  }
  static void release(void *p) noexcept { std::free(p); }

  template <class F>
  void forEach(std::uint32_t count, const F &f, Start = Start::InTurn) const
  {
    inTeam(count, 1024, f);
  }

  /// The same for work that comes in pieces of some hundred grains.
  template <class F>
  void forEachChunk(std::uint32_t chunks, const F &f) const
  {
    inTeam(chunks, 2, f);
  }

  /// op over f(0) .. f(count-1) in a fixed order: chunks first, then their results.
  template <class T, class F, class Op>
  T reduce(std::uint32_t count, const F &f, const Op &op, const T &init) const
  {
    constexpr std::uint32_t chunk = 2048;
    const std::uint32_t chunks = (count + chunk - 1) / chunk;
    std::vector<T> partial(chunks, init);
    forEachChunk(chunks, [&](std::uint32_t c) {
      T sum = init;
      const std::uint32_t end = std::min(count, (c + 1) * chunk);
      for (std::uint32_t i = c * chunk; i < end; ++i) sum = op(sum, f(i));
      partial[c] = sum;
    });
    T total = init;
    for (const T &p : partial) total = op(total, p);
    return total;
  }

  /// out[k] = sum of in[0 .. k-1], at most 2^32 - 1; out has count + 1 entries.
  void scan(const std::uint32_t *in, std::uint32_t *out, std::uint32_t count) const
  {
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      out[i] = sum;
      sum = AddSaturated{}(sum, in[i]);
    }
    out[count] = sum;
  }
  /// Numbers of the device's memory.
  template <std::size_t n>
  std::array<std::uint32_t, n> read(const std::uint32_t *const (&from)[n]) const
  {
    std::array<std::uint32_t, n> result;
    for (std::size_t k = 0; k < n; ++k) result[k] = *from[k];
    return result;
  }
  /// scan(), and its total; 2^32 - 1 stands for that and all above.
  std::uint32_t exclusiveScan(const std::uint32_t *in, std::uint32_t *out, std::uint32_t count) const
  {
    scan(in, out, count);
    return out[count];
  }

  /// Stable sort of keys below \p range. \p order[k] is the old index of the k-th smallest.
  void sort(Array<std::uint32_t> &key, Array<std::uint32_t> &keyOut, Array<std::uint32_t> &order, std::uint32_t count,
            std::uint32_t range)
  {
    if (range > 4ull * count + (1u << 16)) return sortByDigits(key, keyOut, order, count, range);
    starts_.assign(static_cast<std::size_t>(range) + 1, 0);
    for (std::uint32_t i = 0; i < count; ++i) ++starts_[key.data()[i] + 1];
    for (std::uint32_t c = 0; c < range; ++c) starts_[c + 1] += starts_[c];
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t k = starts_[key.data()[i]]++;
      order.data()[k] = i;
      keyOut.data()[k] = key.data()[i];
    }
  }

  template <class T>
  void fill(T *p, std::size_t count, int byte) const
  {
    if (count) std::memset(static_cast<void *>(p), byte, count * sizeof(T));
  }
  template <class T>
  void copyIn(T *device, const T *host, std::size_t count) const
  {
    if (count) std::memcpy(static_cast<void *>(device), host, count * sizeof(T));
  }
  template <class T>
  void copyOut(T *host, const T *device, std::size_t count) const
  {
    if (count) std::memcpy(static_cast<void *>(host), device, count * sizeof(T));
  }
  void synchronize() const {}

 private:
  /// The same digit by digit, for few keys of a wide range.
  void sortByDigits(Array<std::uint32_t> &key, Array<std::uint32_t> &keyOut, Array<std::uint32_t> &order,
                    std::uint32_t count, std::uint32_t range)
  {
    constexpr int bits = 11;
    constexpr std::uint32_t digits = 1u << bits;
    std::vector<std::uint32_t> from(count), to(count);
    for (std::uint32_t i = 0; i < count; ++i) from[i] = i;
    for (int shift = 0; shift < 32 && (range - 1) >> shift; shift += bits) {
      starts_.assign(digits + 1, 0);
      for (std::uint32_t i = 0; i < count; ++i) ++starts_[(key.data()[i] >> shift & (digits - 1)) + 1];
      for (std::uint32_t d = 0; d < digits; ++d) starts_[d + 1] += starts_[d];
      for (const std::uint32_t i : from) to[starts_[key.data()[i] >> shift & (digits - 1)]++] = i;
      from.swap(to);
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      order.data()[k] = from[k];
      keyOut.data()[k] = key.data()[from[k]];
    }
  }

  /// f(0) .. f(items-1). Waking a thread costs microseconds, so each must get \p least items of its own.
  template <class F>
  void inTeam(std::uint32_t items, std::uint32_t least, const F &f) const
  {
    const auto most = static_cast<std::uint32_t>(threads_);
    const int team = static_cast<int>(std::clamp<std::uint32_t>(items / least, 1u, most));
    if (team == 1) {
      for (std::uint32_t i = 0; i < items; ++i) f(i);
      return;
    }
#pragma omp parallel for num_threads(team) schedule(static)
    for (std::uint32_t i = 0; i < items; ++i) f(i);
  }

  int threads_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace gpudem
