// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_GPUDEM_MPI_RANK_EXCHANGE_H
#define LMP_GPUDEM_MPI_RANK_EXCHANGE_H

#include "gpudem/rank_exchange.h"

#include <mpi.h>

#include <string>

namespace LAMMPS_NS {

/// Messages of the engines by MPI, from and to host memory, in a communicator of their own.
class MpiRankExchange : public gpudem::RankExchange {
 public:
  explicit MpiRankExchange(MPI_Comm world);
  ~MpiRankExchange() override;
  MpiRankExchange(const MpiRankExchange &) = delete;
  MpiRankExchange &operator=(const MpiRankExchange &) = delete;

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  void gather(const double *mine, int count, double *all) override;
  void beginLargest(double *values, int count) override;
  void finishLargest() override;
  void beginExchange(const std::vector<gpudem::RankMessage> &send,
                     const std::vector<gpudem::RankMessage> &receive) override;
  void finishExchange() override;

  /// This rank among those of its host, and how many they are.
  int rankOnHost() const { return rankOnHost_; }
  int ranksOnHost() const { return ranksOnHost_; }
  /// Seconds spent here since the last call, mostly in waiting for other ranks.
  double takeSeconds();
  /// For the log.
  std::string name() const { return "MPI through host memory"; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, ranks_ = 1, rankOnHost_ = 0, ranksOnHost_ = 1;
  double seconds_ = 0.0;
  std::vector<MPI_Request> requests_;  ///< of messages
  MPI_Request largest_ = MPI_REQUEST_NULL;
};

}  // namespace LAMMPS_NS
#endif
