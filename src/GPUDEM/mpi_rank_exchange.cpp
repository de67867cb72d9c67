// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "mpi_rank_exchange.h"

#include "gpudem/errors.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

using namespace LAMMPS_NS;

namespace {
constexpr int ghostTag = 0;

int lengthOf(const gpudem::RankMessage &message)
{
  if (message.bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw gpudem::Error(fmt::format("a message of {} bytes to or from rank {} exceeds what MPI takes; use more ranks",
                                    message.bytes, message.rank));
  return static_cast<int>(message.bytes);
}

/// Adds the time of its life.
class Clock {
 public:
  explicit Clock(double &sum) : sum_(sum), start_(MPI_Wtime()) {}
  ~Clock() { sum_ += MPI_Wtime() - start_; }

 private:
  double &sum_, start_;
};
}  // namespace

MpiRankExchange::MpiRankExchange(MPI_Comm world)
{
  MPI_Comm_dup(world, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &ranks_);
  MPI_Comm host;
  MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &host);
  MPI_Comm_rank(host, &rankOnHost_);
  MPI_Comm_size(host, &ranksOnHost_);
  MPI_Comm_free(&host);
}

MpiRankExchange::~MpiRankExchange()
{
  MPI_Comm_free(&comm_);
}

double MpiRankExchange::takeSeconds()
{
  return std::exchange(seconds_, 0.0);
}

void MpiRankExchange::gather(const double *mine, int count, double *all)
{
  const Clock clock(seconds_);
  MPI_Allgather(mine, count, MPI_DOUBLE, all, count, MPI_DOUBLE, comm_);
}

void MpiRankExchange::beginLargest(double *values, int count)
{
  const Clock clock(seconds_);
  MPI_Iallreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, comm_, &largest_);
}

void MpiRankExchange::finishLargest()
{
  const Clock clock(seconds_);
  MPI_Wait(&largest_, MPI_STATUS_IGNORE);
}

void MpiRankExchange::beginExchange(const std::vector<gpudem::RankMessage> &send,
                                    const std::vector<gpudem::RankMessage> &receive)
{
  const Clock clock(seconds_);
  requests_.resize(send.size() + receive.size());
  std::size_t k = 0;
  for (const gpudem::RankMessage &m : receive)
    MPI_Irecv(m.data, lengthOf(m), MPI_BYTE, m.rank, ghostTag, comm_, &requests_[k++]);
  for (const gpudem::RankMessage &m : send)
    MPI_Isend(m.data, lengthOf(m), MPI_BYTE, m.rank, ghostTag, comm_, &requests_[k++]);
}

void MpiRankExchange::finishExchange()
{
  const Clock clock(seconds_);
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}
