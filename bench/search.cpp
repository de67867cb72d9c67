// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour search alone on one CPU thread: candidates tested per pair found, and time per build, against the
/// distribution of sizes, the ratio of largest to smallest and the levels. The counts are the same on every machine.
///
///   search-bench [grains] [repetitions]

#include "testing/level_search.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <map>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

enum class Distribution { EqualVolumes, LogNormal, PowerLaw };
const std::map<Distribution, const char *> names = {
    {Distribution::EqualVolumes, "two sizes, equal volumes"},
    {Distribution::LogNormal, "log-normal"},
    {Distribution::PowerLaw, "equal volume per octave"},
};

double drawRadius(Distribution distribution, double ratio, std::mt19937_64 &random)
{
  const double u = std::uniform_real_distribution<double>(0.0, 1.0)(random);
  switch (distribution) {
    case Distribution::EqualVolumes:
      return u * (1.0 + ratio * ratio * ratio) < 1.0 ? ratio : 1.0;
    case Distribution::LogNormal: {  // by number, six standard deviations between the ends
      std::normal_distribution<double> normal(0.5 * std::log(ratio), std::log(ratio) / 6.0);
      return std::clamp(std::exp(normal(random)), 1.0, ratio);
    }
    case Distribution::PowerLaw:  // number density r^-4
      return std::pow(1.0 - u * (1.0 - std::pow(ratio, -3.0)), -1.0 / 3.0);
  }
  return 1.0;
}

/// Placed grains by octaves of their radius.
class Placed {
 public:
  bool isFree(const Vec3<double> &x, double radius) const
  {
    for (const auto &[octave, cells] : octaves_) {
      const double edge = edgeOf(octave), reach = radius + edge;
      std::array<int, 3> lo, hi;
      for (int d = 0; d < 3; ++d) {
        lo[d] = static_cast<int>(std::floor((x[d] - reach) / edge));
        hi[d] = static_cast<int>(std::floor((x[d] + reach) / edge));
      }
      for (int a = lo[0]; a <= hi[0]; ++a)
        for (int b = lo[1]; b <= hi[1]; ++b)
          for (int c = lo[2]; c <= hi[2]; ++c) {
            const auto found = cells.find({a, b, c});
            if (found == cells.end()) continue;
            for (const auto &[y, r] : found->second) {
              const Vec3<double> s{x.x - y.x, x.y - y.y, x.z - y.z};
              const double least = closest * (radius + r);
              if (dot(s, s) < least * least) return false;
            }
          }
    }
    return true;
  }
  void add(const Vec3<double> &x, double radius)
  {
    const int octave = static_cast<int>(std::floor(std::log2(radius)));
    const double edge = edgeOf(octave);
    octaves_[octave][{static_cast<int>(std::floor(x.x / edge)), static_cast<int>(std::floor(x.y / edge)),
                      static_cast<int>(std::floor(x.z / edge))}]
        .emplace_back(x, radius);
  }

 private:
  static constexpr double closest = 0.8;  ///< distance of two grains over the sum of their radii
  static double edgeOf(int octave) { return std::ldexp(1.0, octave + 1); }
  using Cells = std::map<std::array<int, 3>, std::vector<std::pair<Vec3<double>, double>>>;
  std::map<int, Cells> octaves_;
};

/// Random grains, the large ones first, volume half of the box.
Cloud pack(Distribution distribution, double ratio, std::size_t count)
{
  std::mt19937_64 random(17);
  Cloud c;
  c.skin = 0.2;
  c.box.periodic = {false, false, false};
  double volume = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    c.radius.push_back(drawRadius(distribution, ratio, random));
    volume += 4.0 / 3.0 * 3.14159265358979 * std::pow(c.radius.back(), 3.0);
  }
  if (ratio > 1.0) c.radius[0] = ratio;  // at least one of the largest
  std::sort(c.radius.rbegin(), c.radius.rend());
  const double edge = std::max(std::cbrt(volume / 0.5), 4.0 * ratio);
  for (int d = 0; d < 3; ++d) c.box.hi[d] = edge;
  std::uniform_real_distribution<double> place(0.0, edge);
  Placed placed;
  for (const double radius : c.radius) {
    Vec3<double> x;
    for (int attempt = 0; attempt < 30; ++attempt) {
      x = {place(random), place(random), place(random)};
      if (placed.isFree(x, radius)) break;
    }
    placed.add(x, radius);
    c.x.push_back(x);
  }
  return c;
}

struct Result {
  int levels;
  double candidates;  ///< per pair
  double time;        ///< of a build, median (s)
};

Result measure(const Cloud &c, int levels, double ratio, std::size_t repetitions)
{
  Search<Mixed> search(c, levels, ratio);
  const auto [candidates, pairs] = search.count();
  std::vector<double> times;
  for (std::size_t k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    search.build();
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return {search.levels, static_cast<double>(candidates) / static_cast<double>(pairs), times[repetitions / 2]};
}

}  // namespace

int main(int count, char **arguments)
{
  const std::size_t grains = count > 1 ? std::stoul(arguments[1]) : 100000;
  const std::size_t repetitions = count > 2 ? std::stoul(arguments[2]) : 5;
  std::printf("| sizes | ratio | rule | levels | candidates per pair | ms per build |\n|---|---|---|---|---|---|\n");
  for (const auto &[distribution, name] : names)
    for (const double ratio : {1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0}) {
      const Cloud c = pack(distribution, ratio, grains);
      const auto print = [&, name = name](const std::string &rule, int levels, double step) {
        if (levels == 1 && ratio > 10.0) return;  // minutes
        const Result r = measure(c, levels, step, repetitions);
        std::printf("| %s | %g | %s | %d | %.2f | %.1f |\n", name, ratio, rule.c_str(), r.levels, r.candidates, 1e3 * r.time);
        std::fflush(stdout);
      };
      for (const int levels : {1, 2, 3, 4, 5, 6, 8})
        if (levels == 1 || ratio > 1.0) print(std::to_string(levels) + " asked for", levels, 2.0);
      for (const double step : {2.0, 3.0, 4.0})
        if (ratio > 1.0) print(fmt::format("steps of {:g}", step), 0, step);
    }
  return 0;
}
