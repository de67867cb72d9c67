// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Random clouds of grains of many sizes.
#pragma once

#include "gpudem/scene.h"
#include "base/vec3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace gpudem::testing {

enum class Sizes { Equal, Bimodal, LogNormal, PowerLaw };
enum class Places { Uniform, Clustered, Lattice };

/// Grains that may overlap as they like.
struct Cloud {
  Box box;
  double skin = 0.0;
  std::vector<Vec3<double>> x;
  std::vector<double> radius;
};

inline double sizeOf(Sizes sizes, double ratio, double smallest, std::mt19937_64 &random)
{
  std::uniform_real_distribution<double> u(0.0, 1.0);
  switch (sizes) {
    case Sizes::Equal:
      return smallest;
    case Sizes::Bimodal:
      return u(random) < 0.9 ? smallest : smallest * ratio;
    case Sizes::LogNormal: {
      std::normal_distribution<double> n(0.5 * std::log(ratio), std::log(ratio) / 6.0);
      return smallest * std::clamp(std::exp(n(random)), 1.0, ratio);
    }
    case Sizes::PowerLaw:  // number density r^-3 between the smallest and the largest
      return smallest / std::sqrt(1.0 - u(random) * (1.0 - 1.0 / (ratio * ratio)));
  }
  return smallest;
}

inline Cloud makeCloud(Sizes sizes, Places places, double ratio, std::array<bool, 3> periodic, int dimension,
                       std::size_t count, unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  // clusters of a hundred thousand grains must not make a million pairs each
  std::normal_distribution<double> n(0.0, count < 10000 ? 0.03 : 0.1);
  Cloud c;
  c.skin = 0.3;
  c.box.periodic = periodic;
  c.box.dimension = dimension;
  const double smallest = 0.5;
  c.radius.resize(count);
  double volume = 0.0;
  for (double &r : c.radius) {
    r = sizeOf(sizes, ratio, smallest, random);
    volume += dimension == 2 ? 4.0 * r * r : 8.0 * r * r * r;
  }
  const double least = 2.2 * (2.0 * smallest * ratio + c.skin);  // of a periodic box
  const double edge = std::max(least, dimension == 2 ? std::sqrt(volume) : std::cbrt(volume));
  for (int d = 0; d < 3; ++d) {
    c.box.lo[d] = -0.3 * edge;
    c.box.hi[d] = c.box.lo[d] + edge * (1.0 + 0.37 * d);
  }
  if (dimension == 2) {
    c.box.lo[2] = -0.5;
    c.box.hi[2] = 0.5;
  }
  std::vector<Vec3<double>> centres;
  for (int k = 0; k < 8; ++k) centres.push_back({u(random), u(random), u(random)});
  for (std::size_t i = 0; i < count; ++i) {
    Vec3<double> f{u(random), u(random), u(random)};
    if (places == Places::Clustered) {
      const Vec3<double> &m = centres[random() % centres.size()];
      f = {m.x + n(random), m.y + n(random), m.z + n(random)};
    }
    if (places == Places::Lattice) f = {std::floor(f.x * 16) / 16, std::floor(f.y * 16) / 16, std::floor(f.z * 16) / 16};
    Vec3<double> x;
    for (int d = 0; d < 3; ++d) {
      f[d] = periodic[d] ? f[d] - std::floor(f[d]) : std::clamp(f[d], 0.0, 1.0);
      x[d] = c.box.lo[d] + f[d] * (c.box.hi[d] - c.box.lo[d]);
    }
    if (dimension == 2) x.z = 0.0;
    c.x.push_back(x);
  }
  return c;
}

struct Boundary {
  std::array<bool, 3> periodic;
  int dimension;
};
const Boundary boundaries[] = {{{true, true, true}, 3},  {{false, false, false}, 3}, {{true, false, true}, 3},
                               {{true, true, false}, 3}, {{true, true, true}, 2},    {{false, false, true}, 2}};

}  // namespace gpudem::testing
