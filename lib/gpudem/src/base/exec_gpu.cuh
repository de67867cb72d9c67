// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The CUDA backend: one stream, one launch helper, CUB for scans, sorts and sums.
#pragma once

#include "base/buffer.hpp"
#include "base/identity.hpp"
#include "base/kernel_times.cuh"
#include "base/saturated.hpp"
#include "base/warp.hpp"
#include "gpudem/errors.h"

#include <cub/cub.cuh>
#include <cuda_runtime.h>
#include <fmt/format.h>
#include <thrust/iterator/counting_iterator.h>

#include <array>
#include <cstdint>
#include <string>

namespace gpudem {

/// Throw with the CUDA name and what was attempted.
inline void check(cudaError_t status, const char *what)
{
  if (status == cudaSuccess) return;
  cudaGetLastError();
  throw Error(fmt::format("CUDA: {} failed: {} ({})", what, cudaGetErrorString(status), cudaGetErrorName(status)));
}

template <class F>
__global__ void __launch_bounds__(F::blockSize, F::minimumBlocks) forEachKernel(std::uint32_t count, const __grid_constant__ F f)
{
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count) f(i);
}

template <class F>
__global__ void __launch_bounds__(F::blockSize, F::minimumBlocks) forEachWarpKernel(std::uint32_t count, const __grid_constant__ F f)
{
  __shared__ typename F::Shared shared[F::blockSize / 32];
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i - threadIdx.x % 32 < count) f(i, i < count, shared[threadIdx.x / 32]);
}

/// One unit of work for each block, whose warps are a team.
template <class F>
__global__ void __launch_bounds__(F::blockSize, F::minimumBlocks) forEachTeamKernel(const __grid_constant__ F f)
{
  __shared__ typename F::Shared shared;
  f(blockIdx.x, shared);
}

/// Host memory that stays where it is, so that the GPU copies from and to it without a detour.
struct PinnedMemory {
  static void *allocate(std::size_t bytes, const char *name)
  {
    void *p = nullptr;
    const cudaError_t status = cudaMallocHost(&p, bytes);
    if (status == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      throw OutOfMemory(fmt::format("out of pinned host memory: array '{}' needs {} bytes", name, bytes));
    }
    check(status, name);
    return p;
  }
  static void release(void *p) noexcept
  {
    if (p) cudaFreeHost(p);
  }
};

class GpuExec {
 public:
  static constexpr bool onGpu = true;
  template <class T>
  using Array = Buffer<GpuExec, T>;
  template <class T>
  using HostArray = Buffer<PinnedMemory, T>;

  explicit GpuExec(int device)
  {
    check(cudaSetDevice(device), "selecting the GPU");
    check(cudaGetDeviceProperties(&properties_, device), "reading the properties of the GPU");
  }

  std::string name() const
  {
    return fmt::format("{} (compute capability {}.{}, {:.0f} GiB)", properties_.name, properties_.major,
                       properties_.minor, static_cast<double>(properties_.totalGlobalMem) / (1ull << 30));
  }
  std::size_t capacity() const { return properties_.totalGlobalMem; }

  static void *allocate(std::size_t bytes, const char *name)
  {
    void *p = nullptr;
    const cudaError_t status = cudaMalloc(&p, bytes);
    if (status == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      std::size_t free = 0, total = 0;
      cudaMemGetInfo(&free, &total);
      throw OutOfMemory(fmt::format("out of GPU memory: array '{}' needs {} bytes, {} of {} bytes are free", name,
                                    bytes, free, total));
    }
    check(status, name);
    return p;
  }
  static void release(void *p) noexcept
  {
    if (p) cudaFree(p);
  }

  template <class F>
  void forEach(std::uint32_t count, const F &f, Start start = Start::InTurn) const
  {
    launch(forEachKernel<F>, (count + F::blockSize - 1) / F::blockSize, start, f, count, f);
  }
  /// f(i, i < count, memory of the warp) for whole warps, whose lanes work together.
  template <class F>
  void forEachWarp(std::uint32_t count, const F &f, Start start = Start::InTurn) const
  {
    launch(forEachWarpKernel<F>, (count + F::blockSize - 1) / F::blockSize, start, f, count, f);
  }
  /// f(unit, memory of the team) for teams of F::teamWarps warps.
  template <class F>
  void forEachTeam(std::uint32_t units, const F &f, Start start = Start::InTurn) const
  {
    launch(forEachTeamKernel<F>, units, start, f, f);
  }
  /// Two warps for each scheduler.
  std::uint32_t fewWarps() const { return 8u * static_cast<std::uint32_t>(properties_.multiProcessorCount); }

  template <class T, class F, class Op>
  T reduce(std::uint32_t count, const F &f, const Op &op, const T &init)
  {
    const TimedLaunch timed("reduction");
    result_.reserve(sizeof(T));
    T *out = reinterpret_cast<T *>(result_.data());
    thrust::counting_iterator<std::uint32_t> in(0);
    std::size_t bytes = 0;
    check(cub::DeviceReduce::TransformReduce(nullptr, bytes, in, out, count, op, f, init), "sizing a reduction");
    scratch_.reserve(bytes);
    check(cub::DeviceReduce::TransformReduce(scratch_.data(), bytes, in, out, count, op, f, init), "reducing");
    T host;
    check(cudaMemcpy(&host, out, sizeof(T), cudaMemcpyDeviceToHost), "reading a reduction");
    return host;
  }

  /// out[k] = sum of in[0 .. k-1], at most 2^32 - 1; out has count + 1 entries.
  void scan(const std::uint32_t *in, std::uint32_t *out, std::uint32_t count)
  {
    const TimedLaunch timed("scan");
    check(cudaMemsetAsync(out, 0, sizeof(std::uint32_t)), "clearing a scan");
    if (count == 0) return;
    std::size_t bytes = 0;
    check(cub::DeviceScan::InclusiveScan(nullptr, bytes, in, out + 1, AddSaturated{}, count), "sizing a scan");
    scratch_.reserve(bytes);
    check(cub::DeviceScan::InclusiveScan(scratch_.data(), bytes, in, out + 1, AddSaturated{}, count), "scanning");
  }
  /// Numbers of the device's memory, with one wait for all.
  template <std::size_t n>
  std::array<std::uint32_t, n> read(const std::uint32_t *const (&from)[n])
  {
    const TimedLaunch timed("read");
    read_.reserve(n);
    for (std::size_t k = 0; k < n; ++k)
      check(cudaMemcpyAsync(read_.data() + k, from[k], sizeof *from[k], cudaMemcpyDeviceToHost), "reading a number");
    synchronize();
    std::array<std::uint32_t, n> result;
    for (std::size_t k = 0; k < n; ++k) result[k] = read_.data()[k];
    return result;
  }
  /// scan(), and its total; 2^32 - 1 stands for that and all above.
  std::uint32_t exclusiveScan(const std::uint32_t *in, std::uint32_t *out, std::uint32_t count)
  {
    scan(in, out, count);
    return read({out + count})[0];
  }

  void sort(Array<std::uint32_t> &key, Array<std::uint32_t> &keyOut, Array<std::uint32_t> &order, std::uint32_t count,
            std::uint32_t range)
  {
    int bits = 1;
    while (bits < 32 && (1ull << bits) < range) ++bits;
    thrust::counting_iterator<std::uint32_t> first(0);
    if (identity_.capacity() < count) {
      identity_.reserve(count);
      forEach(static_cast<std::uint32_t>(identity_.capacity()), IdentityValues{identity_.data()});
    }
    const TimedLaunch timed("sort");
    std::size_t bytes = 0;
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, key.data(), keyOut.data(), identity_.data(), order.data(),
                                          count, 0, bits),
          "sizing a sort");
    scratch_.reserve(bytes);
    check(cub::DeviceRadixSort::SortPairs(scratch_.data(), bytes, key.data(), keyOut.data(), identity_.data(),
                                          order.data(), count, 0, bits),
          "sorting");
  }

  template <class T>
  void fill(T *p, std::size_t count, int byte) const
  {
    if (count) check(cudaMemset(p, byte, count * sizeof(T)), "filling an array");
  }
  template <class T>
  void copyIn(T *device, const T *host, std::size_t count) const
  {
    const TimedLaunch timed("copy to device");
    if (count) check(cudaMemcpy(device, host, count * sizeof(T), cudaMemcpyHostToDevice), "copying to the GPU");
  }
  template <class T>
  void copyOut(T *host, const T *device, std::size_t count) const
  {
    const TimedLaunch timed("copy to host");
    if (count) check(cudaMemcpy(host, device, count * sizeof(T), cudaMemcpyDeviceToHost), "copying from the GPU");
  }
  void synchronize() const
  {
    check(cudaDeviceSynchronize(), "running the queued kernels");
  }

 private:
  template <class F, class Kernel, class... Arguments>
  void launch(Kernel *kernel, std::uint32_t blocks, Start start, const F &, const Arguments &...arguments) const
  {
    if (blocks == 0) return;
    const TimedLaunch timed(typeid(F).name());
    cudaLaunchAttribute early{};
    early.id = cudaLaunchAttributeProgrammaticStreamSerialization;
    early.val.programmaticStreamSerializationAllowed = 1;
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(blocks);
    config.blockDim = dim3(F::blockSize);
    config.attrs = &early;
    config.numAttrs = start == Start::Early ? 1 : 0;
    check(cudaLaunchKernelEx(&config, kernel, arguments...), "launching a kernel");
#ifdef GPUDEM_SYNC_LAUNCHES
    check(cudaDeviceSynchronize(), "running a kernel");
#endif
  }

  cudaDeviceProp properties_{};
  Array<unsigned char> scratch_{"scratch of CUB"};
  Array<unsigned char> result_{"result of a reduction"};
  Array<std::uint32_t> identity_{"identity permutation"};
  HostArray<std::uint32_t> read_{"numbers read back"};
};

}  // namespace gpudem
