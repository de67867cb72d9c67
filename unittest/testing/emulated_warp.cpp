// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "testing/emulated_warp.h"

#include <algorithm>
#include <array>
#include <exception>
#include <stdexcept>

#include <ucontext.h>

namespace gpudem::testing {
namespace {

class Warp {
 public:
  void run(const std::function<void()> &body)
  {
    body_ = &body;
    failure_ = nullptr;
    for (std::uint32_t k = 0; k < warpWidth; ++k) {
      order_[k] = k;
      running_[k] = true;
      getcontext(&context_[k]);
      if (stack_[k].empty()) stack_[k].resize(stackBytes);
      context_[k].uc_stack.ss_sp = stack_[k].data();
      context_[k].uc_stack.ss_size = stack_[k].size();
      context_[k].uc_link = &scheduler_;
      makecontext(&context_[k], &Warp::enter, 0);
    }
    for (std::uint32_t left = warpWidth; left > 0;) {
      for (std::uint32_t n = warpWidth - 1; n > 0; --n) std::swap(order_[n], order_[next() % (n + 1)]);
      std::uint32_t ended = 0;
      for (const std::uint32_t k : order_) {
        if (!running_[k]) continue;
        lane_ = k;
        swapcontext(&scheduler_, &context_[k]);
        if (!running_[k]) ++ended;
      }
      if (failure_) std::rethrow_exception(failure_);
      if (ended != 0 && ended != left) throw std::logic_error("some lanes of a warp left while others wait for them");
      left -= ended;
      ++meeting_;
    }
  }

  std::uint32_t lane() const { return lane_; }

  /// \p value of all lanes, once every lane has got here.
  const std::uint32_t *meet(std::uint32_t value)
  {
    std::uint32_t *all = value_[meeting_ % 2].data();
    all[lane_] = value;
    const std::uint32_t k = lane_;
    swapcontext(&context_[k], &scheduler_);
    return all;
  }

 private:
  static constexpr std::size_t stackBytes = 256 * 1024;
  static void enter();

  std::uint32_t next()
  {
    random_ = random_ * 1664525u + 1013904223u;
    return random_ >> 8;
  }

  const std::function<void()> *body_ = nullptr;
  std::exception_ptr failure_;
  ucontext_t scheduler_{};
  std::array<ucontext_t, warpWidth> context_{};
  std::array<std::vector<char>, warpWidth> stack_;
  std::array<bool, warpWidth> running_{};
  std::array<std::uint32_t, warpWidth> order_{};
  std::array<std::array<std::uint32_t, warpWidth>, 2> value_{};
  std::uint32_t lane_ = 0, meeting_ = 0, random_ = 1;
};

Warp &warp()
{
  static thread_local Warp only;  // ranks are threads in tests
  return only;
}

void Warp::enter()
{
  Warp &w = warp();
  try {
    (*w.body_)();
  } catch (...) {
    w.failure_ = std::current_exception();
  }
  w.running_[w.lane_] = false;
}

}  // namespace

void runWarp(const std::function<void()> &body)
{
  warp().run(body);
}

}  // namespace gpudem::testing

namespace gpudem::host {

std::uint32_t lane()
{
  return testing::warp().lane();
}

std::uint32_t gather(std::uint32_t value, std::uint32_t (*join)(const std::uint32_t *all, std::uint32_t argument),
                     std::uint32_t argument)
{
  return join(testing::warp().meet(value), argument);
}

}  // namespace gpudem::host
