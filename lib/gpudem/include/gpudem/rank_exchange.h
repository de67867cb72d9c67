// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What engines of several ranks need of each other. The caller implements it, for example with MPI.
#pragma once

#include <cstddef>
#include <vector>

namespace gpudem {

/// Bytes for or from another rank.
struct RankMessage {
  int rank;
  void *data;
  std::size_t bytes;
};

/// Ranks that share a box. All calls but the first three are collective: every rank makes them in the same order.
class RankExchange {
 public:
  virtual ~RankExchange() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  /// May messages lie in the memory of the device?
  virtual bool readsDeviceMemory() const { return false; }

  /// \param mine [count]
  /// \param all  [ranks][count] the numbers of all ranks
  virtual void gather(const double *mine, int count, double *all) = 0;
  /// Replace each number by the largest of all ranks. Other calls may lie between begin and finish; until then the
  /// numbers must stay where they are.
  virtual void beginLargest(double *values, int count) = 0;
  virtual void finishLargest() = 0;
  /// Send and receive, as above. A rank names in \p receive exactly what others send to it.
  virtual void beginExchange(const std::vector<RankMessage> &send, const std::vector<RankMessage> &receive) = 0;
  virtual void finishExchange() = 0;
};

}  // namespace gpudem
