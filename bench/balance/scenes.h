// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Grains that move as in four scenes of the field, without any physics: positions are formulae of grain and
/// time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench {

constexpr std::array<double, 3> box = {1.0, 0.4, 0.6};  // distance
constexpr double twoPi = 6.283185307179586;

using Point = std::array<double, 3>;

/// Three numbers from 0 to 1 that belong to grain i, the same in every program (splitmix64).
inline Point grain(std::uint64_t i)
{
  Point u;
  for (int k = 0; k < 3; ++k) {
    std::uint64_t z = (3 * i + k + 1) * 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    u[k] = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  return u;
}

/// A box half full that is shaken sideways: grains gather at one end, then at the other.
inline Point agitation(const Point &u, double t)
{
  const double x = u[0] + 0.12 * std::sin(0.5 * twoPi * u[0]) * std::sin(twoPi * t);
  return {box[0] * x, box[1] * u[1], 0.5 * box[2] * u[2] * (1.0 + 0.8 * (0.5 - u[0]) * std::sin(twoPi * t))};
}

/// A column at one side that becomes a long heap.
inline Point collapse(const Point &u, double t)
{
  const double wide = 0.9 * box[0], high = 0.22 * box[2], along = 1.0 - std::sqrt(1.0 - u[0]);
  const double s = t * t * (3.0 - 2.0 * t);
  const Point column = {0.11 * box[0] * u[0], box[1] * u[1], 0.9 * box[2] * u[2]};
  const Point heap = {wide * along, box[1] * u[1], high * (1.0 - along) * u[2]};
  return {column[0] + s * (heap[0] - column[0]), column[1], column[2] + s * (heap[2] - column[2])};
}

/// A silo that empties through a hole onto a heap: of the grains, the share t has fallen.
inline Point hopper(const Point &u, double t)
{
  const double angle = twoPi * u[1], fall = 0.02;
  const auto at = [&](double radius, double z) {
    return Point{box[0] * 0.5 + radius * std::cos(angle), box[1] * 0.5 + radius * std::sin(angle), z};
  };
  if (u[0] > t + fall) {  // still inside: a cylinder over a cone, the level sinks
    const double level = (u[0] - t) / (1.0 - t);
    const double radius = std::min(0.19, 0.02 + 1.2 * 0.3 * level);
    return at(radius * std::sqrt(u[2]), box[2] * (0.45 + 0.5 * level * (1.0 - t)));
  }
  if (u[0] > t) return at(0.02 * std::sqrt(u[2]), box[2] * (0.1 + 0.35 * (u[0] - t) / fall));  // the jet
  const double size = std::cbrt(t), radius = 0.19 * size * std::sqrt(u[2]);
  return at(radius, 0.25 * box[2] * size * (1.0 - radius / (0.19 * size + 1e-9)) * (u[0] / t));
}

/// A stream through a periodic box, in waves ten times as dense as what lies between them.
inline Point stream(const Point &u, double t)
{
  const double wave = u[0] + 0.145 * std::sin(twoPi * 3.0 * u[0]) / 3.0;
  const double x = wave + 0.5 * t, dense = 1.0 - 0.6 * std::cos(twoPi * 3.0 * u[0]);
  return {box[0] * (x - std::floor(x)), box[1] * u[1], 0.3 * box[2] * u[2] * dense};
}

struct Scene {
  std::string name;
  std::function<Point(const Point &, double)> at;
  double start;  // time of the first frame
};
inline std::vector<Scene> scenes()
{
  return {
      {"agitation", agitation, 0.05}, {"collapse", collapse, 0.35}, {"hopper", hopper, 0.4}, {"stream", stream, 0.1}};
}

/// Positions of all grains, [3 count], distance.
inline std::vector<double> positions(const Scene &scene, std::size_t count, double time)
{
  std::vector<double> x(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Point p = scene.at(grain(i), time);
    for (int a = 0; a < 3; ++a) x[3 * i + a] = std::clamp(p[a], 0.0, std::nextafter(box[a], 0.0));
  }
  return x;
}

}  // namespace bench
