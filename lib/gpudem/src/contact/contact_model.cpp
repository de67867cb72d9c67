// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "contact/derive.hpp"
#include "contact/layout.hpp"
#include "contact/product.hpp"
#include "gpudem/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gpudem {

namespace {

template <class Member>
SubModelInfo describe(Member)
{
  return {Member::name, Member::parameters(), Member::history};
}

template <class List>
std::vector<SubModelInfo> describeAll(List list)
{
  std::vector<SubModelInfo> all;
  forEachModel(list, [&](auto member) { all.push_back(describe(member)); });
  return all;
}

/// Call visit(member) for the member of that name.
template <class List, class Visit>
void withModel(List list, const std::string &name, Visit &&visit)
{
  forEachModel(list, [&](auto member) {
    if (name == decltype(member)::name) visit(member);
  });
}

/// "between 0 and 1", "positive", ...
std::string rangeText(const ParameterInfo &p)
{
  const bool bounded = p.high < unbounded;
  if (!bounded) return p.low > 0.0 ? "must be positive" : p.low == 0.0 ? "must not be negative" : "must be finite";
  if (p.low == aboveZero) return fmt::format("must be above 0 and at most {:g}", p.high);
  if (p.low == std::nextafter(-1.0, 0.0)) return fmt::format("must be above -1 and at most {:g}", p.high);
  return fmt::format("must lie between {:g} and {:g}", p.low, p.high);
}

ParameterInfo dampingOf(const ContactModel &model)
{
  return subModel(ModelSlot::Damping, model.damping.name).parameters[0];
}

double geometric(double a, double b)
{
  return std::sqrt(a * b);
}

}  // namespace

const char *slotName(ModelSlot slot)
{
  static constexpr std::array<const char *, modelSlots> names{"normal",  "damping",  "tangential",
                                                              "rolling", "twisting", "cohesion"};
  return names[static_cast<std::size_t>(slot)];
}

const std::vector<SubModelInfo> &subModels(ModelSlot slot)
{
  static const std::array<std::vector<SubModelInfo>, modelSlots> all{
      describeAll(NormalModels{}),  describeAll(DampingModels{}),  describeAll(TangentialModels{}),
      describeAll(RollingModels{}), describeAll(TwistingModels{}), describeAll(CohesionModels{})};
  return all[static_cast<std::size_t>(slot)];
}

int modelIndex(ModelSlot slot, const std::string &name)
{
  const std::vector<SubModelInfo> &all = subModels(slot);
  for (std::size_t m = 0; m < all.size(); ++m)
    if (all[m].name == name) return static_cast<int>(m);
  std::vector<std::string> known;
  for (const SubModelInfo &info : all) known.push_back(info.name);
  throw Error(fmt::format("there is no {} sub-model '{}'; known are {}", slotName(slot), name, fmt::join(known, ", ")));
}

const SubModelInfo &subModel(ModelSlot slot, const std::string &name)
{
  return subModels(slot)[static_cast<std::size_t>(modelIndex(slot, name))];
}

const SubModel &ContactModel::slot(ModelSlot s) const
{
  switch (s) {
    case ModelSlot::Normal:
      return normal;
    case ModelSlot::Damping:
      return damping;
    case ModelSlot::Tangential:
      return tangential;
    case ModelSlot::Rolling:
      return rolling;
    case ModelSlot::Twisting:
      return twisting;
    case ModelSlot::Cohesion:
      break;
  }
  return cohesion;
}

void checkValue(const std::string &label, const ParameterInfo &info, double value)
{
  if (info.derivable && std::isnan(value)) return;
  if (!std::isfinite(value) || value < info.low || value > info.high)
    throw Error(fmt::format("{} {} = {:g} {}", label, info.name, value,
                            std::isinf(value) ? "must be finite" : rangeText(info)));
}

void checkModel(const ContactModel &model)
{
  for (int slot = 0; slot < modelSlots; ++slot) {
    const auto s = static_cast<ModelSlot>(slot);
    const SubModel &given = model.slot(s);
    const SubModelInfo &info = subModel(s, given.name);
    const std::string label = fmt::format("{} {}", slotName(s), given.name);
    if (s == ModelSlot::Damping) continue;  // its parameter stands with the normal sub-model
    if (given.parameter.size() != info.parameters.size())
      throw Error(fmt::format("{} takes {} parameters, not {}", label, info.parameters.size(), given.parameter.size()));
    for (std::size_t p = 0; p < info.parameters.size(); ++p) {
      if (s == ModelSlot::Normal && p == 1)
        checkValue("damping " + model.damping.name, dampingOf(model), given.parameter[p]);
      else checkValue(label, info.parameters[p], given.parameter[p]);
    }
  }
  bool adhesive = false, necks = false, bridges = false;
  withModel(NormalModels{}, model.normal.name, [&](auto m) {
    adhesive = decltype(m)::adhesive;
    necks = decltype(m)::beyondTouch;
  });
  withModel(CohesionModels{}, model.cohesion.name, [&](auto m) { bridges = decltype(m)::beyondTouch; });
  if (model.limitDamping && adhesive)
    throw Error(fmt::format("limit_damping would remove the adhesion of normal {}", model.normal.name));
  if (necks && bridges)
    throw Error(fmt::format("normal {} and cohesion {} both act beyond touch; give one of them", model.normal.name,
                            model.cohesion.name));
  if (model.coulombBase == CoulombBase::Net && model.cohesion.name == "none")
    throw Error("the Coulomb limit is to count from the net normal force, but there is no cohesion sub-model");
}

ContactModuli contactModuli(const ContactModel &model)
{
  ContactModuli moduli;
  withModel(NormalModels{}, model.normal.name,
            [&](auto m) { moduli = decltype(m)::moduli(model.normal.parameter.data()); });
  return moduli;
}

void equivalentMaterial(const ContactModuli &m, double &young, double &poisson)
{
  const double q = m.shear / m.young;  // (1 - nu)/(2 (2 - nu))
  // round-off must not carry nu out of its range
  poisson = std::clamp((1.0 - 4.0 * q) / (1.0 - 2.0 * q), poissonParameter().low, poissonParameter().high);
  young = m.young * 2.0 * (1.0 - poisson) * (1.0 + poisson);
}

ModelCoefficients<double> deriveCoefficients(const ContactModel &model)
{
  checkModel(model);
  ModelCoefficients<double> k{};
  ModelContext context;
  context.moduli = contactModuli(model);
  withModel(NormalModels{}, model.normal.name, [&](auto m) {
    decltype(m)::derive(model.normal.parameter.data(), k.normal);
    context.linear = decltype(m)::linear;
    k.necks = decltype(m)::beyondTouch;
  });
  withModel(DampingModels{}, model.damping.name,
            [&](auto m) { k.damping = decltype(m)::derive(model.normal.parameter[1], context); });
  withModel(TangentialModels{}, model.tangential.name, [&](auto m) {
    context.friction = decltype(m)::friction(model.tangential.parameter.data());
    context.spring = decltype(m)::history > 0;
    decltype(m)::derive(model.tangential.parameter.data(), context, k.tangential);
  });
  withModel(RollingModels{}, model.rolling.name, [&](auto m) {
    decltype(m)::derive(model.rolling.parameter.data(), context, k.rolling);
    k.readsInertia = decltype(m)::takesInertia;
  });
  withModel(TwistingModels{}, model.twisting.name,
            [&](auto m) { decltype(m)::derive(model.twisting.parameter.data(), context, k.twisting); });
  withModel(CohesionModels{}, model.cohesion.name, [&](auto m) {
    decltype(m)::derive(model.cohesion.parameter.data(), k.cohesion);
    k.beforeTouch = decltype(m)::beforeTouch;
  });
  k.lever = model.lever;
  k.slipLever = model.slipLever;
  k.limitDamping = model.limitDamping;
  k.netBase = model.coulombBase == CoulombBase::Net;
  for (int s = 0; s < modelSlots; ++s) {
    const auto slot = static_cast<ModelSlot>(s);
    k.model[s] = modelIndex(slot, model.slot(slot).name);
  }
  return k;
}

/// What the parameter \p p of the tangential sub-model is or, if NULL, stands for.
static double tangentialParameter(const ContactModel &model, std::size_t p, const ContactModuli &moduli)
{
  double value = model.tangential.parameter[p];
  if (!std::isnan(value)) return value;
  withModel(TangentialModels{}, model.tangential.name, [&](auto m) { value = decltype(m)::derived(p, moduli); });
  return value;
}

ContactModel mixModels(const ContactModel &a, const ContactModel &b)
{
  ContactModel mixed = a;
  for (int s = 0; s < modelSlots; ++s) {
    const auto slot = static_cast<ModelSlot>(s);
    const SubModel &of = a.slot(slot), &other = b.slot(slot);
    if (of.name != other.name)
      throw Error(fmt::format("the {} sub-models {} and {} differ, so their coefficients cannot be mixed",
                              slotName(slot), of.name, other.name));
    for (std::size_t p = 0; p < of.parameter.size(); ++p)
      mixed.slot(slot).parameter[p] = geometric(of.parameter[p], other.parameter[p]);
  }
  if (a.coulombBase != b.coulombBase || a.slipLever != b.slipLever)
    throw Error("the conventions of Coulomb limit or slip velocity differ, so the coefficients cannot be mixed");
  mixed.limitDamping = a.limitDamping || b.limitDamping;
  const ContactModuli ma = contactModuli(a), mb = contactModuli(b);
  if (ma.known) {
    const auto harmonic = [](double x, double y) { return 2.0 / (1.0 / x + 1.0 / y); };
    const ContactModuli m{harmonic(ma.young, mb.young), harmonic(ma.shear, mb.shear), true};
    equivalentMaterial(m, mixed.normal.parameter[0], mixed.normal.parameter[2]);
    // one side NULL, the other a number: the mean of what both stand for
    std::vector<double> &t = mixed.tangential.parameter;
    for (std::size_t p = 0; p < t.size(); ++p)
      if (std::isnan(a.tangential.parameter[p]) != std::isnan(b.tangential.parameter[p]))
        t[p] = geometric(tangentialParameter(a, p, ma), tangentialParameter(b, p, mb));
  }
  return mixed;
}

HistoryLayout historyLayout(const std::vector<ContactModel> &models)
{
  HistoryLayout layout;
  std::vector<signed char> mirror[modelSlots];
  const auto widen = [&](ModelSlot slot, int length, std::vector<signed char> signs) {
    const auto s = static_cast<std::size_t>(slot);
    const auto shared = static_cast<std::ptrdiff_t>(std::min(signs.size(), mirror[s].size()));
    if (!std::equal(signs.begin(), signs.begin() + shared, mirror[s].begin()))
      throw Error(
          fmt::format("two {} sub-models keep numbers that change sign differently when a pair is seen from the "
                      "other grain, so they cannot be in one run",
                      slotName(slot)));
    if (length <= layout.length[s]) return;
    layout.length[s] = length;
    mirror[s] = std::move(signs);
  };
  for (const ContactModel &model : models) {
    withModel(TangentialModels{}, model.tangential.name,
              [&](auto m) { widen(ModelSlot::Tangential, decltype(m)::history, decltype(m)::mirror()); });
    withModel(RollingModels{}, model.rolling.name,
              [&](auto m) { widen(ModelSlot::Rolling, decltype(m)::history, decltype(m)::mirror()); });
    withModel(TwistingModels{}, model.twisting.name,
              [&](auto m) { widen(ModelSlot::Twisting, decltype(m)::history, decltype(m)::mirror()); });
    withModel(NormalModels{}, model.normal.name, [&](auto m) {  // largest overlaps and the like have no direction
      widen(ModelSlot::Normal, decltype(m)::history, std::vector<signed char>(decltype(m)::history, 1));
    });
    withModel(CohesionModels{}, model.cohesion.name, [&](auto m) {
      widen(ModelSlot::Cohesion, decltype(m)::history, std::vector<signed char>(decltype(m)::history, 1));
    });
  }
  for (const ModelSlot slot :
       {ModelSlot::Tangential, ModelSlot::Rolling, ModelSlot::Twisting, ModelSlot::Normal, ModelSlot::Cohesion}) {
    const auto s = static_cast<std::size_t>(slot);
    layout.at[s] = layout.size;
    layout.size += layout.length[s];
    layout.mirror.insert(layout.mirror.end(), mirror[s].begin(), mirror[s].end());
  }
  return layout;
}

bool reachesBeyondTouch(const ContactModel &model)
{
  bool beyond = false;
  withModel(NormalModels{}, model.normal.name, [&](auto m) { beyond = decltype(m)::beyondTouch; });
  withModel(CohesionModels{}, model.cohesion.name, [&](auto m) { beyond = beyond || decltype(m)::beyondTouch; });
  return beyond;
}

bool actsBeforeTouch(const ContactModel &model)
{
  bool before = false;
  withModel(CohesionModels{}, model.cohesion.name, [&](auto m) { before = decltype(m)::beforeTouch; });
  return before;
}

double dampingCoefficient(const ContactModel &model)
{
  return deriveCoefficients(model).damping;
}

double pullOffGap(const ContactModel &model, double effectiveRadius)
{
  return AnyProduct::gap(deriveCoefficients(model), effectiveRadius);
}

static ContactResult evaluated(const ContactModel &model, const HistoryLayout &layout, const ContactState &state,
                               double *history, double dt, bool advance)
{
  const auto vector = [](const double *v) { return Vec3<double>{v[0], v[1], v[2]}; };
  Contact<double> c{};
  c.branch = vector(state.branch);
  c.distance = squareRoot(dot(c.branch, c.branch));
  c.inverseDistance = 1.0 / c.distance;
  c.overlap = state.overlap;
  c.effectiveRadius = state.effectiveRadius;
  c.effectiveMass = state.effectiveMass;
  c.relativeVelocity = vector(state.relativeVelocity);
  c.surfaceSpin = vector(state.surfaceSpin);
  c.spinDifference = vector(state.spinDifference);
  c.radiusDifference = state.partnerRadius - state.radius;
  c.inertia = state.inertia;
  c.atWall = state.partnerRadius == 0.0;
  const LayoutView view = layoutView(layout);
  ModelHistory<double> h{};
  moveHistory<AnyProduct>(view, h, [&](double &inRegister, int at) { inRegister = history[at]; });
  const ModelCoefficients<double> k = deriveCoefficients(model);
  const ContactParts<double> p = AnyProduct::parts(k, c, h, dt, advance);
  moveHistory<AnyProduct>(view, h, [&](double &inRegister, int at) { history[at] = inRegister; });
  ContactResult r{};
  const Vec3<double> n = p.frame.normal, force = n * p.normal.push + p.friction;
  const Vec3<double> torque = cross(n, p.friction) * -(state.radius - k.lever * c.overlap) + p.rolling + n * p.twisting;
  for (int d = 0; d < 3; ++d) {
    r.force[d] = force[d];
    r.torque[d] = torque[d];
    r.normal[d] = n[d];
    r.friction[d] = p.friction[d];
    r.rolling[d] = p.rolling[d];
  }
  r.push = p.normal.push;
  r.twisting = p.twisting;
  return r;
}

ContactResult evaluateContact(const ContactModel &model, const HistoryLayout &layout, const ContactState &state,
                              double *history, double dt)
{
  return evaluated(model, layout, state, history, dt, dt > 0.0);
}

ContactResult evaluateContactAtStart(const ContactModel &model, const HistoryLayout &layout, const ContactState &state,
                                     double *history, double dt)
{
  return evaluated(model, layout, state, history, dt, false);
}

}  // namespace gpudem
