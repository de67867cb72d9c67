// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Values of the sub-models: against a long-hand copy of the formulas, and against their limits.

#include "testing/long_hand.h"
#include "testing/random_models.h"
#include "testing/tolerance.h"

#include <map>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

ContactState stateOf(const SeenTwice<double> &p)
{
  ContactState s{};
  for (int d = 0; d < 3; ++d) {
    s.branch[d] = p.seen.branch[d];
    s.relativeVelocity[d] = p.seen.relativeVelocity[d];
    s.surfaceSpin[d] = p.seen.surfaceSpin[d];
    s.spinDifference[d] = p.seen.spinDifference[d];
  }
  s.overlap = p.seen.overlap;
  s.radius = p.radius;
  s.partnerRadius = p.radius2;
  s.inertia = p.seen.inertia;
  s.effectiveRadius = p.seen.effectiveRadius;
  s.effectiveMass = p.seen.effectiveMass;
  return s;
}

/// Numbers of one slot of \p kept.
std::vector<double> slotOf(const HistoryLayout &layout, ModelSlot slot, const std::vector<double> &kept)
{
  const auto first = kept.begin() + layout.at[static_cast<int>(slot)];
  return {first, first + layout.length[static_cast<int>(slot)]};
}

LongHandHistory toLongHand(const HistoryLayout &layout, const std::vector<double> &kept)
{
  LongHandHistory h;
  const std::vector<double> t = slotOf(layout, ModelSlot::Tangential, kept),
                            r = slotOf(layout, ModelSlot::Rolling, kept), w = slotOf(layout, ModelSlot::Twisting, kept);
  for (std::size_t d = 0; d < 3 && !t.empty(); ++d) h.slip[d] = t[d];
  for (std::size_t d = 0; d < 3 && !r.empty(); ++d) h.roll[d] = r[d];
  if (t.size() == 4) h.largestRadius = t[3];
  if (!w.empty()) h.twist = w[0];
  const std::vector<double> n = slotOf(layout, ModelSlot::Normal, kept);
  if (!n.empty()) h.largest = n[0];
  return h;
}

TEST(ContactModel, AgreesWithTheLongHandFormulas)
{
  Dice dice(5);
  std::map<std::string, int> seen;
  for (int k = 0; k < 6000; ++k) {
    const ContactModel model = randomModel(dice);
    for (int s = 0; s < modelSlots; ++s) {
      const auto slot = static_cast<ModelSlot>(s);
      ++seen[slotName(slot) + (" " + model.slot(slot).name)];
    }
    const HistoryLayout layout = historyLayout({model});
    std::vector<double> kept = randomHistory(dice, model, layout);
    LongHandHistory h = toLongHand(layout, kept);
    for (int step = 0; step < 4; ++step) {
      const ContactState s = stateOf(randomContact<double>(dice, model));
      const double dt = step == 1 ? 0.0 : 1e-4;
      const ContactResult r = evaluateContact(model, layout, s, kept.data(), dt);
      const LongHandResult l = longHand(model, s, h, dt);
      const double scale = std::abs(l.push) + l.limit + 1.0;         // of forces and, radii being about 1/2, of torques
      const Tolerance t = roundOff(Precision::Double, scale, 5000);  // of some thousand operations
      SCOPED_TRACE(model.normal.name + " " + model.damping.name + " " + model.tangential.name + " " +
                   model.rolling.name + " " + model.twisting.name + " " + model.cohesion.name);
      ASSERT_TRUE(near(r.push, l.push, t));
      ASSERT_TRUE(near(r.twisting, l.twisting, t));
      for (std::size_t d = 0; d < 3; ++d) {
        ASSERT_TRUE(near(r.force[d], l.force[d], t));
        ASSERT_TRUE(near(r.torque[d], l.torque[d], t));
        ASSERT_TRUE(near(r.friction[d], l.friction[d], t));
        ASSERT_TRUE(near(r.rolling[d], l.rolling[d], t));
      }
      const LongHandHistory now = toLongHand(layout, kept);
      // displacements are forces over the stiffness, here of 10 and more where there is one
      const Tolerance x = {t.relative,
                           norm(l.friction) + norm(h.slip) + norm(h.roll) + std::abs(h.twist) + 0.1 * scale};
      for (std::size_t d = 0; d < 3; ++d) {
        ASSERT_TRUE(near(now.slip[d], h.slip[d], x) || (l.contactRadius == 0.0 && s.overlap > 0.0));
        ASSERT_TRUE(near(now.roll[d], h.roll[d], x));
      }
      ASSERT_TRUE(near(now.twist, h.twist, x));
      ASSERT_TRUE(near(now.largestRadius, h.largestRadius, x));
      ASSERT_TRUE(near(now.largest, h.largest, x));
      h = now;  // differences do not pile up
    }
  }
  int names = 0;
  for (int s = 0; s < modelSlots; ++s) names += static_cast<int>(subModels(static_cast<ModelSlot>(s)).size());
  EXPECT_EQ(static_cast<int>(seen.size()), names) << "every sub-model must have had its turn";
  for (const auto &[name, times] : seen) EXPECT_GT(times, 300) << name;
}

/// \param sliding counts the contacts whose friction was clipped
void expectCoulomb(const std::string &tangential, int &sliding)
{
  SCOPED_TRACE(tangential);
  Dice dice(11);
  for (int k = 0; k < 800; ++k) {
    ContactModel model = randomModel(dice);
    const bool material = contactModuli(model).known;
    if (model.rolling.name == "epsd2") model.rolling = {"none", {}};  // needs a spring
    model.tangential = {tangential, randomParameters(dice, ModelSlot::Tangential, tangential, material)};
    const HistoryLayout layout = historyLayout({model});
    std::vector<double> kept = randomHistory(dice, model, layout);
    ContactState s = stateOf(randomContact<double>(dice, model));
    LongHandHistory h = toLongHand(layout, kept);
    const ContactResult r = evaluateContact(model, layout, s, kept.data(), 1e-4);
    const LongHandResult l = longHand(model, s, h, 0.0);
    if (l.contactRadius == 0.0) continue;  // grains apart, or in the dent they made: a spring has no stiffness there
    const double limit = l.limit;
    const Tolerance t = {1e-9, limit + std::abs(r.push) + 1e-9};
    const Triple friction{r.friction[0], r.friction[1], r.friction[2]};
    ASSERT_LE(norm(friction), limit + t.absolute());
    if (norm(friction) < limit - t.absolute() || tangential == "linear_nohistory") continue;
    ++sliding;
    const std::vector<double> before = kept;
    const ContactResult again = evaluateContact(model, layout, s, kept.data(), 0.0);  // nothing moves on
    for (int d = 0; d < 3; ++d) ASSERT_TRUE(near(again.friction[d], r.friction[d], t));
    for (std::size_t d = 0; d < before.size(); ++d)
      ASSERT_TRUE(near(kept[d], before[d], {1e-9, 1.0 + std::abs(before[d])}));
  }
}

/// Friction never exceeds mu times the base force; when clipped, what is kept carries exactly the clipped force.
TEST(ContactModel, FrictionObeysCoulomb)
{
  for (const SubModelInfo &info : subModels(ModelSlot::Tangential)) {
    if (info.name.find("liggghts") == 0) continue;  // clips the spring, not the sum
    int sliding = 0;
    expectCoulomb(info.name, sliding);
    EXPECT_GE(sliding, info.history > 0 ? 100 : 0) << info.name;
  }
}

/// A spring that sticks out of the contact plane is turned into it at unchanged length.
TEST(ContactModel, SpringsAreTurnedAtUnchangedLength)
{
  Dice dice(4);
  for (const std::string name : {"linear_history", "mindlin", "mindlin/force"}) {
    for (int k = 0; k < 200; ++k) {
      ContactModel m;
      m.normal = {"hertz", {1e6, 0.0}};
      m.tangential = {name, {1.0, 0.0, 1.0}};  // soft: never clipped
      m.rolling = {"sds", {1.0, 0.0, 1.0}};
      const HistoryLayout layout = historyLayout({m});
      std::vector<double> kept;
      for (int d = 0; d < 6; ++d) kept.push_back(dice.between(-1.0, 1.0));
      const Triple slip{kept[0], kept[1], kept[2]}, roll{kept[3], kept[4], kept[5]};
      ContactState s = stateOf(randomContact<double>(dice, m));
      s.overlap = 0.03;
      for (int d = 0; d < 3; ++d) s.relativeVelocity[d] = s.surfaceSpin[d] = s.spinDifference[d] = 0.0;
      const ContactResult r = evaluateContact(m, layout, s, kept.data(), 1e-4);
      const Triple n{r.normal[0], r.normal[1], r.normal[2]};
      for (int at : {0, 3}) {
        const Triple before = at ? roll : slip, after{kept[at], kept[at + 1], kept[at + 2]};
        const Tolerance t = roundOff(Precision::Double, 1.0, 64);
        ASSERT_TRUE(near(norm(after), norm(before), t));
        ASSERT_TRUE(near(inner(after, n), 0.0, t));
        const Triple flat = sum(before, along(n, -inner(before, n)));
        ASSERT_TRUE(near(inner(after, flat), norm(after) * norm(flat), t)) << "the direction in the plane";
      }
    }
  }
}

/// evaluateContact with no time step is a look: it may clip, as LAMMPS' setup does, but nothing moves on.
TEST(ContactModel, NothingMovesOnWithoutATimeStep)
{
  Dice dice(12);
  for (int k = 0; k < 500; ++k) {
    const ContactModel model = randomModel(dice);
    const HistoryLayout layout = historyLayout({model});
    std::vector<double> kept(static_cast<std::size_t>(layout.size), 0.0);
    const ContactState s = stateOf(randomContact<double>(dice, model));
    evaluateContact(model, layout, s, kept.data(), 0.0);
    for (const ModelSlot slot : {ModelSlot::Tangential, ModelSlot::Rolling})
      for (const double number : slotOf(layout, slot, kept)) ASSERT_EQ(number, 0.0);
  }
}

/// Rolling and twisting torques turn the partner the other way: no net torque but that of the friction's arms.
TEST(ContactModel, RollingAndTwistingTorquesAreOpposite)
{
  Dice dice(8);
  for (int k = 0; k < 1000; ++k) {
    const ContactModel model = randomModel(dice);
    const HistoryLayout layout = historyLayout({model});
    std::vector<double> kept = randomHistory(dice, model, layout), mirrored = kept;
    for (std::size_t d = 0; d < kept.size(); ++d) mirrored[d] *= layout.mirror[d];
    const SeenTwice<double> p = randomContact<double>(dice, model);
    SeenTwice<double> q = p;
    std::swap(q.seen, q.mirrored);
    std::swap(q.radius, q.radius2);
    const ContactResult a = evaluateContact(model, layout, stateOf(p), kept.data(), 1e-4);
    const ContactResult b = evaluateContact(model, layout, stateOf(q), mirrored.data(), 1e-4);
    ASSERT_EQ(a.push, b.push);
    ASSERT_EQ(a.twisting, b.twisting);  // along normals that are opposite
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(a.rolling[d], -b.rolling[d]);
      ASSERT_EQ(a.friction[d], -b.friction[d]);
      ASSERT_EQ(a.normal[d], -b.normal[d]);
    }
  }
}

}  // namespace
