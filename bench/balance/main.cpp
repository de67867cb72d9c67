// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Load balancing alone, for many simulated ranks: balance-bench [scene or all] [most grains] [ranks ...]
///
/// For each scene and number of ranks a first call, then calls after the fastest grains moved by about two diameters.
/// Prints a Markdown table. Every rank's grains are in one process; time is that of one thread per grain.
#include "divisions.h"

#include <cstdio>
#include <cstdlib>

using namespace bench;

namespace {

constexpr int frames = 6;               // calls after the first
constexpr std::size_t perRank = 10000;  // grains, unless there would be more than the most

struct Result {
  double imbalance = 0.0;  // largest of all calls
  double moved = 0.0;      // share of the grains that change rank in a call
  double ghosts = 0.0;     // per grain
  double sums = 0.0, numbers = 0.0, first = 0.0;
  double time = 0.0;  // seconds per grain and call
};

/// \param film  positions at each call
Result measure(Division &division, const std::vector<std::vector<double>> &film, int ranks, double diameter)
{
  Result result;
  const std::size_t count = film[0].size() / 3;
  std::vector<int> owner(count), before;
  for (int frame = 0; frame <= frames; ++frame) {
    const std::vector<double> &x = film[frame];
    const auto start = std::chrono::steady_clock::now();
    const Cost cost = division.divide(x);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<int> load(ranks, 0);
    for (std::size_t i = 0; i < count; ++i) ++load[owner[i] = division.rankOf(&x[3 * i])];
    const double imbalance = *std::max_element(load.begin(), load.end()) * static_cast<double>(ranks) / count;
    result.imbalance = std::max(result.imbalance, imbalance);
    if (frame == 0) {
      result.first = cost.sums;
    } else {
      std::size_t changed = 0;
      for (std::size_t i = 0; i < count; ++i) changed += owner[i] != before[i];
      result.moved += static_cast<double>(changed) / count / frames;
      result.sums += static_cast<double>(cost.sums) / frames;
      result.numbers += static_cast<double>(cost.numbers) / frames;
      result.time += seconds / count / frames;
    }
    before = owner;
    if (frame < frames) continue;
    const std::size_t stride = std::max<std::size_t>(1, count / 50000);
    std::size_t asked = 0, found = 0;
    for (std::size_t i = 0; i < count; i += stride, ++asked)
      found += division.ranksWithin(&x[3 * i], 1.1 * diameter) - 1;
    result.ghosts = static_cast<double>(found) / asked;
  }
  return result;
}

}  // namespace

int main(int argc, char **argv)
{
  const std::string wanted = argc > 1 ? argv[1] : "all";
  const std::size_t most = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 8000000;
  std::vector<int> numbers;
  for (int k = 3; k < argc; ++k) numbers.push_back(std::atoi(argv[k]));
  if (numbers.empty()) numbers = {4, 7, 64, 512, 4096, 65536};
  std::printf(
      "| scene | ranks | grains per rank | way | imbalance | moved | ghosts per grain | sums, first call | sums | "
      "numbers summed | ns per grain |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Scene &scene : scenes())
    for (int ranks : numbers) {
      if (wanted != "all" && wanted != scene.name) continue;
      const std::size_t count = std::min(most, perRank * ranks);
      // grains fill about 0.06 of the 0.24 of the box at a packing of 0.6
      const double diameter = std::cbrt(0.6 * 0.06 / static_cast<double>(count) * 6.0 / 3.14159265);
      std::vector<std::vector<double>> film;
      for (int frame = 0; frame <= frames; ++frame)
        film.push_back(positions(scene, count, scene.start + frame * 2.0 * diameter));
      const std::vector<double> &x = film[0];
      std::array<double, 3> filled{};
      for (int a = 0; a < 3; ++a) {
        double lo = box[a], hi = 0.0;
        for (std::size_t i = 0; i < count; ++i) lo = std::min(lo, x[3 * i + a]), hi = std::max(hi, x[3 * i + a]);
        filled[a] = hi - lo;
      }
      const std::pair<const char *, std::unique_ptr<Division>> ways[] = {
          {"shift", std::make_unique<Planes>(ranks)},
          {"rcb", std::make_unique<Bisection>(ranks)},
          {"slice 2", std::make_unique<Slices>(ranks, 2, filled)},
          {"slice 3", std::make_unique<Slices>(ranks, 3, filled)}};
      for (const auto &[name, way] : ways) {
        const Result r = measure(*way, film, ranks, diameter);
        const bool summed = std::string(name) != "rcb";
        std::printf("| %s | %d | %zu | %s | %.4f | %.2f %% | %.3f | %s | %s | %s | %.0f |\n", scene.name.c_str(), ranks,
                    count / ranks, name, r.imbalance, 100.0 * r.moved, r.ghosts,
                    summed ? std::to_string(static_cast<int>(r.first)).c_str() : "-",
                    summed ? std::to_string(r.sums).substr(0, 4).c_str() : "-",
                    summed ? std::to_string(static_cast<long long>(r.numbers)).c_str() : "-", 1e9 * r.time);
        std::fflush(stdout);
      }
    }
  return 0;
}
