// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What holds for every product of sub-models: opposite from the other side, and the same however it is compiled.

#include "testing/random_models.h"

#include <gtest/gtest.h>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

std::string nameOf(const ContactModel &m)
{
  return m.normal.name + " " + m.damping.name + " " + m.tangential.name + " " + m.rolling.name + " " + m.twisting.name +
         " " + m.cohesion.name;
}

template <class Real>
void expectSymmetry(unsigned seed)
{
  Dice dice(seed);
  int turned = 0, slid = 0;
  for (int k = 0; k < 4000; ++k) {
    const ContactModel model = randomModel(dice);
    SCOPED_TRACE(nameOf(model));
    const HistoryLayout layout = historyLayout({model});
    ASSERT_EQ(layout.mirror.size(), static_cast<std::size_t>(layout.size));
    const ModelCoefficients<Real> c = coefficients<Real>(model);
    const std::vector<double> start = randomHistory(dice, model, layout);
    std::vector<Real> kept(start.begin(), start.end()), mirrored = kept;
    for (std::size_t d = 0; d < kept.size(); ++d) mirrored[d] *= static_cast<Real>(layout.mirror[d]);
    for (int step = 0; step < 3; ++step) {  // the first may turn or clip what is kept, the others go on from there
      const SeenTwice<Real> p = randomContact<Real>(dice, model);
      const bool advance = step != 1;
      const auto f = evaluateKept<AnyProduct>(c, layout, p.seen, kept, Real(1e-4), advance);
      const auto g = evaluateKept<AnyProduct>(c, layout, p.mirrored, mirrored, Real(1e-4), advance);
      for (int d = 0; d < 3; ++d) {
        ASSERT_EQ(f.force[d], -g.force[d]);
        ASSERT_EQ(f.couple[d], g.couple[d]);
        ASSERT_EQ(f.moment[d], -g.moment[d]);
        ASSERT_TRUE(std::isfinite(f.force[d]) && std::isfinite(f.moment[d]));
        turned += f.moment[d] != Real(0);
        slid += f.couple[d] != Real(0);
      }
      ASSERT_EQ(f.shorter, g.shorter);
      for (std::size_t d = 0; d < kept.size(); ++d)
        ASSERT_EQ(kept[d], static_cast<Real>(layout.mirror[d]) * mirrored[d]) << d;
    }
  }
  EXPECT_GT(turned, 1000);
  EXPECT_GT(slid, 1000);
}

TEST(ContactModel, IsAntisymmetricToTheLastBit)
{
  expectSymmetry<float>(1);
  expectSymmetry<double>(2);
}

template <class Exact, class Real>
void expectSameBits(const ContactModel &names, Dice &dice)
{
  SCOPED_TRACE(nameOf(names));
  for (int k = 0; k < 100; ++k) {
    ContactModel model;
    do model = randomModel(dice);  // parameters that suit the names
    while (model.normal.name != names.normal.name);
    const bool material = contactModuli(model).known;
    for (int s = 1; s < modelSlots; ++s) {
      const auto slot = static_cast<ModelSlot>(s);
      model.slot(slot) = {names.slot(slot).name, randomParameters(dice, slot, names.slot(slot).name, material)};
    }
    model.normal.parameter[1] = randomDamping(dice, model.damping.name);
    model.slipLever = 0.0;  // which no compiled product takes
    model.coulombBase = CoulombBase::Contact;
    const ModelCoefficients<Real> c = coefficients<Real>(model);
    const HistoryLayout layout = historyLayout({model});
    const std::vector<double> start = randomHistory(dice, model, layout);
    std::vector<Real> kept(start.begin(), start.end()), again = kept;
    const SeenTwice<Real> p = randomContact<Real>(dice, model);
    const auto f = evaluateKept<Exact>(c, layout, p.seen, kept, Real(1e-4), true);
    const auto g = evaluateKept<AnyProduct>(c, layout, p.seen, again, Real(1e-4), true);
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(f.force[d], g.force[d]);
      ASSERT_EQ(f.couple[d], g.couple[d]);
      ASSERT_EQ(f.moment[d], g.moment[d]);
    }
    ASSERT_EQ(f.shorter, g.shorter);
    ASSERT_EQ(kept, again);
    ASSERT_EQ((Exact::gap(c, p.seen.effectiveRadius)), (AnyProduct::gap(c, p.seen.effectiveRadius)));
  }
}

template <class N, class D, class T, class R, class W, class C = NoCohesion>
void expectSameBits(unsigned seed)
{
  ContactModel names;
  names.normal.name = N::name;
  names.damping.name = D::name;
  names.tangential.name = T::name;
  names.rolling.name = R::name;
  names.twisting.name = W::name;
  names.cohesion.name = C::name;
  Dice dice(seed);
  expectSameBits<Product<N, D, T, R, W, C>, float>(names, dice);
  expectSameBits<Product<N, D, T, R, W, C>, double>(names, dice);
}

/// Every sub-model is in one product at least.
TEST(ContactModel, ChosenAtRunTimeGivesTheBitsOfTheCompiledProduct)
{
  expectSameBits<HookeNormal, VelocityDamping, NoTangential, NoRolling, NoTwisting>(1);
  expectSameBits<HookeNormal, MassVelocityDamping, LinearHistoryTangential, SdsRolling, SdsTwisting>(2);
  expectSameBits<HertzNormal, ViscoelasticDamping, ViscousTangential, NoRolling, MarshallTwisting>(3);
  expectSameBits<HertzNormal, TsujiDamping, MindlinForceTangential, SdsRolling, NoTwisting>(4);
  expectSameBits<HertzMaterialNormal, RestitutionDamping, MindlinTangential, SdsRolling, MarshallTwisting>(5);
  expectSameBits<HertzMaterialNormal, TsujiFitDamping, MindlinRescaleForceTangential, SdsRolling, MarshallTwisting>(6);
  expectSameBits<DmtNormal, ViscoelasticDamping, MindlinRescaleTangential, SdsRolling, SdsTwisting>(7);
  expectSameBits<JkrNormal, ViscoelasticDamping, MindlinTangential, SdsRolling, MarshallTwisting>(8);
  expectSameBits<JkrNormal, RestitutionDamping, ViscousTangential, NoRolling, NoTwisting>(9);
  expectSameBits<LudingNormal, RestitutionDamping, LinearHistoryTangential, CdtRolling, SdsTwisting, SjkrCohesion>(10);
  expectSameBits<ThorntonNingNormal, TsujiDamping, LiggghtsHistoryTangential, EpsdRolling, MarshallTwisting,
                 VdwCohesion>(11);
  expectSameBits<EepaNormal, VelocityDamping, LiggghtsLinearHistoryTangential, Epsd2Rolling, NoTwisting, Sjkr2Cohesion>(
      12);
  expectSameBits<EepaLinearNormal, MassVelocityDamping, MindlinTangential, Epsd3Rolling, SdsTwisting,
                 CapillaryCohesion>(13);
}

/// Models of different length share a layout: each keeps its own numbers where the layout says.
TEST(ContactModel, LayoutHoldsTheLongestOfEachSlot)
{
  ContactModel a, b;
  a.normal = {"hooke", {1e4, 0.0}};
  a.tangential = {"mindlin_rescale", {1e3, 0.0, 0.5}};
  b.normal = {"jkr", {1e6, 0.5, 0.3, 1.0}};
  b.tangential = {"linear_history", {1e3, 0.0, 0.5}};
  b.rolling = {"sds", {1.0, 0.0, 0.1}};
  b.twisting = {"marshall", {}};
  const HistoryLayout both = historyLayout({a, b});
  EXPECT_EQ(both.size, 8);
  EXPECT_EQ(both.at[static_cast<int>(ModelSlot::Tangential)], 0);
  EXPECT_EQ(both.at[static_cast<int>(ModelSlot::Rolling)], 4);
  EXPECT_EQ(both.at[static_cast<int>(ModelSlot::Twisting)], 7);
  EXPECT_EQ(both.mirror, (std::vector<signed char>{-1, -1, -1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(historyLayout({b, a}).mirror, both.mirror);
  EXPECT_EQ(historyLayout({a}).size, 4);
  EXPECT_EQ(historyLayout({}).size, 0);
  EXPECT_TRUE(reachesBeyondTouch(b));
  EXPECT_FALSE(reachesBeyondTouch(a));

  // the shorter history in the shared layout gives the bits of its own layout, and leaves the rest alone
  Dice dice(3);
  const HistoryLayout own = historyLayout({b});
  const ModelCoefficients<double> k = coefficients<double>(b);
  const SeenTwice<double> p = randomContact<double>(dice, b);
  std::vector<double> alone(static_cast<std::size_t>(own.size), 0.001), shared(8, 0.001);
  const auto f = evaluateKept<AnyProduct>(k, own, p.seen, alone, 1e-4, true);
  const auto g = evaluateKept<AnyProduct>(k, both, p.seen, shared, 1e-4, true);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(f.force[d], g.force[d]);
    EXPECT_EQ(f.moment[d], g.moment[d]);
    EXPECT_EQ(alone[static_cast<std::size_t>(d)], shared[static_cast<std::size_t>(d)]);
    EXPECT_EQ(alone[static_cast<std::size_t>(3 + d)], shared[static_cast<std::size_t>(4 + d)]);
  }
  EXPECT_EQ(alone[6], shared[7]);
  EXPECT_EQ(shared[3], 0.001);
}

}  // namespace
