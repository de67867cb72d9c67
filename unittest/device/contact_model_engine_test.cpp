// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Products of sub-models in the resident step: against the oracle, and bit against bit.

#include "testing/backends.h"
#include "testing/driver.h"
#include "testing/model_scenes.h"
#include "testing/tolerance.h"

#include <map>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

class ModelEngine : public OnBackend {
 protected:
  Precision precision() const { return GetParam().precision; }
};

using Kept = std::map<std::pair<int, int>, std::vector<double>>;

/// What every contact keeps, as either grain sees it.
Kept keptBy(Engine &engine, const Grains &g)
{
  ContactHistory h;
  engine.downloadHistory(h);
  const auto size = static_cast<std::ptrdiff_t>(h.size);
  Kept kept;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::uint32_t m = h.offset[i]; m < h.offset[i + 1]; ++m)
      kept[{g.tag[i], h.partner[m]}] = {h.spring.begin() + size * m, h.spring.begin() + size * (m + 1)};
  return kept;
}

/// The contacts and, in double precision, their numbers are those of the oracle.
void expectKept(const Kept &kept, const Oracle &oracle, Precision precision, double hundredSteps)
{
  if (precision == Precision::Mixed) {  // a grain that just touches may do so a step earlier or later
    EXPECT_LE(std::abs(static_cast<double>(kept.size()) - 2.0 * static_cast<double>(oracle.kept.size())), 4.0);
    return;
  }
  EXPECT_EQ(kept.size(), 2 * oracle.kept.size());
  double magnitude = 0.0;
  for (const auto &[key, numbers] : oracle.kept) magnitude = std::max(magnitude, largest(numbers));
  for (const auto &[key, numbers] : oracle.kept) {
    const auto found = kept.find(key);
    ASSERT_NE(found, kept.end()) << key.first << " " << key.second;
    ASSERT_EQ(found->second.size(), numbers.size());
    EXPECT_LE(largestDifference(found->second, numbers),
              alongThePath(precision, magnitude, hundredSteps, 1e3).absolute());
  }
}

TEST_P(ModelEngine, FollowsTheOracleThroughRebuilds)
{
  for (const ModelScene &m : modelScenes()) {
    SCOPED_TRACE(m.name);
    const Box box = boxOf(m);
    const SceneSpec scene = specOf(m, box);
    const Grains start = grainsIn(m, box, 220, 42);
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    std::size_t contactSteps = 0;
    for (int event = 1; event <= 2; ++event) {
      for (int k = 1; k <= 100; ++k) {
        oracle.step((event - 1) * 100 + k);
        contactSteps += oracle.contacts;
      }
      driver.run(event * 100, 7, true);
      const Grains g = driver.read();
      const auto tolerance = [&](const std::vector<double> &a, double operations) {
        return alongThePath(precision(), largest(a), event, operations).absolute();
      };
      EXPECT_LE(largestDifference(g.x, oracle.grains.x), tolerance(g.x, 1.0)) << event;
      EXPECT_LE(largestDifference(g.v, oracle.grains.v), tolerance(g.v, 20.0)) << event;
      EXPECT_LE(largestDifference(g.w, oracle.grains.w), tolerance(g.w, 50.0)) << event;
      expectKept(keptBy(*engine, start), oracle, precision(), event);
      if (!fine()) continue;
      EXPECT_LE(largestDifference(g.f, oracle.grains.f), tolerance(g.f, 500.0)) << event;
      EXPECT_LE(largestDifference(g.t, oracle.grains.t), tolerance(g.t, 500.0)) << event;
      for (int k = 0; k < 6; ++k)
        EXPECT_TRUE(
            near(engine->observables().virial[k], oracle.virial[k], alongThePath(precision(), 1e3, event, 100.0)));
    }
    EXPECT_GT(contactSteps, 1000u) << "the case must have contacts to mean anything";
    EXPECT_GT(engine->neighbors().rebuilds, 1) << "the case must rebuild to mean anything";
  }
}

/// Several chunks of the CPU, long histories, two types with different sub-models.
TEST_P(ModelEngine, SetupForceAgreesWithTheOracle)
{
  Box box;
  box.hi = {9.0, 10.0, 9.5};
  box.periodic = {true, true, true};
  Grains start = randomCloud(1400, box, 0.1, 0.5, 3);
  for (std::size_t i = 0; i < start.size(); i += 5) start.mask[i] |= 4;
  for (const ModelScene &m : modelScenes()) {
    SCOPED_TRACE(m.name);
    SceneSpec scene = specOf(m, box);
    scene.walls.clear();
    scene.terms.clear();
    scene.frozenMask = 4;
    scene.exclusions.groups.emplace_back(4, 4);
    Oracle oracle(scene, box, start);
    oracle.evaluate(0, false);
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    const Grains g = driver.read();
    const double operations = fine() ? 5e3 : 500.0;  // overlaps are small differences of positions
    EXPECT_GT(oracle.contacts, 10u);
    EXPECT_LE(largestDifference(g.f, oracle.grains.f), roundOff(precision(), largest(g.f), operations).absolute());
    EXPECT_LE(largestDifference(g.t, oracle.grains.t), roundOff(precision(), largest(g.t), operations).absolute());
  }
}

/// Newton's third law to the last bit, pairs within a chunk and across chunks; rolling and twisting turn both ways.
TEST_P(ModelEngine, PairsAreOppositeToTheLastBit)
{
  Box box;
  box.hi = {48.0, 24.0, 12.0};
  box.periodic = {true, true, true};
  for (const ModelScene &m : modelScenes()) {
    SCOPED_TRACE(m.name);
    SceneSpec scene = specOf(m, box);
    for (ContactModel &model : scene.pairModels) model.lever = 0.5;
    scene.walls.clear();
    scene.terms.clear();
    Grains start;
    std::mt19937 random(13);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int k = 0; k < 800; ++k) {  // 1600 grains in pairs
      const Array3 at{1.0 + 2.4 * (k % 20), 1.0 + 2.4 * (k / 20 % 10), 0.01 + 3.0 * (k / 200)};
      const double a = 1.3 + 0.2 * u(random), b = 3.0 * u(random), d = 0.94;
      start.add(at, {u(random), u(random), u(random)}, {u(random), u(random), u(random)}, 0.5, 1.0, 1, 1 + k % 2);
      start.add({at[0] + d * std::cos(a) * std::cos(b), at[1] + d * std::cos(a) * std::sin(b), at[2] + d * std::sin(a)},
                {u(random), u(random), u(random)}, {u(random), u(random), u(random)}, 0.5, 0.7, 1, 1 + k / 2 % 2);
    }
    const std::unique_ptr<Engine> engine = make();
    Driver driver(*engine, scene, box, start);
    const std::vector<signed char> mirror = pairHistoryLayout(scene).mirror;
    for (const int step : {1, 12}) {
      driver.run(step);
      const Grains g = driver.read();
      int touching = 0;
      for (std::size_t i = 0; i < g.size(); i += 2)
        for (int d = 0; d < 3; ++d) {
          ASSERT_EQ(g.f[3 * i + d], -g.f[3 * i + 3 + d]);
          touching += g.f[3 * i + d] != 0.0;
        }
      EXPECT_GT(touching, 1500);
      const Kept kept = keptBy(*engine, start);
      EXPECT_TRUE(!keepsContacts(scene) || kept.size() > 1000u) << kept.size();
      for (const auto &[key, numbers] : kept) {
        const auto other = kept.find({key.second, key.first});
        ASSERT_NE(other, kept.end());
        for (std::size_t d = 0; d < numbers.size(); ++d) ASSERT_EQ(numbers[d], mirror[d] * other->second[d]) << d;
      }
    }
  }
}

TEST_P(ModelEngine, TwoRunsAreBitwiseEqualWhateverTheThreadsAndBatches)
{
  ModelScene m = modelScenes()[2];  // all kinds of sub-models
  Box box;
  box.lo = {-5.5, -5.5, -5.5};
  box.hi = {5.5, 5.5, 5.5};
  box.periodic = m.periodic;
  const Grains start = grainsIn(m, box, 1600, 4);
  const SceneSpec scene = specOf(m, box);
  std::vector<Saved> results;
  for (const auto &[threads, batch] : {std::pair{1, 5}, std::pair{2, 64}, std::pair{3, 1}}) {
    const std::unique_ptr<Engine> engine = make(threads);
    Driver driver(*engine, scene, box, start);
    driver.run(150, batch);
    results.push_back(driver.save());
  }
  EXPECT_GT(results[0].history.partner.size(), 200u);
  for (const Saved &s : results) {
    EXPECT_EQ(s.grains.x, results[0].grains.x);
    EXPECT_EQ(s.grains.v, results[0].grains.v);
    EXPECT_EQ(s.grains.w, results[0].grains.w);
    EXPECT_EQ(s.grains.f, results[0].grains.f);
    EXPECT_EQ(s.grains.t, results[0].grains.t);
    EXPECT_EQ(s.history.spring, results[0].history.spring);
    EXPECT_EQ(s.walls, results[0].walls);
  }
}

/// A rebuild carries all numbers exactly; a second engine goes on from what the first one gave, as the first does.
TEST_P(ModelEngine, HistoryCrossesRebuildsAndEnginesExactly)
{
  for (const ModelScene &m : modelScenes()) {
    SCOPED_TRACE(m.name);
    const Box box = boxOf(m);
    const SceneSpec scene = specOf(m, box);
    const Grains start = grainsIn(m, box, 220, 7);
    const std::unique_ptr<Engine> engine = make(1), second = make(2);
    Driver first(*engine, scene, box, start);
    first.run(100);
    const Kept before = keptBy(*engine, start);
    const Saved saved = first.save();
    EXPECT_EQ(saved.history.size, pairHistoryLayout(scene).size);
    EXPECT_TRUE(!keepsContacts(scene) || before.size() > 4u) << before.size();
    EXPECT_EQ(keptBy(*engine, start), before);
    engine->rebuild(box);
    EXPECT_EQ(keptBy(*engine, start), before);

    Driver other(*second, scene, box, saved, 100);
    EXPECT_EQ(keptBy(*second, start), before);
    const Saved arrived = other.save();
    EXPECT_EQ(arrived.history.spring.size(), saved.history.spring.size());
    EXPECT_EQ(arrived.walls, saved.walls);
    other.run(150);
    const Saved here = other.save();
    Driver again(*engine, scene, box, saved, 100);  // the first engine, from the same copy
    again.run(150, 3);
    const Saved there = again.save();
    EXPECT_EQ(here.grains.x, there.grains.x);
    EXPECT_EQ(here.grains.v, there.grains.v);
    EXPECT_EQ(here.grains.w, there.grains.w);
    EXPECT_EQ(here.history.spring, there.history.spring);
    EXPECT_EQ(here.history.partner, there.history.partner);
    EXPECT_EQ(here.walls, there.walls);

    // undisturbed, the sums of a grain may have another order; springs are at least some 10^-3 of a grain or differ by
    // what positions differ
    const std::unique_ptr<Engine> third = make();
    Driver whole(*third, scene, box, start);
    whole.run(100);
    whole.run(150);
    const Saved one = whole.save();
    const auto tolerance = [&](double magnitude) {
      return alongThePath(precision(), magnitude, 1.5, 100.0).absolute();
    };
    EXPECT_LE(largestDifference(one.grains.v, here.grains.v), tolerance(largest(here.grains.v)));
    for (std::size_t w = 0; w < here.walls.size(); ++w)
      EXPECT_LE(largestDifference(one.walls[w], here.walls[w]), tolerance(largest(here.walls[w]) + 1e-3));
  }
}

TEST_P(ModelEngine, WrongHistoryAndTablesAreRefused)
{
  const ModelScene m = modelScenes()[0];
  const Box box = boxOf(m);
  SceneSpec scene = specOf(m, box);
  const Grains start = grainsIn(m, box, 40, 7);
  const std::unique_ptr<Engine> engine = make();
  Driver driver(*engine, scene, box, start);
  Saved saved = driver.save();
  saved.history.size = 3;
  const auto message = [&](const SceneSpec &s) -> std::string {
    try {
      Driver again(*engine, s, box, saved, 0);
    } catch (const Error &e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message(scene).find("3 numbers each; the contact laws keep 7"), std::string::npos);
  scene.pairModels.pop_back();
  EXPECT_NE(message(scene).find("3 contact laws were given for 2 types"), std::string::npos);
}

GPUDEM_ON_ALL_BACKENDS(ModelEngine);

}  // namespace
