// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Ranks as threads of one process.
#pragma once

#include "gpudem/errors.h"
#include "gpudem/rank_exchange.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace gpudem::testing {

class RankTeam {
 public:
  explicit RankTeam(int ranks) : ranks_(ranks), board_(ranks), mail_(ranks) {}

  /// work(exchange) in a thread of each rank. The first error of any rank ends all of them and is thrown here.
  void run(const std::function<void(RankExchange &)> &work)
  {
    std::vector<std::thread> threads;
    for (int r = 0; r < ranks_; ++r)
      threads.emplace_back([this, r, &work] {
        Member member(*this, r);
        try {
          work(member);
        } catch (...) {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (!error_) error_ = std::current_exception();
          changed_.notify_all();
        }
      });
    for (std::thread &t : threads) t.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  class Member : public RankExchange {
   public:
    Member(RankTeam &team, int rank) : team_(team), rank_(rank) {}
    int rank() const override { return rank_; }
    int ranks() const override { return team_.ranks_; }
    void gather(const double *mine, int count, double *all) override
    {
      team_.board_[rank_].assign(mine, mine + count);
      team_.meet();
      for (int r = 0; r < team_.ranks_; ++r) {
        if (static_cast<int>(team_.board_[r].size()) != count) throw Error("ranks make different calls");
        std::copy_n(team_.board_[r].data(), count, all + static_cast<std::size_t>(r) * count);
      }
      team_.meet();
    }
    void beginLargest(double *values, int count) override
    {
      values_ = values;
      mine_.assign(values, values + count);
    }
    void finishLargest() override
    {
      const int count = static_cast<int>(mine_.size());
      std::vector<double> all(mine_.size() * ranks());
      gather(mine_.data(), count, all.data());
      for (int r = 0; r < ranks(); ++r)
        for (int k = 0; k < count; ++k) values_[k] = std::max(values_[k], all[static_cast<std::size_t>(r) * count + k]);
    }
    void beginExchange(const std::vector<RankMessage> &send, const std::vector<RankMessage> &receive) override
    {
      team_.mail_[rank_] = send;
      receive_ = receive;
    }
    void finishExchange() override
    {
      team_.meet();
      for (const RankMessage &wanted : receive_) {
        const std::vector<RankMessage> &sent = team_.mail_[wanted.rank];
        const auto it = std::find_if(sent.begin(), sent.end(), [&](const RankMessage &m) { return m.rank == rank_; });
        if (it == sent.end() || it->bytes != wanted.bytes) throw Error("a message is not what its receiver expects");
        std::memcpy(wanted.data, it->data, it->bytes);
      }
      std::size_t meant = 0;
      for (const auto &sent : team_.mail_)
        meant += static_cast<std::size_t>(
            std::count_if(sent.begin(), sent.end(), [&](const RankMessage &m) { return m.rank == rank_; }));
      if (meant != receive_.size()) throw Error("a message has no receiver");
      team_.meet();
    }

   private:
    RankTeam &team_;
    int rank_;
    std::vector<RankMessage> receive_;
    double *values_ = nullptr;
    std::vector<double> mine_;
  };

  /// Wait for all ranks.
  void meet()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const int turn = turn_;
    if (++waiting_ == ranks_) {
      waiting_ = 0;
      ++turn_;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return turn_ != turn || error_; });
    if (turn_ == turn) throw Error("another rank failed");
  }

  int ranks_;
  std::vector<std::vector<double>> board_;
  std::vector<std::vector<RankMessage>> mail_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr error_;
  int waiting_ = 0, turn_ = 0;
};

}  // namespace gpudem::testing
