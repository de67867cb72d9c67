// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The slow truth: every pair, double precision, springs in a map, plain velocity Verlet.
#pragma once

#include "contact/derive.hpp"
#include "contact/scene_laws.hpp"
#include "contact/spring_dashpot.hpp"
#include "gpudem/engine.h"
#include "step/scene_views.hpp"
#include "wall/analytic_wall.hpp"

#include <map>
#include <random>
#include <vector>

namespace gpudem::testing {

/// Grains in host order with the arrays the engine takes.
struct Grains {
  std::vector<double> x, v, w, f, t, radius, mass;
  std::vector<int> mask, type, tag, image;

  std::size_t size() const { return radius.size(); }
  void add(const Array3 &position, const Array3 &velocity, const Array3 &spin, double r, double m, int bits = 1,
           int kind = 1);
  HostParticles view();
  Array3 at(const std::vector<double> &a, std::size_t i) const { return {a[3 * i], a[3 * i + 1], a[3 * i + 2]}; }
};

/// Random grains in a box, overlapping slightly here and there.
Grains randomCloud(std::size_t count, const Box &box, double smallest, double largest, unsigned seed);

class Oracle {
 public:
  Oracle(const SceneSpec &scene, const Box &box, Grains grains);
  /// Force at the current state (springs advance if asked).
  void evaluate(std::int64_t step, bool advance);
  void step(std::int64_t next);
  Grains grains;
  std::map<std::pair<int, int>, std::vector<double>> kept;  ///< of pairs in contact, as the smaller tag sees it
  std::array<double, 6> virial{};
  std::size_t contacts = 0;

 private:
  void pairForce(std::size_t i, std::size_t j, bool advance);
  void addModelForce(std::size_t i, std::size_t j, const ContactModel &model, const Contact<double> &c, double *numbers,
                     bool advance);
  void addForce(std::size_t i, std::size_t j, const Vec3<double> &branch, const Vec3<double> &force);
  SceneSpec scene_;
  Box box_;
  HistoryLayout layout_;
  std::vector<std::vector<double>> wallKept_;  ///< [n][wallHistorySize]
  std::vector<ModelCoefficients<double>> wallModel_;
};

}  // namespace gpudem::testing
