// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Contacts that outlive touch: held as long as the law says, whatever is rebuilt or copied meanwhile, and never
/// made without touch.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/model_scenes.h"
#include "testing/tolerance.h"

#include <set>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

class Adhesion : public OnBackend {
 protected:
  /// Distances this close to the end of a contact may go either way: rounded coordinates and rounded gap (distance)
  double undecided() const { return roundOff(GetParam().precision, 1.0, 32).absolute(); }
};

/// Grains so heavy that they fly straight on.
constexpr double heavy = 1e6;

SceneSpec emptyScene(const ContactModel &model)
{
  SceneSpec s;
  s.pairModels = {model};
  s.timestep = 2e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.1;
  s.largestRadius = 0.5;
  s.integrators.emplace_back();
  return s;
}

ContactModel withoutHistory(ContactModel m)
{
  m.tangential = {"linear_nohistory", {0.5, 0.4}};
  m.rolling = {"none", {}};
  m.twisting = {"none", {}};
  return m;
}

/// Short enough to break within a few steps.
ContactModel shortBridges()
{
  ContactModel m = wetModel();
  m.cohesion.parameter[2] = 2.7e-8;
  return m;
}
ContactModel shortAttraction()
{
  ContactModel m = dustModel();
  m.cohesion.parameter = {1e-4, 1e-3, 3.8e-3};
  return m;
}

/// 800 pairs that separate; every other one never touched. Several chunks of the CPU, pairs across chunks among them.
Grains separatingPairs(const Box &box, const ContactModel &model)
{
  Grains g;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 800; ++k) {
    const double a = 1.3 + 0.2 * u(random), b = 3.0 * u(random), r = 0.4 + 0.1 * u(random), q = 0.4 + 0.1 * u(random);
    const double gap = pullOffGap(model, r * q / (r + q));
    const double d = r + q + (k % 2 ? 0.5 * gap : -1e-3), speed = 1.0 + 0.5 * u(random);
    const Array3 n{std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), std::sin(a)};
    const Array3 at{box.lo[0] + 1.0 + 2.4 * (k % 20), box.lo[1] + 1.0 + 2.4 * (k / 20 % 10),
                    box.lo[2] + 0.01 + 3.0 * (k / 200)};
    const double drift = 12.0 * u(random);  // both move through the box: rebuilds while they are in contact
    g.add(at, {drift, 0, 0}, {0, 0, 0}, r, heavy);
    g.add({at[0] + d * n[0], at[1] + d * n[1], at[2] + d * n[2]}, {drift + speed * n[0], speed * n[1], speed * n[2]},
          {0, 0, 0}, q, heavy);
  }
  return g;
}

TEST_P(Adhesion, NecksLiveToThePullOffGapThroughRebuilds)
{
  Box box;
  box.lo = {-24.0, -12.0, 0.0};
  box.hi = {24.0, 12.0, 12.0};
  box.periodic = {true, true, true};
  for (const ContactModel &model : {stickyMaterial(100.0), withoutHistory(stickyMaterial(100.0)), shortBridges(),
                                    withoutHistory(shortBridges()), shortAttraction()}) {
    SCOPED_TRACE(model.normal.name + " " + model.tangential.name + " " + model.cohesion.name);
    SceneSpec scene = emptyScene(model);
    scene.skin = 0.02;  // used up every few steps
    const Grains start = separatingPairs(box, model);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    int beyond = 0, broken = 0;
    for (int event = 1; event <= 30; ++event) {
      driver.run(event, 1);
      if (event % 7 == 0) engine->rebuild(box);  // right after the force, too
      const Grains g = driver.read();
      ContactHistory h;
      engine->downloadHistory(h);
      for (std::size_t i = 0; i < g.size(); i += 2) {
        double d2 = 0.0;
        for (int k = 0; k < 3; ++k) d2 += std::pow(g.x[3 * i + k] - g.x[3 * i + 3 + k], 2);
        const double reach = g.radius[i] + g.radius[i + 1], apart = std::sqrt(d2) - reach;
        const double gap = pullOffGap(model, g.radius[i] * g.radius[i + 1] / reach);
        if (std::abs(apart - gap) < undecided() || std::abs(apart) < undecided()) continue;
        const bool touched = i / 2 % 2 == 0 || actsBeforeTouch(model), held = touched && apart < gap;
        ASSERT_EQ(h.offset[i + 1] - h.offset[i], held ? 1u : 0u)
            << "step " << event << " pair " << i << " gap " << apart;
        ASSERT_EQ(h.offset[i + 2] - h.offset[i + 1], held ? 1u : 0u);
        ASSERT_EQ(g.f[3 * i + 2] != 0.0, held) << "step " << event << " pair " << i << " gap " << apart;
        ASSERT_EQ((g.x[3 * i + 2] - g.x[3 * i + 5]) * -g.f[3 * i + 2] > 0.0, held) << "a neck pulls";
        beyond += held && apart > 0.0;
        broken += touched && !held;
      }
    }
    EXPECT_GT(beyond, 2000);
    EXPECT_GT(broken, 1000);
    EXPECT_GT(engine->neighbors().rebuilds, 5);  // a GPU widens a skin that is used up so fast
  }
}

/// A neck copied to another engine is still one.
TEST_P(Adhesion, NecksCrossEngines)
{
  Box box;
  box.lo = {-24.0, -12.0, 0.0};
  box.hi = {24.0, 12.0, 12.0};
  box.periodic = {true, true, true};
  const ContactModel model = withoutHistory(stickyMaterial(100.0));  // no numbers: the contacts alone are copied
  const SceneSpec scene = emptyScene(model);
  const std::unique_ptr<Engine> engine = make(), second = make(1);
  Driver driver(*engine, scene, box, separatingPairs(box, model));
  driver.run(12, 1);
  const Saved saved = driver.save();
  EXPECT_EQ(saved.history.size, 0);
  EXPECT_GT(saved.history.partner.size(), 700u);
  Driver other(*second, scene, box, saved, 12);
  driver.run(16, 2);
  other.run(16, 1);
  const Saved a = driver.save(), b = other.save();
  EXPECT_EQ(a.history.partner, b.history.partner);
  EXPECT_GT(a.history.partner.size(), 100u);
  EXPECT_LE(largestDifference(a.grains.f, b.grains.f),
            alongThePath(GetParam().precision, largest(a.grains.f), 1.0, 1000.0).absolute());
}

/// Grains leave a wall: flags and forces end at the gap of the effective radius, which a cylinder changes.
TEST_P(Adhesion, WallsHoldToThePullOffGap)
{
  const ContactModel model = asWall(stickyMaterial(100.0));
  const double radius = 1.5;
  const char *names[] = {"plane", "inside a cylinder", "outside a cylinder"};
  for (const int shape : {0, 1, 2}) {
    SCOPED_TRACE(names[shape]);
    Box box;
    box.lo = {-20.0, -20.0, 0.0};
    box.hi = {20.0, 20.0, 20.0};
    SceneSpec scene = emptyScene(model);
    WallSpec wall;
    wall.model = model;
    if (shape == 0) {
      wall.axis = 2;
      wall.lo = 0.0;
    } else {
      wall.shape = WallShape::Cylinder;
      wall.radius = radius;
    }
    addModelWall(scene, wall);
    Grains g;
    std::vector<Array3> away;
    for (int k = 0; k < 6; ++k) {  // on the cylinder one above the other
      const double r = 0.3 + 0.03 * k, speed = 0.5 + 0.1 * k, at = k % 2 ? 1e-3 : -1e-3;  // odd ones never touched
      const double c = std::cos(1.0 * k), s = std::sin(1.0 * k);
      if (shape == 0) {
        g.add({2.0 * k, 0.0, r + at}, {0, 0, speed}, {0, 0, 0}, r, heavy);
        away.push_back({0, 0, 1});
      } else {
        const double out = shape == 1 ? -1.0 : 1.0, rho = radius + out * (r + at);
        g.add({rho * c, rho * s, 1.0 + 2.0 * k}, {out * speed * c, out * speed * s, 0}, {0, 0, 0}, r, heavy);
        away.push_back({out * c, out * s, 0});
      }
    }
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, g);
    const int size = wallHistorySize(wall);
    EXPECT_EQ(size, 8) << "the flag before seven numbers";
    int beyond = 0, broken = 0;
    for (int event = 1; event <= 120; ++event) {
      driver.run(event, 1);
      if (event % 3 == 0) engine->rebuild(box);
      const Grains now = driver.read();
      std::vector<double> kept(g.size() * static_cast<std::size_t>(size));
      engine->downloadWallHistory(0, kept.data());
      for (std::size_t i = 0; i < g.size(); ++i) {
        const double r = g.radius[i], c = shape == 0 ? 0.0 : shape == 1 ? -2.0 * radius : 2.0 * radius;
        const double effective = shape == 0 ? r : r * c / (r + c), gap = pullOffGap(model, effective);
        const double rho = std::hypot(now.x[3 * i], now.x[3 * i + 1]);
        const double apart = (shape == 0 ? now.x[3 * i + 2] : std::abs(radius - rho)) - r;
        if (std::abs(apart - gap) < undecided() || std::abs(apart) < undecided()) continue;
        const bool touched = i % 2 == 0, held = touched && apart < gap;
        const Array3 f = now.at(now.f, i);
        const double pull = -(f[0] * away[i][0] + f[1] * away[i][1] + f[2] * away[i][2]);
        ASSERT_EQ(kept[static_cast<std::size_t>(size) * i], held ? 1.0 : 0.0)
            << "step " << event << " gap " << apart / gap;
        ASSERT_EQ(pull > 0.0, held) << "step " << event << " gap " << apart / gap;
        beyond += held && apart > 0.0;
        broken += touched && !held;
      }
    }
    EXPECT_GT(beyond, 20);
    EXPECT_GT(broken, 100);
  }
}

GPUDEM_ON_ALL_BACKENDS(Adhesion);

}  // namespace
