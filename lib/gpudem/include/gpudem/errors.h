// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The one exception family of the library: what was attempted, with which values.
#pragma once

#include <stdexcept>
#include <string>

namespace gpudem {

/// Any failure of the library. The text names what was attempted and the offending values.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A device allocation that did not fit; the text names the array, its bytes and how many grains would fit.
class OutOfMemory : public Error {
 public:
  using Error::Error;
};

/// The physical state cannot be advanced (not-a-number, a grain crossing cells in one step).
class UnstableState : public Error {
 public:
  using Error::Error;
};

}  // namespace gpudem
