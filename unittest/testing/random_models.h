// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Random contact laws, and random contacts seen from both grains.
#pragma once

#include "contact/derive.hpp"
#include "contact/layout.hpp"
#include "contact/product.hpp"

#include <random>

namespace gpudem::testing {

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  bool coin() { return between(0.0, 1.0) < 0.5; }
  Vec3<double> vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  template <class T>
  const T &oneOf(const std::vector<T> &list)
  {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random_)];
  }

 private:
  std::mt19937 random_;
};

/// Parameters that make forces of some 10^2 for grains of radius 1/2 and velocities of some 1.
inline std::vector<double> randomParameters(Dice &dice, ModelSlot slot, const std::string &name, bool material)
{
  if (slot == ModelSlot::Tangential) {
    if (name == "none") return {};
    if (name == "linear_nohistory") return {dice.between(0.1, 2.0), dice.between(0.1, 0.8)};
    const bool derived = name.find("linear_history") == std::string::npos && material && dice.coin();
    const bool dashpot = name == "liggghts_history" && material && dice.coin();
    return {derived ? std::nan("") : dice.between(1e3, 1e4), dashpot ? std::nan("") : dice.between(0.0, 1.0),
            dice.between(0.1, 0.8)};
  }
  if (slot == ModelSlot::Rolling && name == "cdt") return {dice.between(0.05, 0.5)};
  if (slot == ModelSlot::Rolling && name == "epsd") return {dice.between(0.05, 0.5), dice.between(0.0, 1.0)};
  if (slot == ModelSlot::Rolling && name == "epsd2") return {dice.between(0.05, 0.5)};
  if (slot == ModelSlot::Rolling && name == "epsd3")
    return {dice.between(0.05, 0.5), dice.between(0.0, 1.0), dice.between(0.5, 4.0)};
  if (slot == ModelSlot::Cohesion) {
    if (name == "sjkr" || name == "sjkr2") return {dice.between(1e2, 3e3)};
    if (name == "capillary") return {dice.between(1.0, 30.0), dice.between(0.0, 60.0), dice.between(1e-5, 1e-3)};
    if (name == "vdw") return {dice.between(0.01, 0.1), dice.between(0.005, 0.02), dice.between(0.02, 0.05)};
  }
  if (slot == ModelSlot::Rolling && name == "sds")
    return {dice.between(1e2, 1e3), dice.between(0.0, 5.0), dice.between(0.05, 0.5)};
  if (slot == ModelSlot::Twisting && name == "sds")
    return {dice.between(1e1, 1e2), dice.between(0.0, 1.0), dice.between(0.01, 0.1)};
  return {};
}

/// Second parameter of the normal sub-model, in the units of the damping sub-model.
inline double randomDamping(Dice &dice, const std::string &name)
{
  if (name == "velocity") return dice.between(0.0, 10.0);
  if (name == "mass_velocity") return dice.between(0.0, 30.0);
  if (name == "viscoelastic") return dice.between(0.0, 200.0);
  return dice.between(0.1, 1.0);  // a restitution
}

/// Parameters of the normal sub-model.
inline std::vector<double> randomNormal(Dice &dice, const std::string &name, double damping)
{
  if (name == "hooke" || name == "hertz") return {dice.between(5e3, 5e4), damping};
  const bool eepa = name.find("eepa") == 0;
  if (eepa || name == "luding") {
    const double k1 = dice.between(5e3, 5e4), k2 = k1 * dice.between(1.1, 4.0), adhesion = k1 * dice.between(0.0, 1.0);
    const double last = eepa ? dice.between(0.0, 10.0) : dice.between(0.01, 0.1);
    return {k1, damping, k2, dice.coin() ? adhesion : 0.0, dice.coin() ? last : 0.0};
  }
  const double young = dice.between(1e5, 1e6), poisson = dice.between(-0.5, 0.49);
  if (name == "thornton_ning") return {young, damping, poisson, young * dice.between(0.03, 0.3)};
  if (name == "dmt" || name == "jkr") return {young, damping, poisson, dice.between(0.0, 50.0)};
  return {young, damping, poisson};
}

/// A random name for each slot; sub-models that exclude each other do not meet.
inline ContactModel randomNames(Dice &dice)
{
  ContactModel m;
  for (int s = 0; s < modelSlots; ++s) {
    const auto slot = static_cast<ModelSlot>(s);
    m.slot(slot).name = dice.oneOf(subModels(slot)).name;
  }
  if (m.normal.name == "jkr" && (m.cohesion.name == "capillary" || m.cohesion.name == "vdw")) return randomNames(dice);
  const bool spring = subModel(ModelSlot::Tangential, m.tangential.name).history > 0;
  if (m.rolling.name == "epsd2" && !spring) return randomNames(dice);
  return m;
}

inline ContactModel randomModel(Dice &dice)
{
  ContactModel m = randomNames(dice);
  const std::string &normal = m.normal.name;
  m.normal.parameter = randomNormal(dice, normal, randomDamping(dice, m.damping.name));
  const bool material = contactModuli(m).known;
  for (const ModelSlot slot : {ModelSlot::Tangential, ModelSlot::Rolling, ModelSlot::Twisting, ModelSlot::Cohesion})
    m.slot(slot).parameter = randomParameters(dice, slot, m.slot(slot).name, material);
  const bool adhesive = normal == "dmt" || normal == "jkr" || normal == "luding" || normal.find("eepa") == 0;
  m.limitDamping = !adhesive && dice.coin();
  m.lever = dice.coin() ? 0.5 : 0.0;
  m.slipLever = dice.coin() ? 0.5 : 0.0;
  m.coulombBase = m.cohesion.name != "none" && dice.coin() ? CoulombBase::Net : CoulombBase::Contact;
  return m;
}

/// One contact from both sides, with every quantity as the step computes it.
template <class Real>
struct SeenTwice {
  Contact<Real> seen, mirrored;
  Real radius, radius2;
};

/// \param adhesive the contact may be a neck: overlap between the pull-off gap and a tenth of the radius
template <class Real>
SeenTwice<Real> randomContact(Dice &dice, const ContactModel &model)
{
  const auto u = [&](double lo, double hi) { return static_cast<Real>(dice.between(lo, hi)); };
  const Real ri = u(0.3, 0.7), rj = u(0.3, 0.7), mi = u(0.1, 2), mj = u(0.1, 2);
  const Vec3<Real> wi = dice.vector(9.0).as<Real>(), wj = dice.vector(9.0).as<Real>();
  SeenTwice<Real> p;
  p.radius = ri;
  p.radius2 = rj;
  Contact<Real> &c = p.seen;
  c.effectiveRadius = ri * rj / (ri + rj);
  const double gap = pullOffGap(model, static_cast<double>(c.effectiveRadius));
  const Vec3<Real> n = dice.vector(1.0).as<Real>();
  c.branch = n * ((ri + rj - u(-0.99 * gap, 0.05)) / squareRoot(dot(n, n)));
  const Real distance2 = dot(c.branch, c.branch);
  c.inverseDistance = inverseSquareRoot(distance2);
  c.distance = distance2 * c.inverseDistance;
  c.overlap = ri + rj - c.distance;
  if (gap == 0.0 && !(c.overlap > Real(0))) c.overlap = Real(1e-3);
  c.effectiveMass = mi * mj / (mi + mj);
  c.relativeVelocity = dice.vector(2.0).as<Real>();
  for (int d = 0; d < 3; ++d) c.surfaceSpin[d] = symmetricSum(ri, wi[d], rj, wj[d]);
  c.spinDifference = wi - wj;
  c.radiusDifference = rj - ri;
  const Real ii = mi * ri * ri, ij = mj * rj * rj;
  c.inertia = divide(ii * ij, symmetricSum(mi * ri, ri, mj * rj, rj));
  p.mirrored = c;
  p.mirrored.branch = c.branch * Real(-1);
  p.mirrored.relativeVelocity = c.relativeVelocity * Real(-1);
  for (int d = 0; d < 3; ++d) p.mirrored.surfaceSpin[d] = symmetricSum(rj, wj[d], ri, wi[d]);
  p.mirrored.spinDifference = wj - wi;
  p.mirrored.radiusDifference = ri - rj;
  p.mirrored.inertia = divide(ij * ii, symmetricSum(mj * rj, rj, mi * ri, ri));
  return p;
}

/// What a contact of \p model may keep, in the layout of the model alone.
inline std::vector<double> randomHistory(Dice &dice, const ContactModel &model, const HistoryLayout &layout)
{
  const bool force = model.tangential.name.find("/force") != std::string::npos;
  std::vector<double> h;
  for (int d = 0; d < layout.size; ++d) h.push_back(dice.between(-0.02, 0.02));
  const int at = layout.at[static_cast<int>(ModelSlot::Tangential)];
  for (int d = 0; force && d < 3; ++d) h[static_cast<std::size_t>(at + d)] *= 1e3;
  if (layout.length[static_cast<int>(ModelSlot::Tangential)] == 4)
    h[static_cast<std::size_t>(at + 3)] = dice.between(0.0, 0.3);  // the contact radius of the last step
  if (layout.length[static_cast<int>(ModelSlot::Normal)] == 1)
    h[static_cast<std::size_t>(layout.at[static_cast<int>(ModelSlot::Normal)])] =
        std::pow(dice.between(0.0, 0.06), model.normal.name == "eepa" ? 1.5 : 1.0);  // the largest overlap
  return h;
}

/// evaluate() with what is kept in memory instead of registers.
template <class Law, class Real>
ContactForce<Real> evaluateKept(const ModelCoefficients<Real> &k, const HistoryLayout &layout, const Contact<Real> &c,
                                std::vector<Real> &kept, Real dt, bool advance)
{
  const LayoutView view = layoutView(layout);
  ModelHistory<Real> h{};
  moveHistory<Law>(view, h, [&](Real &inRegister, int at) { inRegister = kept[static_cast<std::size_t>(at)]; });
  const ContactForce<Real> f = Law::evaluate(k, c, h, dt, advance);
  moveHistory<Law>(view, h, [&](Real &inRegister, int at) { kept[static_cast<std::size_t>(at)] = inRegister; });
  return f;
}

}  // namespace gpudem::testing
