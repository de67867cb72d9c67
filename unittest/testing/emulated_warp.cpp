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

constexpr std::uint32_t mostWarps = 8, mostLanes = mostWarps * warpWidth;

class Team {
 public:
  void run(std::uint32_t warps, const std::function<void()> &body)
  {
    body_ = &body;
    failure_ = nullptr;
    warps_ = warps;
    for (std::uint32_t k = 0; k < warps * warpWidth; ++k) {
      order_[k] = k;
      state_[k] = State::Runs;
      getcontext(&context_[k]);
      if (stack_[k].empty()) stack_[k].resize(stackBytes);
      context_[k].uc_stack.ss_sp = stack_[k].data();
      context_[k].uc_stack.ss_size = stack_[k].size();
      context_[k].uc_link = &scheduler_;
      makecontext(&context_[k], &Team::enter, 0);
    }
    meeting_.fill(0);
    while (goOn()) {}
  }

  std::uint32_t lane() const { return current_ % warpWidth; }
  std::uint32_t warp() const { return current_ / warpWidth; }

  /// \p value of all lanes of the warp, once each of them has got here.
  const std::uint32_t *meet(std::uint32_t value)
  {
    std::uint32_t *all = value_[warp()][meeting_[warp()] % 2].data();
    all[lane()] = value;
    leave(State::MeetsWarp);
    return all;
  }
  void meetTeam() { leave(State::MeetsTeam); }

 private:
  enum class State { Runs, MeetsWarp, MeetsTeam, Ended };
  static constexpr std::size_t stackBytes = 256 * 1024;
  static void enter();

  void leave(State state)
  {
    const std::uint32_t k = current_;
    state_[k] = state;
    swapcontext(&context_[k], &scheduler_);
  }
  /// Every lane that can runs to its next meeting, in an order that changes.
  bool goOn()
  {
    const std::uint32_t lanes = warps_ * warpWidth;
    for (std::uint32_t n = lanes - 1; n > 0; --n) std::swap(order_[n], order_[next() % (n + 1)]);
    const std::uint32_t chosen = next() % warps_;  // one warp may be ahead of the others
    for (std::uint32_t turn = 0; turn < warps_; ++turn) {
      const std::uint32_t w = (chosen + turn) % warps_;
      if (runWarp(w)) return true;
    }
    if (!all(0, lanes, State::MeetsTeam)) {
      if (all(0, lanes, State::Ended)) return false;
      throw std::logic_error("some warps of a team left while others wait for them");
    }
    for (std::uint32_t k = 0; k < lanes; ++k) state_[k] = State::Runs;
    return true;
  }
  /// \return did it run?
  bool runWarp(std::uint32_t w)
  {
    const std::uint32_t first = w * warpWidth;
    if (!all(first, warpWidth, State::Runs)) return false;
    for (std::uint32_t n = 0; n < warps_ * warpWidth; ++n) {
      const std::uint32_t k = order_[n];
      if (k / warpWidth != w) continue;
      current_ = k;
      swapcontext(&scheduler_, &context_[k]);
      if (failure_) std::rethrow_exception(failure_);
    }
    for (std::uint32_t k = first; k < first + warpWidth; ++k)
      if (state_[k] != state_[first]) throw std::logic_error("some lanes of a warp left while others wait for them");
    ++meeting_[w];
    if (state_[first] == State::MeetsWarp)
      for (std::uint32_t k = first; k < first + warpWidth; ++k) state_[k] = State::Runs;
    return true;
  }
  bool all(std::uint32_t first, std::uint32_t lanes, State state) const
  {
    return std::all_of(state_.begin() + first, state_.begin() + first + lanes, [&](State s) { return s == state; });
  }
  std::uint32_t next()
  {
    random_ = random_ * 1664525u + 1013904223u;
    return random_ >> 8;
  }

  const std::function<void()> *body_ = nullptr;
  std::exception_ptr failure_;
  ucontext_t scheduler_{};
  std::array<ucontext_t, mostLanes> context_{};
  std::array<std::vector<char>, mostLanes> stack_;
  std::array<State, mostLanes> state_{};
  std::array<std::uint32_t, mostLanes> order_{};
  std::array<std::array<std::array<std::uint32_t, warpWidth>, 2>, mostWarps> value_{};
  std::array<std::uint32_t, mostWarps> meeting_{};
  std::uint32_t warps_ = 1, current_ = 0, random_ = 1;
};

Team &team()
{
  static thread_local Team only;  // ranks are threads in tests
  return only;
}

void Team::enter()
{
  Team &t = team();
  try {
    (*t.body_)();
  } catch (...) {
    t.failure_ = std::current_exception();
  }
  t.state_[t.current_] = State::Ended;
}

}  // namespace

void runTeam(std::uint32_t warps, const std::function<void()> &body)
{
  team().run(warps, body);
}

}  // namespace gpudem::testing

namespace gpudem::host {

std::uint32_t lane()
{
  return testing::team().lane();
}

std::uint32_t warp()
{
  return testing::team().warp();
}

void meetTeam()
{
  testing::team().meetTeam();
}

std::uint32_t gather(std::uint32_t value, std::uint32_t (*join)(const std::uint32_t *all, std::uint32_t argument),
                     std::uint32_t argument)
{
  return join(testing::team().meet(value), argument);
}

}  // namespace gpudem::host
