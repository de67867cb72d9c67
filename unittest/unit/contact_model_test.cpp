// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the door says of contact laws: what is refused and how, mixing, materials.

#include "contact/derive.hpp"
#include "gpudem/contact_model.h"
#include "gpudem/errors.h"
#include "testing/random_models.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

const double null = std::nan("");

ContactModel material(double young = 1e7, double poisson = 0.3)
{
  ContactModel m;
  m.normal = {"hertz/material", {young, 0.5, poisson}};
  m.damping.name = "coeff_restitution";
  m.tangential = {"mindlin", {null, 1.0, 0.5}};
  return m;
}

std::string refusal(const ContactModel &m)
{
  try {
    checkModel(m);
  } catch (const Error &e) {
    return e.what();
  }
  return "";
}

/// Every word must stand in the message.
void expectWords(const std::string &message, const std::vector<std::string> &words)
{
  for (const std::string &word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is missing in '" << message << "'";
}

TEST(CheckModel, AcceptsWhatIsInRange)
{
  EXPECT_EQ(refusal(material()), "");
  for (const double poisson : {-0.999, 0.0, 0.5}) EXPECT_EQ(refusal(material(1e7, poisson)), "");
  ContactModel m = material();
  m.normal.parameter[1] = 1.0;
  EXPECT_EQ(refusal(m), "");
  m.normal.parameter[1] = 1e-3;
  EXPECT_EQ(refusal(m), "");
  Dice dice(1);
  for (int k = 0; k < 500; ++k) EXPECT_EQ(refusal(randomModel(dice)), "");
}

TEST(CheckModel, NamesTheParameterAndItsRange)
{
  const auto withNormal = [](std::size_t p, double value) {
    ContactModel m = material();
    m.normal.parameter[p] = value;
    return refusal(m);
  };
  for (const double young : {0.0, -1e7, null})
    expectWords(withNormal(0, young), {"normal hertz/material E = ", "must be positive"});
  for (const double e : {0.0, -0.1, 1.0001, null})
    expectWords(withNormal(1, e), {"damping coeff_restitution e = ", "must be above 0 and at most 1"});
  for (const double poisson : {-1.0, -2.0, 0.500001, null})
    expectWords(withNormal(2, poisson), {"normal hertz/material nu = ", "must be above -1 and at most 0.5"});
  expectWords(withNormal(0, std::numeric_limits<double>::infinity()), {"normal hertz/material E = inf", "finite"});

  for (const std::string name : {"tsuji", "tsuji/lammps"}) {
    ContactModel m = material();
    m.damping.name = name;
    m.normal.parameter[1] = 1.5;
    expectWords(refusal(m), {"damping " + name + " e = 1.5", "at most 1"});
  }
  for (const std::string name : {"velocity", "mass_velocity", "viscoelastic"}) {
    ContactModel m = material();
    m.damping.name = name;
    m.normal.parameter[1] = -1.0;
    expectWords(refusal(m), {"damping " + name + " eta = -1", "must not be negative"});
    m.normal.parameter[1] = 50.0;
    EXPECT_EQ(refusal(m), "");
  }
  for (const std::string name : {"hooke", "hertz"}) {
    ContactModel m = material();
    m.tangential = {"none", {}};
    m.normal = {name, {-1.0, 0.5}};
    expectWords(refusal(m), {"normal " + name + " kn = -1", "must not be negative"});
    m.normal.parameter[0] = null;
    expectWords(refusal(m), {"normal " + name + " kn = nan"});
  }
  for (const std::string name : {"dmt", "jkr"}) {
    ContactModel m = material();
    m.normal = {name, {1e7, 0.5, 0.3, -1e-3}};
    expectWords(refusal(m), {"normal " + name + " gamma = -0.001", "must not be negative"});
    m.normal.parameter = {-1e7, 0.5, 0.3, 1e-3};
    expectWords(refusal(m), {"normal " + name + " E = -1e+07", "must be positive"});
  }
}

TEST(CheckModel, NamesTheFrictionalParameters)
{
  for (const SubModelInfo &info : subModels(ModelSlot::Tangential)) {
    for (std::size_t p = 0; p < info.parameters.size(); ++p) {
      ContactModel m = material();
      m.tangential = {info.name, std::vector<double>(info.parameters.size(), 0.5)};
      EXPECT_EQ(refusal(m), "");
      m.tangential.parameter[p] = -0.5;
      const std::string label = "tangential " + info.name + " " + info.parameters[p].name;
      expectWords(refusal(m), {label + " = -0.5"});
      m.tangential.parameter[p] = null;
      const bool derives = (info.name.find("mindlin") == 0 && p == 0) || (info.name == "liggghts_history" && p < 2);
      EXPECT_EQ(info.parameters[p].derivable, derives);
      if (derives) EXPECT_EQ(refusal(m), "");
      else expectWords(refusal(m), {label + " = nan"});
    }
  }
  ContactModel m = material();
  m.tangential.parameter[2] = 20000.0;
  expectWords(refusal(m), {"tangential mindlin mu = 20000", "between 0 and 10000"});
  m = material();
  m.rolling = {"sds", {1.0, 0.0, -0.1}};
  expectWords(refusal(m), {"rolling sds mu = -0.1", "between 0 and 10000"});
  m = material();
  m.twisting = {"sds", {-1.0, 0.0, 0.1}};
  expectWords(refusal(m), {"twisting sds k = -1", "must not be negative"});
}

TEST(CheckModel, NamesWrongCountsAndNames)
{
  ContactModel m = material();
  m.normal.parameter.pop_back();
  expectWords(refusal(m), {"normal hertz/material takes 3 parameters, not 2"});
  m = material();
  m.twisting = {"marshall", {1.0}};
  expectWords(refusal(m), {"twisting marshall takes 0 parameters, not 1"});
  for (int s = 0; s < modelSlots; ++s) {
    const auto slot = static_cast<ModelSlot>(s);
    m = material();
    m.slot(slot).name = "rubber";
    std::vector<std::string> words{"there is no " + std::string(slotName(slot)) + " sub-model 'rubber'"};
    for (const SubModelInfo &info : subModels(slot)) words.push_back(info.name);
    expectWords(refusal(m), words);
  }
}

TEST(CheckModel, LimitDampingWouldRemoveAdhesion)
{
  for (const std::string name : {"dmt", "jkr"}) {
    ContactModel m = material();
    m.normal = {name, {1e7, 0.5, 0.3, 1e-3}};
    EXPECT_EQ(refusal(m), "");
    m.limitDamping = true;
    expectWords(refusal(m), {"limit_damping", "adhesion of normal " + name});
  }
  ContactModel m = material();
  m.limitDamping = true;
  EXPECT_EQ(refusal(m), "");
}

TEST(CheckModel, NullNeedsAMaterial)
{
  ContactModel m = material();
  m.normal = {"hertz", {1e7, 0.5}};
  try {
    deriveCoefficients(m);
    FAIL() << "NULL without a material was accepted";
  } catch (const Error &e) {
    expectWords(e.what(), {"NULL", "material (E, nu)"});
  }
}

/// (1 - nu^2)/E summed over both grains, and (2 - nu)/G; the rest is geometric.
TEST(MixModels, MeansAreTheDocumentedOnes)
{
  ContactModel a = material(1e7, 0.3), b = material(4e7, 0.2);
  a.normal.parameter[1] = 0.4;
  b.normal.parameter[1] = 0.9;
  a.tangential.parameter = {null, 0.5, 0.2};
  b.tangential.parameter = {null, 2.0, 0.8};
  a.rolling = {"sds", {10.0, 1.0, 0.1}};
  b.rolling = {"sds", {40.0, 4.0, 0.4}};
  a.twisting = b.twisting = {"sds", {2.0, 3.0, 0.05}};
  b.limitDamping = true;
  const ContactModel m = mixModels(a, b);
  const double young = 1.0 / ((1 - 0.09) / 1e7 + (1 - 0.04) / 4e7);
  const double shear = 1.0 / ((2 - 0.3) * 2 * 1.3 / 1e7 + (2 - 0.2) * 2 * 1.2 / 4e7);
  const ContactModuli moduli = contactModuli(m);
  const auto expectNear = [](double x, double y) {
    EXPECT_TRUE(near(x, y, roundOff(Precision::Double, std::abs(y), 64)));
  };
  expectNear(moduli.young, young);
  expectNear(moduli.shear, shear);
  expectNear(m.normal.parameter[1], 0.6);
  EXPECT_TRUE(std::isnan(m.tangential.parameter[0])) << "NULL stays NULL";
  expectNear(m.tangential.parameter[1], 1.0);
  expectNear(m.tangential.parameter[2], 0.4);
  expectNear(m.rolling.parameter[0], 20.0);
  expectNear(m.rolling.parameter[1], 2.0);
  expectNear(m.rolling.parameter[2], 0.2);
  expectNear(m.twisting.parameter[1], 3.0);
  EXPECT_TRUE(m.limitDamping);
  EXPECT_EQ(deriveCoefficients(m).tangential[0], 8.0 * moduli.shear);
  expectNear(deriveCoefficients(m).normal[0], 4.0 / 3.0 * young);

  // the order of the two makes no difference
  const ContactModel other = mixModels(b, a);
  for (std::size_t p = 0; p < 3; ++p) EXPECT_EQ(m.normal.parameter[p], other.normal.parameter[p]);

  // one NULL beside a number: the mean of what both stand for
  b.tangential.parameter[0] = 3e6;
  const double shearA = 1e7 / (4 * (2 - 0.3) * 1.3);
  expectNear(mixModels(a, b).tangential.parameter[0], std::sqrt(8.0 * shearA * 3e6));
  expectNear(mixModels(b, a).tangential.parameter[0], std::sqrt(8.0 * shearA * 3e6));
}

TEST(MixModels, GeometricMeansWithoutAMaterial)
{
  ContactModel a, b;
  a.normal = {"hooke", {1e4, 20.0}};
  b.normal = {"hooke", {4e4, 5.0}};
  a.tangential = {"linear_history", {100.0, 0.5, 0.3}};
  b.tangential = {"linear_history", {0.0, 0.5, 0.3}};
  const ContactModel m = mixModels(a, b);
  EXPECT_EQ(m.normal.parameter, (std::vector<double>{2e4, 10.0}));
  EXPECT_EQ(m.tangential.parameter[0], 0.0);
  const Tolerance t = roundOff(Precision::Double, 1.0);
  EXPECT_TRUE(near(m.tangential.parameter[2], 0.3, t));
}

TEST(MixModels, DifferentSubModelsAreRefusedByName)
{
  const std::vector<std::pair<ModelSlot, SubModel>> others{
      {ModelSlot::Normal, {"jkr", {1e7, 0.5, 0.3, 1e-3}}},
      {ModelSlot::Damping, {"velocity", {}}},
      {ModelSlot::Tangential, {"mindlin_rescale", {null, 1.0, 0.5}}},
      {ModelSlot::Rolling, {"sds", {1.0, 0.0, 0.1}}},
      {ModelSlot::Twisting, {"marshall", {}}}};
  for (const auto &[slot, other] : others) {
    const ContactModel a = material();
    ContactModel b = a;
    b.slot(slot) = other;
    try {
      mixModels(a, b);
      FAIL() << slotName(slot);
    } catch (const Error &e) {
      expectWords(e.what(), {slotName(slot), a.slot(slot).name, other.name, "cannot be mixed"});
    }
  }
}

/// A law mixed with itself is the law, at the ends of the range of nu as well, and passes its own check.
TEST(MixModels, WithItselfIsItself)
{
  for (const double young : {1e5, 1e7, 3.3e9, 1e11})
    for (const double poisson : {-0.9999999, -0.5, 0.0, 0.1, 0.3, 0.45, 0.4999999, 0.5}) {
      const ContactModel a = material(young, poisson), m = mixModels(a, a);
      EXPECT_EQ(refusal(m), "") << young << " " << poisson;
      const ContactModuli x = contactModuli(a), y = contactModuli(m);
      EXPECT_TRUE(near(y.young, x.young, roundOff(Precision::Double, x.young, 64))) << poisson;
      EXPECT_TRUE(near(y.shear, x.shear, roundOff(Precision::Double, x.shear, 64))) << poisson;
    }
  // all pairs: never out of range
  for (double p = -1.0 + 1e-9; p <= 0.5; p += 0.0999)
    for (double q = 0.5; q > -1.0; q -= 0.0999)
      EXPECT_EQ(refusal(mixModels(material(1e7, p), material(3e9, q))), "") << p << " " << q;
}

TEST(Material, EquivalentMaterialHasTheModuli)
{
  for (const double young : {1e5, 3.3e7, 1e11})
    for (const double poisson : {-0.9999999999, -0.9999999, -0.999, -0.5, 0.0, 0.3, 0.499, 0.4999999999, 0.5}) {
      const ContactModuli m = contactModuli(material(young, poisson));
      EXPECT_TRUE(m.known);
      const double shear = young / (2.0 * (1.0 + poisson));
      const double one = std::fma(-poisson, poisson, 1.0);  // 1 - nu^2, rounded once
      EXPECT_TRUE(near(m.young, young / (2.0 * one), roundOff(Precision::Double, m.young)));
      EXPECT_TRUE(near(m.shear, shear / (2.0 * (2.0 - poisson)), roundOff(Precision::Double, m.shear)));
      double e, nu;
      equivalentMaterial(m, e, nu);
      SCOPED_TRACE(poisson);
      // nu is a difference of numbers of size 1; E is proportional to 1 + nu
      EXPECT_TRUE(near(nu, poisson, roundOff(Precision::Double, 1.0, 64)));
      EXPECT_TRUE(near(e, young, roundOff(Precision::Double, young / (1.0 + poisson), 64)));
      EXPECT_GT(nu, -1.0);
      EXPECT_LE(nu, 0.5);
      const ContactModuli back = contactModuli(material(e, nu));
      EXPECT_TRUE(near(back.young, m.young, roundOff(Precision::Double, m.young, 64)));
      EXPECT_TRUE(near(back.shear, m.shear, roundOff(Precision::Double, m.shear, 64)));
    }
  ContactModel plain;
  plain.normal = {"hertz", {1e7, 0.0}};
  EXPECT_FALSE(contactModuli(plain).known);
}

}  // namespace
