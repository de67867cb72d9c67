// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file How long each kernel of a run takes, for builds with GPUDEM_TIME_KERNELS: a table on standard error at the end.
///
/// A profiler that replays or serialises launches changes what a small scene waits for; two events around every launch
/// cost it about two microseconds and leave the rest as it is.
#pragma once

#include <cuda_runtime.h>
#include <cxxabi.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

namespace gpudem {

class KernelTimes {
 public:
  static KernelTimes &all()
  {
    static KernelTimes only;
    return only;
  }
  void begin(const char *mangled)
  {
    if (next_ == events_.size()) {
      events_.emplace_back();
      cudaEventCreate(&events_.back().first);
      cudaEventCreate(&events_.back().second);
      names_.push_back(nullptr);
    }
    names_[next_] = mangled;
    cudaEventRecord(events_[next_].first);
  }
  void end()
  {
    cudaEventRecord(events_[next_].second);
    if (++next_ == 4096) collect();
  }

 private:
  KernelTimes() = default;
  ~KernelTimes()
  {
    collect();
    double sum = 0.0;
    for (const auto &[name, t] : times_) sum += t.second;
    std::fprintf(stderr, "%10s %12s %10s %6s  kernel\n", "launches", "ms", "us each", "%");
    std::multimap<double, std::string> order;
    for (const auto &[name, t] : times_) order.emplace(-t.second, name);
    for (const auto &[ms, name] : order) {
      const auto &t = times_[name];
      std::fprintf(stderr, "%10ld %12.2f %10.2f %6.1f  %s\n", t.first, t.second, 1e3 * t.second / double(t.first),
                   100.0 * t.second / sum, name.c_str());
    }
  }
  void collect()
  {
    cudaDeviceSynchronize();
    for (std::size_t k = 0; k < next_; ++k) {
      float ms = 0.0f;
      if (cudaEventElapsedTime(&ms, events_[k].first, events_[k].second) != cudaSuccess) continue;
      auto &t = times_[readable(names_[k])];
      ++t.first;
      t.second += ms;
    }
    next_ = 0;
  }
  /// The name up to its second template argument list.
  static std::string readable(const char *mangled)
  {
    int status = 0;
    char *text = abi::__cxa_demangle(mangled, nullptr, nullptr, &status);
    std::string name = text ? text : mangled;
    std::free(text);
    return name.substr(0, 100);
  }

  std::vector<std::pair<cudaEvent_t, cudaEvent_t>> events_;
  std::vector<const char *> names_;
  std::size_t next_ = 0;
  std::map<std::string, std::pair<long, double>> times_;
};

/// Times what is launched while it lives.
class TimedLaunch {
 public:
#ifdef GPUDEM_TIME_KERNELS
  explicit TimedLaunch(const char *name) { KernelTimes::all().begin(name); }
  ~TimedLaunch() { KernelTimes::all().end(); }
#else
  explicit TimedLaunch(const char *) {}
#endif
  TimedLaunch(const TimedLaunch &) = delete;
  TimedLaunch &operator=(const TimedLaunch &) = delete;
};

}  // namespace gpudem
