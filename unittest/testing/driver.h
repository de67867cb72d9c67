// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Drives an engine as the LAMMPS loop does: batches of steps, rebuilds when asked, events.
#pragma once

#include "gpudem/engine.h"
#include "testing/oracle.h"

#include <functional>

namespace gpudem::testing {

/// Grains and what their contacts keep.
struct Saved {
  Grains grains;
  ContactHistory history;
  std::vector<std::vector<double>> walls;  ///< [walls][n][wallHistorySize]
};

class Driver {
 public:
  Driver(Engine &engine, const SceneSpec &scene, const Box &box, Grains grains);
  /// Go on from a state with forces at \p step.
  Driver(Engine &engine, const SceneSpec &scene, const Box &box, const Saved &saved, std::int64_t step);
  /// Advance to \p step, which becomes an event. \param batch steps queued at a time
  void run(std::int64_t step, int batch = 16, bool virial = false);
  /// State at the last event; positions unwrapped by the image flags.
  Grains read();
  /// All that a continuation needs; positions within the box.
  Saved save();
  /// Values of moving parts at a step.
  std::function<void(StepInputs &)> complete;

 private:
  Engine &engine_;
  SceneSpec scene_;
  Box box_;
  Grains grains_;
  std::int64_t now_ = 0;
};

inline Driver::Driver(Engine &engine, const SceneSpec &scene, const Box &box, Grains grains)
    : engine_(engine), scene_(scene), box_(box), grains_(std::move(grains))
{
  engine_.setScene(scene);
  engine_.upload(grains_.view(), box_, nullptr);
  engine_.rebuild(box_);
  engine_.evaluateForce({}, {});
}

inline Driver::Driver(Engine &engine, const SceneSpec &scene, const Box &box, const Saved &saved, std::int64_t step)
    : engine_(engine), scene_(scene), box_(box), grains_(saved.grains), now_(step)
{
  engine_.setScene(scene);
  engine_.upload(grains_.view(), box_, &saved.history);
  for (std::size_t w = 0; w < saved.walls.size(); ++w)
    engine_.uploadWallHistory(static_cast<int>(w), saved.walls[w].data());
  engine_.rebuild(box_);
}

inline void Driver::run(std::int64_t event, int batch, bool virial)
{
  const auto at = [this](std::int64_t step) {
    StepInputs in;
    in.step = step;
    if (complete) complete(in);
    return in;
  };
  std::int64_t step = now_ + 1;
  engine_.beginStep(at(step));
  bool due = false;
  while (step < event) {
    if (due) engine_.rebuild(box_);
    const int n = static_cast<int>(std::min<std::int64_t>(batch, event - step));
    for (int k = 0; k < n; ++k) engine_.queueStep(at(step + k));
    const Progress p = engine_.flush();
    step += p.executed;
    due = p.needsRebuild;
  }
  due = engine_.flush().needsRebuild || due;
  if (due) engine_.rebuild(box_);
  engine_.completeStep(at(event), {virial});
  now_ = event;
}

inline Grains Driver::read()
{
  engine_.downloadFields(grains_.view(), fieldDynamic);
  Grains out = grains_;
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      const int image = ((out.image[i] >> (10 * d)) & 1023) - 512;
      out.x[3 * i + d] += image * (box_.hi[d] - box_.lo[d]);
    }
  return out;
}

inline Saved Driver::save()
{
  engine_.rebuild(box_);  // wraps the positions
  Saved s;
  engine_.downloadFields(grains_.view(), fieldDynamic);
  s.grains = grains_;
  engine_.downloadHistory(s.history);
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    s.walls.emplace_back(grains_.size() * static_cast<std::size_t>(wallHistorySize(scene_.walls[w])));
    engine_.downloadWallHistory(static_cast<int>(w), s.walls.back().data());
  }
  return s;
}

/// Largest difference of one array.
inline double largestDifference(const std::vector<double> &a, const std::vector<double> &b)
{
  double m = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) m = std::max(m, std::abs(a[k] - b[k]));
  return m;
}
inline double largest(const std::vector<double> &a)
{
  double m = 0.0;
  for (const double x : a) m = std::max(m, std::abs(x));
  return m;
}

}  // namespace gpudem::testing
