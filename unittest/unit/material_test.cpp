// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Contact laws made of materials: moduli, dashpots and springs against the formulas written out, collisions.
#include "gpudem/material.h"

#include "gpudem/errors.h"
#include "testing/tolerance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gpudem {
namespace {

using testing::near;
using testing::roundOff;

const Material glass{48e9, 0.2, 2800.0}, steel{208e9, 0.3, 7850.0}, rubber{1e6, 0.49, 1100.0};
const Material rigid{1e30, 0.3, 0.0};

MaterialPair pairOf(double e, double mu)
{
  MaterialPair p;
  p.restitution = e;
  p.friction = mu;
  return p;
}

double shearModulus(const Material &m)
{
  return m.young / (2.0 * (1.0 + m.poisson));
}

::testing::AssertionResult same(double a, double b)
{
  return near(a, b, roundOff(Precision::Double, std::abs(b)));
}

/// What \p call throws.
template <class Call>
std::string messageOf(Call &&call)
{
  try {
    call();
  } catch (const Error &e) {
    return e.what();
  }
  return "no error";
}

TEST(Material, ModuliAreThoseOfBothMaterials)
{
  for (const Material &a : {glass, steel, rubber})
    for (const Material &b : {glass, steel, rubber, rigid}) {
      const double young = 1.0 / ((1.0 - a.poisson * a.poisson) / a.young + (1.0 - b.poisson * b.poisson) / b.young);
      const double shear = 1.0 / ((2.0 - a.poisson) / shearModulus(a) + (2.0 - b.poisson) / shearModulus(b));
      const ContactModuli m = contactModuli(a, b), mirrored = contactModuli(b, a);
      EXPECT_TRUE(same(m.young, young));
      EXPECT_TRUE(same(m.shear, shear));
      EXPECT_EQ(m.young, mirrored.young);
      EXPECT_EQ(m.shear, mirrored.shear);
      // and so are those of the law, which names one material that has them in contact with itself
      const ContactModuli law = contactModuli(materialModel(a, b, pairOf(0.9, 0.3), {}));
      EXPECT_TRUE(same(law.young, young));
      EXPECT_TRUE(same(law.shear, shear));
    }
}

TEST(Material, LikeGrainsKeepTheirNumbers)
{
  const ContactModel m = materialModel(steel, steel, pairOf(0.6, 0.5), {});
  EXPECT_EQ(m.normal.name, "hertz/material");
  EXPECT_EQ(m.normal.parameter, (std::vector<double>{208e9, 0.6, 0.3}));
  EXPECT_EQ(m.damping.name, "coeff_restitution");
  EXPECT_EQ(m.tangential.name, "mindlin");
  EXPECT_TRUE(std::isnan(m.tangential.parameter[0]));
  EXPECT_EQ(m.tangential.parameter[2], 0.5);
  EXPECT_EQ(m.rolling.name, "none");
  EXPECT_EQ(m.twisting.name, "none");
}

TEST(Material, MixesAsTheModelsOfTheMaterialsDo)
{
  const ContactModel a = materialModel(glass, glass, pairOf(0.9, 0.3), {});
  const ContactModel b = materialModel(steel, steel, pairOf(0.9, 0.3), {});
  const ContactModuli mixed = contactModuli(mixModels(a, b)),
                      made = contactModuli(materialModel(glass, steel, pairOf(0.9, 0.3), {}));
  EXPECT_TRUE(same(made.young, mixed.young));
  EXPECT_TRUE(same(made.shear, mixed.shear));
}

/// Chung and Ooi, Granul. Matter 13 (2011) 643, tests 1 and 2: largest force and overlap of elastic impacts.
TEST(Material, LargestForceOfChungAndOoi)
{
  const double pi = std::acos(-1.0);
  const auto largest = [](const Material &a, const Material &b, double effective, double mass, double speed) {
    const double young = contactModuli(materialModel(a, b, pairOf(1.0, 0.35), {})).young;
    const double overlap = std::pow(15.0 * mass * speed * speed / (16.0 * std::sqrt(effective) * young), 0.4);
    return std::make_pair(4.0 / 3.0 * young * std::sqrt(effective) * std::pow(overlap, 1.5), overlap);
  };
  const double glassMass = 4.0 / 3.0 * pi * 1e-6 * 2800.0;
  const auto [force, overlap] = largest(glass, glass, 0.005, 0.5 * glassMass, 20.0);
  EXPECT_TRUE(near(force, 10697.0, {1e-4, 10697.0})) << "five digits are published";
  EXPECT_TRUE(near(overlap, 274.11e-6, {1e-4, 274.11e-6}));
  const Material aluminium{70e9, 0.3, 2699.0};
  const double mass = 4.0 / 3.0 * pi * 1e-3 * 2699.0;
  const auto [wallForce, wallOverlap] = largest(aluminium, rigid, 0.1, mass, 0.2);
  EXPECT_TRUE(near(wallForce, 11370.0, {1e-4, 11370.0})) << "a rigid material makes a rigid plane";
  EXPECT_TRUE(near(wallOverlap, 49.717e-6, {1e-4, 49.717e-6}));
}

TEST(Material, DashpotsHaveTheSamePartOfCriticalDamping)
{
  for (const Material &m : {glass, steel, rubber}) {
    const ContactModel law = materialModel(m, m, pairOf(0.5, 0.3), {});
    EXPECT_TRUE(same(law.tangential.parameter[1], std::sqrt(2.0 * (1.0 - m.poisson) / (2.0 - m.poisson))));
  }
  const ContactModuli moduli = contactModuli(glass, steel);
  const ContactModel law = materialModel(glass, steel, pairOf(0.5, 0.3), {});
  EXPECT_TRUE(same(law.tangential.parameter[1], std::sqrt(8.0 * moduli.shear / (2.0 * moduli.young))));
  MaterialLaw own;
  own.tangentialDamping = 0.0;
  EXPECT_EQ(materialModel(glass, steel, pairOf(0.5, 0.3), own).tangential.parameter[1], 0.0);
}

/// A head-on impact, integrated: the restitution asked for comes out, and for unlike materials too.
TEST(Material, RestitutionInIsRestitutionOut)
{
  const double radius = 0.01, mass = 0.01, speed = 1.0;
  for (const Material *b : {&glass, &steel, &rubber, &rigid})
    for (const double e : {1.0, 0.9, 0.5, 0.2}) {
      const ContactModel law = materialModel(glass, *b, pairOf(e, 0.3), {});
      const HistoryLayout layout = historyLayout({law});
      std::vector<double> kept(static_cast<std::size_t>(layout.size), 0.0);
      const double young = contactModuli(law).young, effective = 0.5 * radius;
      const double overlap = std::pow(15.0 * mass * speed * speed / (16.0 * std::sqrt(effective) * young), 0.4);
      const double dt = overlap / speed / 2e4;
      double x = 0.0, v = -speed;  // x: gap; velocity Verlet with the velocity of the half step in the dashpot
      for (int step = 0; step < 2000000 && (step == 0 || x < 0.0); ++step) {
        x += dt * v;
        ContactState s{};
        s.branch[0] = 2.0 * radius + x;
        s.overlap = -x;
        s.radius = radius;
        s.effectiveRadius = effective;
        s.effectiveMass = mass;
        s.relativeVelocity[0] = v;
        if (x < 0.0) v += dt * evaluateContact(law, layout, s, kept.data(), dt).push / mass;
      }
      // the error of the scheme falls with the step, which is 1/20000 of the way to the largest overlap
      EXPECT_TRUE(near(v / speed, e, {2e-4, 1.0})) << "restitution " << e << ", E = " << b->young;
    }
}

TEST(Material, SurfaceEnergyChoosesAdhesion)
{
  MaterialPair pair = pairOf(0.9, 0.3);
  pair.surfaceEnergy = 0.05;
  EXPECT_EQ(materialModel(glass, steel, pair, {}).normal.name, "jkr");
  EXPECT_EQ(materialModel(glass, steel, pair, {}).normal.parameter[3], 0.05);
  MaterialLaw law;
  law.normal = "dmt";
  EXPECT_EQ(materialModel(glass, steel, pair, law).normal.name, "dmt");
  EXPECT_EQ(materialModel(glass, steel, pairOf(0.9, 0.3), law).normal.parameter[3], 0.0);
  law.normal = "hertz/material";
  EXPECT_NE(messageOf([&] { materialModel(glass, steel, pair, law); }).find("no adhesion"), std::string::npos);
}

/// Springs of rolling and twisting at the reference contact, written out for two grains and for a grain at a wall.
TEST(Material, RollingAndTwistingAtTheReferenceContact)
{
  const double pi = std::acos(-1.0);
  MaterialPair pair = pairOf(0.4, 0.3);
  pair.rolling = 0.02;
  pair.twisting = 1e-5;
  MaterialLaw law;
  law.radius = 2e-3;
  law.speed = 0.5;
  const double beta = -std::log(0.4) / std::hypot(pi, std::log(0.4));
  for (const Partner partner : {Partner::Grain, Partner::Wall}) {
    const bool wall = partner == Partner::Wall;
    const double volume = 4.0 / 3.0 * pi * std::pow(law.radius, 3), ma = 2800.0 * volume, mb = 7850.0 * volume;
    const double mass = wall ? ma : 1.0 / (1.0 / ma + 1.0 / mb), effective = wall ? law.radius : 0.5 * law.radius;
    const ContactModuli m = contactModuli(glass, steel);
    const double overlap = std::pow(15.0 * mass * 0.25 / (16.0 * std::sqrt(effective) * m.young), 0.4);
    const double a = std::sqrt(effective * overlap), k = 8.0 * m.shear * a;
    EXPECT_TRUE(same(referenceContactRadius(glass, steel, law, partner), a));
    const ContactModel made = materialModel(glass, steel, pair, law, partner);
    const double ia = 1.4 * ma * law.radius * law.radius, ib = 1.4 * mb * law.radius * law.radius;
    const double rolling = (wall ? ia : 1.0 / (1.0 / ia + 1.0 / ib)) / (effective * effective);
    EXPECT_TRUE(same(made.rolling.parameter[0], k));
    EXPECT_TRUE(same(made.rolling.parameter[1], 2.0 * beta * std::sqrt(k * rolling)));
    EXPECT_EQ(made.rolling.parameter[2], 0.02);
    const double turning = k * a * a / 2.0, spin = 0.4 * mass * law.radius * law.radius;
    EXPECT_TRUE(same(made.twisting.parameter[0], turning));
    EXPECT_TRUE(same(made.twisting.parameter[1], 2.0 * beta * std::sqrt(turning * spin)));
    EXPECT_EQ(made.twisting.parameter[2], 1e-5);
  }
  law.rolling = "epsd2";
  EXPECT_EQ(materialModel(glass, steel, pair, law).rolling.parameter, std::vector<double>{0.02});
  law.rolling = "epsd";
  EXPECT_EQ(materialModel(glass, steel, pair, law).rolling.parameter[0], 0.02);
  EXPECT_TRUE(same(materialModel(glass, steel, pair, law).rolling.parameter[1], beta));
  law.rolling = law.twisting = "none";
  EXPECT_EQ(materialModel(glass, steel, pair, law).rolling.name, "none");
  EXPECT_EQ(materialModel(glass, steel, pair, law).twisting.name, "none");
  law.twisting = "marshall";
  EXPECT_NE(messageOf([&] { materialModel(glass, steel, pair, law); }).find("marshall"), std::string::npos);
  pair.twisting = 0.0;
  EXPECT_EQ(materialModel(glass, steel, pair, law).twisting.name, "marshall");
}

TEST(Material, EveryNumberHasARange)
{
  const auto message = [](const Material &a, const MaterialPair &p, const MaterialLaw &law) {
    return messageOf([&] { materialModel(a, steel, p, law); });
  };
  const MaterialPair good = pairOf(0.9, 0.3);
  const auto expect = [](const std::string &text, const std::string &phrase) {
    EXPECT_NE(text.find(phrase), std::string::npos) << text;
  };
  expect(message({-1.0, 0.3, 1.0}, good, {}), "young = -1 must be positive");
  expect(message({0.0, 0.3, 1.0}, good, {}), "young = 0 must be positive");
  expect(message({1e9, 0.7, 1.0}, good, {}), "poisson = 0.7 must be above -1 and at most 0.5");
  expect(message({1e9, 0.3, -1.0}, good, {}), "density = -1 must be positive");
  expect(message({1e9, std::nan(""), 1.0}, good, {}), "poisson = nan");
  expect(message(glass, pairOf(0.0, 0.3), {}), "restitution = 0 must be above 0 and at most 1");
  expect(message(glass, pairOf(1.1, 0.3), {}), "restitution = 1.1 must be above 0 and at most 1");
  expect(message(glass, pairOf(0.9, -0.3), {}), "friction = -0.3 must lie between 0 and 10000");
  MaterialPair rolls = good;
  rolls.rolling = 0.1;
  expect(message(glass, rolls, {}), "radius R speed V");
  MaterialLaw law;
  law.radius = 1e-3;
  law.speed = -1.0;
  expect(message(glass, rolls, law), "speed = -1 must be positive");
  law.speed = 1.0;
  expect(message({1e9, 0.3, 0.0}, rolls, law), "density");
  law.tangential = "linear_history";
  expect(message(glass, good, law), "no tangential 'linear_history'; it takes mindlin, mindlin_rescale");
  law = {};
  law.tangentialDamping = -1.0;
  expect(message(glass, good, law), "tangential_damping = -1 must not be negative");
  law = {};
  law.normal = "hooke";
  expect(message(glass, good, law), "no normal 'hooke'; it takes hertz/material, dmt, jkr");
}

}  // namespace
}  // namespace gpudem
