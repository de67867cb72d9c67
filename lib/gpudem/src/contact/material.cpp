// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "contact/material.hpp"

#include "contact/parameters.hpp"
#include "gpudem/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gpudem {

namespace {

constexpr double pi = 3.14159265358979323846;

double sphereMass(double radius, double density)
{
  return 4.0 / 3.0 * pi * radius * radius * radius * density;
}

/// Part of critical damping that gives restitution \p e.
double criticalPart(double e)
{
  const double logarithm = std::log(e);
  return -logarithm / std::sqrt(pi * pi + logarithm * logarithm);
}

template <class Of>
void checkNumbers(const char *label, const Of &of, const std::vector<NumberOf<Of>> &numbers)
{
  for (const NumberOf<Of> &n : numbers)
    if (n.needed || of.*n.value != 0.0) checkValue(label, n.info, of.*n.value);
}

void oneOf(const char *what, const std::string &name, const std::vector<std::string> &names)
{
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(
        fmt::format("a law made of materials takes no {} '{}'; it takes {}", what, name, fmt::join(names, ", ")));
}

}  // namespace

const std::vector<std::string> &materialNames(ModelSlot slot)
{
  static const std::vector<std::string> names[modelSlots]{
      {"hertz/material", "dmt", "jkr"},
      {"coeff_restitution"},
      {"mindlin", "mindlin_rescale", "mindlin/force", "mindlin_rescale/force"},
      {"sds", "epsd2", "epsd", "cdt", "none"},
      {"sds", "marshall", "none"},
      {"none"}};
  return names[static_cast<std::size_t>(slot)];
}

const std::vector<NumberOf<Material>> &materialNumbers()
{
  static const std::vector<NumberOf<Material>> numbers{
      {positive("young", "pressure"), &Material::young, true},
      {{"poisson", "-", poissonParameter().low, poissonParameter().high, false}, &Material::poisson, true},
      {positive("density", "mass/volume"), &Material::density, false}};
  return numbers;
}

const std::vector<NumberOf<MaterialPair>> &pairNumbers()
{
  static const std::vector<NumberOf<MaterialPair>> numbers{
      {{"restitution", "-", aboveZero, 1.0, false}, &MaterialPair::restitution, true},
      {frictionParameter("friction"), &MaterialPair::friction, true},
      {frictionParameter("rolling"), &MaterialPair::rolling, false},
      {notNegative("twisting", "distance"), &MaterialPair::twisting, false},
      {notNegative("surface_energy", "energy/distance^2"), &MaterialPair::surfaceEnergy, false}};
  return numbers;
}

const std::vector<NumberOf<MaterialLaw>> &lawNumbers()
{
  static const std::vector<NumberOf<MaterialLaw>> numbers{
      {positive("radius", "distance"), &MaterialLaw::radius, false},
      {positive("speed", "distance/time"), &MaterialLaw::speed, false},
      {{"tangential_damping", "-", 0.0, unbounded, true}, &MaterialLaw::tangentialDamping, false}};
  return numbers;
}

ContactModuli contactModuli(const Material &a, const Material &b)
{
  const auto softness = [](const Material &m) { return (1.0 - m.poisson) * (1.0 + m.poisson) / m.young; };
  const auto slipSoftness = [](const Material &m) { return 2.0 * (2.0 - m.poisson) * (1.0 + m.poisson) / m.young; };
  return {1.0 / (softness(a) + softness(b)), 1.0 / (slipSoftness(a) + slipSoftness(b)), true};
}

double tangentialDampingRatio(const ContactModuli &moduli)
{
  return 2.0 * std::sqrt(moduli.shear / moduli.young);
}

ReferenceContact referenceContact(const Material &a, const Material &b, const MaterialLaw &law, Partner partner)
{
  if (!(law.radius > 0.0) || !(law.speed > 0.0))
    throw Error(
        "rolling sds and twisting sds need the radius and the speed of the impact at which their springs are taken: "
        "law "
        "radius R speed V, or let the law take rolling epsd2 and twisting marshall");
  const bool wall = partner == Partner::Wall;
  if (!(a.density > 0.0) || (!wall && !(b.density > 0.0)))
    throw Error("rolling and twisting need the density of the grains");
  ReferenceContact c;
  const double ma = sphereMass(law.radius, a.density), mb = sphereMass(law.radius, b.density);
  c.effectiveRadius = wall ? law.radius : 0.5 * law.radius;
  c.effectiveMass = wall ? ma : ma * mb / (ma + mb);
  const ContactModuli moduli = contactModuli(a, b);
  const double overlap = std::pow(
      15.0 * c.effectiveMass * law.speed * law.speed / (16.0 * std::sqrt(c.effectiveRadius) * moduli.young), 0.4);
  c.contactRadius = std::sqrt(c.effectiveRadius * overlap);
  c.slipStiffness = 8.0 * moduli.shear * c.contactRadius;
  return c;
}

double referenceContactRadius(const Material &a, const Material &b, const MaterialLaw &law, Partner partner)
{
  return referenceContact(a, b, law, partner).contactRadius;
}

std::vector<double> rollingParameters(const ReferenceContact &contact, const MaterialPair &pair, Partner partner)
{
  const double lever = partner == Partner::Wall ? 1.0 : 2.0;  // R/R*
  const double inertia = 1.4 * contact.effectiveMass * lever * lever;
  return {contact.slipStiffness, 2.0 * criticalPart(pair.restitution) * std::sqrt(contact.slipStiffness * inertia),
          pair.rolling};
}

std::vector<double> twistingParameters(const ReferenceContact &contact, const MaterialPair &pair, double radius)
{
  const double k = 0.5 * contact.slipStiffness * contact.contactRadius * contact.contactRadius;
  const double inertia = 0.4 * contact.effectiveMass * radius * radius;
  return {k, 2.0 * criticalPart(pair.restitution) * std::sqrt(k * inertia), pair.twisting};
}

ContactModel materialModel(const Material &a, const Material &b, const MaterialPair &pair, const MaterialLaw &law,
                           Partner partner)
{
  checkNumbers("material", a, materialNumbers());
  checkNumbers("material", b, materialNumbers());
  checkNumbers("pair", pair, pairNumbers());
  checkNumbers("law", law, lawNumbers());
  if (!law.normal.empty()) oneOf("normal", law.normal, materialNames(ModelSlot::Normal));
  oneOf("tangential", law.tangential, materialNames(ModelSlot::Tangential));
  oneOf("rolling", law.rolling, materialNames(ModelSlot::Rolling));
  oneOf("twisting", law.twisting, materialNames(ModelSlot::Twisting));
  const bool adhesive = pair.surfaceEnergy > 0.0;
  ContactModel m;
  m.normal.name = !law.normal.empty() ? law.normal : adhesive ? "jkr" : "hertz/material";
  const std::size_t taken = subModel(ModelSlot::Normal, m.normal.name).parameters.size();
  if (adhesive && taken < 4)
    throw Error(fmt::format("the pair has a surface_energy, but {} has no adhesion: let the law take jkr or dmt",
                            m.normal.name));
  if (pair.twisting > 0.0 && law.twisting == "marshall")
    throw Error("the pair has a twisting number, but the law's twisting marshall takes none");
  const ContactModuli moduli = contactModuli(a, b);
  double young = a.young, poisson = a.poisson;  // of one material to the last digit
  if (a.young != b.young || a.poisson != b.poisson) equivalentMaterial(moduli, young, poisson);
  m.normal.parameter = {young, pair.restitution, poisson};
  if (taken > 3) m.normal.parameter.push_back(pair.surfaceEnergy);
  m.damping.name = "coeff_restitution";
  m.tangential = {
      law.tangential,
      {std::numeric_limits<double>::quiet_NaN(),
       std::isnan(law.tangentialDamping) ? tangentialDampingRatio(moduli) : law.tangentialDamping, pair.friction}};
  if (pair.rolling > 0.0 && law.rolling != "none") {
    m.rolling = {law.rolling, {pair.rolling}};
    if (law.rolling == "sds")
      m.rolling.parameter = rollingParameters(referenceContact(a, b, law, partner), pair, partner);
    if (law.rolling == "epsd") m.rolling.parameter.push_back(criticalPart(pair.restitution));
  }
  if (law.twisting == "marshall") m.twisting.name = "marshall";
  else if (pair.twisting > 0.0 && law.twisting == "sds")
    m.twisting = {"sds", twistingParameters(referenceContact(a, b, law, partner), pair, law.radius)};
  m.limitDamping = law.limitDamping;
  checkModel(m);
  return m;
}

}  // namespace gpudem
