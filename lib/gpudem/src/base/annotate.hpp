// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Host/device annotation: .hpp files compile for both, .cuh and .cu for CUDA only.
#pragma once

#ifdef __CUDACC__
#define GPUDEM_HD __host__ __device__ __forceinline__
#else
#define GPUDEM_HD inline __attribute__((always_inline))
#endif

/// Code that few grains need: on the GPU a function of its own, so that it takes no registers from those that do not.
#ifdef __CUDACC__
#define GPUDEM_RARE __host__ __device__ __noinline__
#else
#define GPUDEM_RARE inline
#endif

#ifdef __CUDACC__
#define GPUDEM_UNROLL _Pragma("unroll")
#else
#define GPUDEM_UNROLL _Pragma("GCC unroll 8")
#endif
