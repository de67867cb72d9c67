// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Sub-models beyond LAMMPS 2021: loops and collisions in closed form, branches, limits, what is refused. Their
/// values and their antisymmetry are tested with those of all others (contact_value_test, contact_symmetry_test).

#include "contact/derive.hpp"
#include "contact/layout.hpp"
#include "contact/product.hpp"
#include "gpudem/contact_model.h"
#include "gpudem/errors.h"
#include "testing/random_models.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

const double pi = std::acos(-1.0), null = std::nan("");

/// A contact of two grains of radius 1/2 (R* = 1/4, m* = 1/2) along x that remembers.
class Contacting {
 public:
  explicit Contacting(ContactModel model)
      : model_(std::move(model)), layout_(historyLayout({model_})), kept(layout_.size)
  {
  }
  ContactState state(double overlap) const
  {
    ContactState s{};
    s.overlap = overlap;
    s.radius = s.partnerRadius = 0.5;
    s.branch[0] = 1.0 - overlap;
    s.effectiveRadius = 0.25;
    s.effectiveMass = 0.5;
    s.inertia = 0.125;
    return s;
  }
  ContactResult evaluate(const ContactState &s, double dt = 1e-3)
  {
    return evaluateContact(model_, layout_, s, kept.data(), dt);
  }
  double push(double overlap, double speed = 0.0)
  {
    ContactState s = state(overlap);
    s.relativeVelocity[0] = speed;
    return evaluate(s).push;
  }
  /// Work done by the grain while the overlap goes from one value to another.
  double work(double from, double to, int steps = 20000)
  {
    double sum = 0.0, before = push(from);
    for (int k = 1; k <= steps; ++k) {
      const double now = push(from + (to - from) * k / steps);
      sum += 0.5 * (before + now) * (to - from) / steps;
      before = now;
    }
    return sum;
  }
  /// Rebound over impact speed of a head-on collision, by velocity Verlet.
  double restitution(double speed, double dt)
  {
    double overlap = 0.0, rate = speed, force = 0.0;
    do {
      rate -= 0.5 * dt * force / 0.5;
      overlap += dt * rate;
      force = overlap > 0.0 ? push(overlap) : 0.0;
      rate -= 0.5 * dt * force / 0.5;
    } while (overlap > 0.0);
    return -rate / speed;
  }

 private:
  ContactModel model_;
  HistoryLayout layout_;

 public:
  std::vector<double> kept;  ///< what the contact keeps
};

ContactModel undamped(const std::string &name, std::vector<double> parameter)
{
  ContactModel m;
  m.damping.name = "velocity";
  m.normal = {name, std::move(parameter)};
  m.tangential = {"none", {}};
  return m;
}
ContactModel luding(double kc, double phi)
{
  return undamped("luding", {1e4, 0.0, 4e4, kc, phi});
}

const Tolerance exact(double magnitude)
{
  return roundOff(Precision::Double, std::abs(magnitude), 64);
}
/// Trapezia of 20000 steps, and collisions of some 10^4 steps of second order.
Tolerance integrated(double magnitude)
{
  return {1e-6, magnitude};
}

std::string refusal(const ContactModel &m)
{
  try {
    deriveCoefficients(m);
  } catch (const Error &e) {
    return e.what();
  }
  return "";
}
void expectRefused(const ContactModel &m, const std::string &words)
{
  EXPECT_NE(refusal(m).find(words), std::string::npos) << "'" << words << "' is missing in '" << refusal(m) << "'";
}

TEST(Luding, RestitutionIsTheRootOfTheStiffnessRatio)
{
  EXPECT_TRUE(near(Contacting(luding(0.0, 0.0)).restitution(1.0, 1e-6), 0.5, integrated(1.0)));
  // with a slope that grows: that of the largest overlap, v sqrt(m*/k1)
  const double largest = std::sqrt(0.5 / 1e4), limit = 4.0 / 3.0 * 0.05 * 0.5;
  ASSERT_LT(largest, limit);
  const double slope = 1e4 + 3e4 * largest / limit;
  EXPECT_TRUE(near(Contacting(luding(0.0, 0.05)).restitution(1.0, 1e-6), std::sqrt(1e4 / slope), integrated(1.0)));
}

TEST(Luding, LoopOfLoadingAndUnloading)
{
  const double k1 = 1e4, k2 = 4e4, kc = 5e3, largest = 0.02;
  Contacting c(luding(kc, 0.0));
  const double loss = c.work(0.0, largest) + c.work(largest, 0.0);
  // the plastic overlap, where the force vanishes, and where the adhesive branch begins
  const double rest = (1.0 - k1 / k2) * largest, least = (k2 - k1) / (k2 + kc) * largest;
  const double expected = 0.5 * k1 * largest * largest * (1.0 - k1 / k2) + 0.5 * kc * least * rest;
  EXPECT_TRUE(near(loss, expected, integrated(expected)));
}

TEST(Luding, BranchesMeet)
{
  const double k1 = 1e4, k2 = 4e4, kc = 5e3, largest = 0.02, least = (k2 - k1) / (k2 + kc) * largest, rest = 0.015;
  Contacting c(luding(kc, 0.0));
  EXPECT_TRUE(near(c.push(largest), k1 * largest, exact(200.0)));
  EXPECT_TRUE(near(c.push(largest * (1 - 1e-12)), k1 * largest, {1e-11, 200.0}));
  EXPECT_TRUE(near(c.push(rest), 0.0, exact(200.0)));
  EXPECT_TRUE(near(c.push(least), -kc * least, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * least), -kc * 0.5 * least, exact(200.0)));
  // reloading leaves the adhesive branch with slope k2 and joins that of loading
  EXPECT_TRUE(near(c.push(0.5 * least + 1e-4), -kc * 0.5 * least + k2 * 1e-4, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * largest), k1 * 0.5 * largest, exact(200.0)));
  EXPECT_TRUE(near(c.push(0.5 * largest + 1e-3), k1 * (0.5 * largest + 1e-3), exact(200.0)));
}

/// Where the slope grows, too, the adhesive branch can be left and entered at any overlap.
TEST(Luding, AdhesiveBranchWithGrowingSlope)
{
  const double kc = 5e3;
  Contacting c(luding(kc, 0.05));
  c.push(0.03);
  for (double x = 0.02; x > 0.002; x -= 0.001) {
    const double force = c.push(x);
    if (force > -kc * x * 0.999) continue;
    EXPECT_TRUE(near(c.push(x), -kc * x, exact(300.0))) << x;
    const double largest = c.kept[0], limit = 4.0 / 3.0 * 0.05 * 0.5, slope = 1e4 + 3e4 * largest / limit;
    EXPECT_TRUE(near(slope * (x - largest) + 1e4 * largest, -kc * x, exact(300.0)));
    EXPECT_TRUE(near(c.push(x * 1.01), -kc * x + slope * 0.01 * x, exact(300.0)));
    EXPECT_TRUE(near(c.push(x), -kc * x, exact(300.0)));
  }
  EXPECT_LT(c.kept[0], 0.02) << "the branch must have been met";
}

TEST(Luding, ElasticBeyondTheLimitOverlap)
{
  const double limit = 4.0 / 3.0 * 0.05 * 0.5;
  Contacting c(luding(1e3, 0.05));
  c.push(limit);
  const double loss = c.work(limit, 2.0 * limit) + c.work(2.0 * limit, limit);
  EXPECT_TRUE(near(loss, 0.0, integrated(1e4 * limit * limit)));
  EXPECT_TRUE(near(c.push(2.0 * limit), 1e4 * limit + 4e4 * limit, exact(2e3)));
}

/// The dashpot of a restitution does not follow F/delta, which vanishes and turns negative on unloading.
TEST(PlasticNormals, DashpotAlwaysDissipates)
{
  for (const char *name : {"luding", "eepa", "eepa/linear", "thornton_ning"}) {
    ContactModel m = undamped(name, {1e4, 0.5, 4e4, 5e3, 0.0});
    if (m.normal.name == "thornton_ning") m.normal.parameter = {1e6, 0.5, 0.3, 5e4};
    m.damping.name = "coeff_restitution";
    Contacting c(m);
    c.push(0.02);
    for (double x = 0.0199; x > 0.002; x -= 0.001) {
      const double still = c.push(x);
      EXPECT_GE(still - c.push(x, 1.0), 0.0) << name << x;
      EXPECT_TRUE(std::isfinite(c.push(x, 1.0)));
      EXPECT_TRUE(still == 0.0 || still > c.push(x, 1.0)) << name << x;
    }
  }
  // without hysteresis it is the dashpot of hooke, and returns what was asked for
  ContactModel elastic = undamped("luding", {1e4, 0.7, 1e4, 0.0, 0.0}), hooke = undamped("hooke", {1e4, 0.7});
  elastic.damping.name = hooke.damping.name = "coeff_restitution";
  EXPECT_EQ(Contacting(elastic).push(0.01, -0.3), Contacting(hooke).push(0.01, -0.3));
}

TEST(Eepa, LoopOfLoadingAndUnloading)
{
  const double k1 = 1e4, k2 = 4e4, kadh = 5e3, f0 = 3.0, largest = 0.02;
  for (const double n : {1.0, 1.5}) {
    Contacting c(undamped(n == 1.0 ? "eepa/linear" : "eepa", {k1, 0.0, k2, kadh, f0}));
    const double in = c.work(0.0, largest), out = -c.work(largest, 0.0);
    // integral of k x from zero to delta, x = delta^n
    const auto energy = [&](double k, double x) { return k * std::pow(x, (n + 1.0) / n) / (n + 1.0); };
    const double top = std::pow(largest, n), rest = (1.0 - k1 / k2) * top, least = (k2 - k1) / (k2 + kadh) * top;
    const double unloading =
        energy(k2, top) - energy(k2, least) - k2 * rest * (largest - std::pow(least, 1.0 / n)) - energy(kadh, least);
    EXPECT_TRUE(near(in, energy(k1, top) - f0 * largest, integrated(in))) << n;
    EXPECT_TRUE(near(out, unloading - f0 * largest, integrated(in))) << n;
  }
}

TEST(Eepa, BranchesMeet)
{
  const double k1 = 1e4, k2 = 4e4, kadh = 5e3, f0 = 3.0, top = std::pow(0.02, 1.5);
  const double least = (k2 - k1) / (k2 + kadh) * top;
  Contacting c(undamped("eepa", {k1, 0.0, k2, kadh, f0}));
  EXPECT_TRUE(near(c.push(1e-12), -f0, {1e-9, f0}));
  EXPECT_TRUE(near(c.push(0.02), k1 * top - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(0.75 * top, 2.0 / 3.0)), -f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(least, 2.0 / 3.0)), -kadh * least - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(std::pow(0.5 * least, 2.0 / 3.0)), -kadh * 0.5 * least - f0, exact(30.0)));
  EXPECT_TRUE(near(c.push(0.015), k1 * std::pow(0.015, 1.5) - f0, exact(30.0)));
}

/// With n = 1 and f0 = 0 it is the model of Luding with a constant slope.
TEST(Eepa, LinearIsLuding)
{
  Contacting a(undamped("eepa/linear", {1e4, 0.0, 4e4, 5e3, 0.0})), b(luding(5e3, 0.0));
  Dice dice(3);
  for (int k = 0; k < 1000; ++k) {
    const double x = dice.between(0.0, 0.02);
    ASSERT_TRUE(near(a.push(x), b.push(x), exact(200.0)));
  }
}

/// Restitution of Thornton and Ning; below the yield velocity the collision is elastic.
TEST(ThorntonNing, RestitutionIsTheClosedForm)
{
  const double young = 1e6, yield = 1e5, star = young / (2.0 * (1.0 - 0.09)), radius = 0.25;
  const double strain = pi * yield / (2.0 * star), overlap = strain * strain * radius;
  // energy of Hertz up to the yield overlap: 8/15 E* sqrt(R*) delta^(5/2) = m* v_y^2/2
  const double slowest = std::sqrt(16.0 / 15.0 * star * std::sqrt(radius) * std::pow(overlap, 2.5) / 0.5);
  for (const double factor : {0.9, 1.0, 1.5, 3.0, 10.0}) {
    const double q = std::min(1.0, 1.0 / factor);
    const double expected = std::sqrt(6.0 * std::sqrt(3.0) / 5.0) * std::sqrt(1.0 - q * q / 6.0) *
                            std::pow(q / (q + 2.0 * std::sqrt(1.2 - 0.2 * q * q)), 0.25);
    const double e =
        Contacting(undamped("thornton_ning", {young, 0.0, 0.3, yield})).restitution(factor * slowest, 2e-6);
    EXPECT_TRUE(near(e, expected, {1e-5, 1.0})) << factor;  // the force has a kink in its slope where it yields
  }
}

TEST(ThorntonNing, BranchesMeet)
{
  const double young = 1e6, yield = 1e5, star = young / (2.0 * (1.0 - 0.09)), radius = 0.25;
  const double strain = pi * yield / (2.0 * star), overlap = strain * strain * radius;
  const auto hertz = [&](double r, double x) { return 4.0 / 3.0 * star * std::sqrt(r) * std::pow(x, 1.5); };
  Contacting c(undamped("thornton_ning", {young, 0.0, 0.3, yield}));
  const double force = hertz(radius, overlap);
  EXPECT_TRUE(near(c.push(0.3 * overlap), hertz(radius, 0.3 * overlap), exact(force)));
  EXPECT_TRUE(near(c.push(overlap), force, exact(force)));
  EXPECT_TRUE(near(c.push(0.3 * overlap), hertz(radius, 0.3 * overlap), exact(force))) << "no loss before yield";
  EXPECT_TRUE(near(c.push(overlap * (1.0 + 1e-9)), force, {3e-9, force}));
  EXPECT_TRUE(near(c.push(3.0 * overlap), force + pi * yield * radius * 2.0 * overlap, exact(5.0 * force)));
  // unloading: Hertz of the larger curvature radius, from the same force and contact radius
  const double top = c.push(3.0 * overlap), curvature = radius * hertz(radius, 3.0 * overlap) / top;
  const double part = 3.0 * overlap * (1.0 - radius / curvature);
  EXPECT_GT(curvature, radius);
  EXPECT_TRUE(near(c.push(3.0 * overlap * (1.0 - 1e-12)), top, {1e-10, top}));
  const double half = 0.5 * (3.0 * overlap + part);
  EXPECT_TRUE(near(c.push(half), hertz(curvature, half - part), exact(5.0 * force)));
  EXPECT_EQ(c.push(part * 0.999), 0.0) << "the surfaces part in the dent";
  EXPECT_TRUE(near(c.push(3.0 * overlap), top, exact(top))) << "reloading is elastic";
}

/// The lens of two spheres by its own geometry: a circle of radius h with h^2 = R_i^2 - x^2 around the centre line.
TEST(Sjkr, AreasAreThoseOfTheGeometry)
{
  ContactModel m = undamped("hooke", {0.0, 0.0});
  m.cohesion = {"sjkr", {1e3}};
  ContactState s{};
  for (const auto &[ri, rj] : {std::pair{0.5, 0.5}, std::pair{0.3, 0.7}, std::pair{0.7, 0.31}}) {
    const double overlap = 0.04, d = ri + rj - overlap, x = (d * d + ri * ri - rj * rj) / (2.0 * d);
    s.overlap = overlap;
    s.branch[0] = d;
    s.radius = ri;
    s.partnerRadius = rj;
    s.effectiveRadius = ri * rj / (ri + rj);
    s.effectiveMass = 1.0;
    const double area = pi * (ri * ri - x * x);
    EXPECT_TRUE(near(evaluateContact(m, {}, s, nullptr, 0.0).push, -1e3 * area, exact(1e3 * area)));
    m.cohesion.name = "sjkr2";
    const double disc = 2.0 * pi * overlap * 2.0 * s.effectiveRadius;
    EXPECT_TRUE(near(evaluateContact(m, {}, s, nullptr, 0.0).push, -1e3 * disc, exact(1e3 * disc)));
    m.cohesion.name = "sjkr";
  }
  s.partnerRadius = 0.0;  // a wall
  s.radius = s.effectiveRadius = 0.5;
  s.branch[0] = 0.46;
  const double circle = pi * (0.25 - 0.46 * 0.46);
  EXPECT_TRUE(near(evaluateContact(m, {}, s, nullptr, 0.0).push, -1e3 * circle, exact(1e3 * circle)));
}

ContactModel wet(double angle = 30.0, double volume = 1e-4)
{
  ContactModel m = undamped("hertz", {1e4, 0.0});
  m.cohesion = {"capillary", {2.0, angle, volume}};
  return m;
}

TEST(Capillary, ForceAtTouchAndReach)
{
  Contacting c(wet());
  const double touch = -4.0 * pi * 2.0 * 0.25 * std::cos(pi / 6.0);
  EXPECT_TRUE(near(c.push(-1e-15), touch, {1e-11, -touch}));
  EXPECT_TRUE(near(c.push(1e-15), touch, {1e-11, -touch}));
  EXPECT_TRUE(near(c.push(0.01), touch + 1e4 * std::sqrt(0.25) * 1e-3, exact(10.0)));
  // where S = 1: s = sqrt(V/(2 R*))
  EXPECT_TRUE(near(c.push(-std::sqrt(1e-4 / 0.5)), touch / 4.55, exact(touch)));
  const double reach = (1.0 + pi / 12.0) * std::cbrt(1e-4);
  EXPECT_TRUE(near(pullOffGap(wet(), 0.25), reach, exact(reach)));
  EXPECT_TRUE(near(pullOffGap(wet(), 1.0), reach, exact(reach)));
  EXPECT_TRUE(near(pullOffGap(wet(0.0), 0.25), std::cbrt(1e-4), exact(reach)));
  EXPECT_TRUE(reachesBeyondTouch(wet()));
  EXPECT_FALSE(actsBeforeTouch(wet()));
  EXPECT_EQ(historyLayout({wet()}).size, 0) << "the contact itself is the memory of the bridge";
  double last = -1e9;
  for (double s = 0.0; s < reach; s += 0.01 * reach) {
    EXPECT_GT(c.push(-s), last);
    last = c.push(-s);
  }
}

TEST(Vdw, ForceByItsSeparation)
{
  ContactModel m = undamped("hertz", {1e4, 0.0});
  m.cohesion = {"vdw", {0.01, 0.01, 0.05}};
  Contacting c(m);
  const double touch = -0.01 * 0.25 / (6.0 * 1e-4);
  EXPECT_TRUE(near(c.push(-0.04), touch / 16.0, exact(touch)));
  EXPECT_TRUE(near(c.push(-0.02), touch / 4.0, exact(touch)));
  for (const double s : {0.01, 0.005, 1e-12}) EXPECT_TRUE(near(c.push(-s), touch, exact(touch)));
  EXPECT_TRUE(near(c.push(0.01), touch + 5.0, exact(10.0)));
  EXPECT_EQ(pullOffGap(m, 0.25), 0.05);
  EXPECT_TRUE(actsBeforeTouch(m));
}

/// Beyond touch there is the bridge alone: no dashpot, no friction, and nothing is remembered of the touch.
TEST(Cohesion, SurfacesForgetWhenTheyPart)
{
  ContactModel m = luding(0.0, 0.0);
  m.normal.parameter[1] = 50.0;
  m.tangential = {"linear_history", {1e3, 0.5, 0.5}};
  m.rolling = {"sds", {100.0, 1.0, 0.5}};
  m.twisting = {"sds", {10.0, 1.0, 0.1}};
  m.cohesion = {"capillary", {2.0, 30.0, 1e-4}};
  Contacting c(m);
  ContactState s = c.state(0.01);
  for (int d = 0; d < 3; ++d) s.relativeVelocity[d] = s.surfaceSpin[d] = s.spinDifference[d] = 1.0 + d;
  c.evaluate(s);
  EXPECT_NE(c.kept, std::vector<double>(c.kept.size(), 0.0));
  EXPECT_GT(c.kept.back(), 0.0) << "the largest overlap";
  s.overlap = -0.01;
  s.branch[0] = 1.01;
  const ContactResult r = c.evaluate(s);
  for (const double number : c.kept) EXPECT_EQ(number, 0.0);
  EXPECT_EQ(r.push, Contacting(m).push(-0.01));
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(r.friction[d], 0.0);
    EXPECT_EQ(r.torque[d], 0.0);
  }
  EXPECT_TRUE(near(Contacting(m).push(0.01), 100.0 - 4.0 * pi * 0.5 * std::cos(pi / 6.0), exact(100.0)));
}

/// A grain held by cohesion alone still has friction; counted from the net force it has none.
TEST(Cohesion, CoulombLimitCountsAsAsked)
{
  ContactModel m = undamped("hooke", {1e4, 0.0});
  m.tangential = {"linear_history", {1e6, 0.0, 0.5}};
  m.cohesion = {"sjkr2", {1e4 * 0.01 / (4.0 * pi * 0.01 * 0.25)}};
  for (const CoulombBase base : {CoulombBase::Contact, CoulombBase::Net}) {
    m.coulombBase = base;
    Contacting c(m);
    ContactState s = c.state(0.01);
    s.relativeVelocity[1] = 1.0;
    const ContactResult r = c.evaluate(s);
    EXPECT_TRUE(near(r.push, 0.0, exact(100.0)));
    EXPECT_TRUE(near(r.friction[1], base == CoulombBase::Contact ? -50.0 : 0.0, exact(100.0)));
  }
}

TEST(Cdt, TorqueOpposesRollingWithoutTwist)
{
  ContactModel m = undamped("hooke", {1e4, 0.0});
  m.rolling = {"cdt", {0.2}};
  m.cohesion = {"sjkr", {10.0}};  // is not counted
  Contacting c(m);
  ContactState s = c.state(0.01);
  s.spinDifference[0] = 3.0;
  s.spinDifference[1] = 4.0;
  const ContactResult r = c.evaluate(s);
  EXPECT_TRUE(near(r.rolling[1], -0.2 * 0.25 * 100.0 * 0.8, exact(10.0)));
  EXPECT_EQ(r.rolling[0], 0.0);
  s.spinDifference[0] = s.spinDifference[1] = 0.0;
  EXPECT_EQ(c.evaluate(s).rolling[1], 0.0);
}

TEST(Epsd, SpringDashpotAndLimit)
{
  const double mu = 0.2, kn = 1e4, eta = 0.3, kr = 2.25 * kn * std::pow(mu * 0.25, 2), limit = mu * 0.25 * 100.0;
  for (const bool third : {false, true}) {
    ContactModel m = undamped("hooke", {kn, 0.0});
    m.rolling = {"epsd", {mu, eta}};
    if (third) m.rolling = {"epsd3", {mu, eta, 4.5}};
    const double k = third ? 2.0 * kr : kr;
    Contacting c(m);
    ContactState s = c.state(0.01);
    s.spinDifference[1] = 5.0;
    const double dashpot = 2.0 * eta * std::sqrt(1.4 * 0.125 * k) * 5.0;
    EXPECT_TRUE(near(c.evaluate(s, 0.0).rolling[1], -dashpot, exact(10.0)));
    EXPECT_TRUE(near(c.evaluate(s).rolling[1], -k * 5.0 * 1e-3 - dashpot, exact(10.0)));
    for (int step = 0; step < 100; ++step) c.evaluate(s);
    EXPECT_TRUE(near(c.evaluate(s).rolling[1], -limit, exact(10.0))) << "no dashpot at the limit";
    s.spinDifference[1] = -5.0;
    EXPECT_TRUE(near(c.evaluate(s).rolling[1], -limit + k * 5.0 * 1e-3 + dashpot, exact(10.0)));
    s.spinDifference[1] = 0.0;
    s.spinDifference[0] = 5.0;
    EXPECT_EQ(c.evaluate(s).rolling[0], 0.0) << "twisting is no rolling";
  }
}

/// With a linear spring and a normal that stands, epsd2 is sds of stiffness kt without dashpot.
TEST(Epsd, SecondFormIsSdsOfTheTangentialStiffness)
{
  ContactModel a = undamped("hooke", {1e4, 0.0});
  a.tangential = {"linear_history", {3e3, 0.0, 0.5}};
  ContactModel b = a;
  a.rolling = {"epsd2", {0.2}};
  b.rolling = {"sds", {3e3, 0.0, 0.2}};
  Contacting one(a), other(b);
  Dice dice(9);
  ContactState s = one.state(0.01);
  for (int k = 0; k < 2000; ++k) {
    if (k % 100 == 0) s.spinDifference[1] = dice.between(-5.0, 5.0);
    if (k % 70 == 0) s.spinDifference[2] = dice.between(-5.0, 5.0);
    const ContactResult r = one.evaluate(s), q = other.evaluate(s);
    for (int d = 0; d < 3; ++d) ASSERT_TRUE(near(r.rolling[d], q.rolling[d], roundOff(Precision::Double, 5.0, 4000)));
  }
}

TEST(LiggghtsTangential, SpringAloneIsClipped)
{
  ContactModel m = undamped("hooke", {1e4, 30.0});
  m.tangential = {"liggghts_linear_history", {2e3, 2.0, 0.5}};
  Contacting c(m);
  ContactState s = c.state(0.01);
  s.relativeVelocity[1] = 2.0;
  EXPECT_TRUE(near(c.evaluate(s).friction[1], -2e3 * 2e-3 - 60.0 * 2.0, exact(100.0))) << "beyond the limit of 50";
  for (int k = 0; k < 20; ++k) c.evaluate(s);
  EXPECT_TRUE(near(c.evaluate(s).friction[1], -50.0, exact(100.0))) << "the limit, no dashpot";
  EXPECT_TRUE(near(c.kept[1], 50.0 / 2e3, exact(0.1)));
  // turned by 60 degrees: the projection, not the length
  s.relativeVelocity[1] = 0.0;
  s.branch[0] = 0.99 * 0.5;
  s.branch[1] = 0.99 * std::sqrt(0.75);
  const ContactResult r = c.evaluate(s);
  EXPECT_TRUE(near(std::hypot(r.friction[0], r.friction[1]), 25.0, exact(100.0)));
  EXPECT_TRUE(near(r.friction[0] * s.branch[0] + r.friction[1] * s.branch[1], 0.0, exact(100.0)));
}

/// kt = 8 G*, and the dashpot of restitution for the tangential stiffness: 2 sqrt(5/6) beta sqrt(8 G* a m*).
TEST(LiggghtsTangential, NullIsWhatLiggghtsHas)
{
  const double young = 1e6, nu = 0.3, e = 0.5, overlap = 0.01, a = std::sqrt(0.25 * overlap);
  ContactModel m = undamped("hertz/material", {young, e, nu});
  m.damping.name = "coeff_restitution";
  m.tangential = {"liggghts_history", {null, null, 10.0}};
  Contacting c(m);
  ContactState s = c.state(overlap);
  s.relativeVelocity[1] = 1.0;
  const double shear = young / (4.0 * (2.0 - nu) * (1.0 + nu)), beta = -std::log(e) / std::hypot(std::log(e), pi);
  const double eta = 2.0 * std::sqrt(5.0 / 6.0) * beta * std::sqrt(8.0 * shear * a * 0.5);
  EXPECT_TRUE(near(c.evaluate(s, 0.0).friction[1], -eta, exact(eta)));
  EXPECT_TRUE(near(c.evaluate(s).friction[1], -eta - 8.0 * shear * a * 1e-3, exact(eta + 1e3)));
  EXPECT_TRUE(near(deriveCoefficients(m).tangential[1], 0.907485, {1e-6, 1.0}));
  // mixed with a law that gives the numbers which NULL stands for here, nothing changes
  ContactModel given = m;
  given.tangential.parameter = {8.0 * shear, 2.0 * std::sqrt(2.0 * (1.0 - nu * nu) * shear / young), 10.0};
  const std::vector<double> mixed = mixModels(m, given).tangential.parameter;
  for (std::size_t p = 0; p < 3; ++p)
    EXPECT_TRUE(near(mixed[p], given.tangential.parameter[p], exact(given.tangential.parameter[p])));
}

/// With the arms of slip velocity and torque alike, the power of friction on both grains is that at the surfaces.
TEST(SlipLever, ArmsAreConjugate)
{
  Dice dice(21);
  for (const double lever : {0.0, 0.5}) {
    for (int k = 0; k < 500; ++k) {
      ContactModel m = undamped("hooke", {1e4, 10.0});
      m.tangential = {"linear_history", {1e3, 0.5, 10.0}};
      m.lever = m.slipLever = lever;
      const double ri = dice.between(0.3, 0.7), rj = k % 3 ? dice.between(0.3, 0.7) : 0.0, overlap = 0.04;
      const Vec3<double> wi = dice.vector(5.0), wj = rj > 0.0 ? dice.vector(5.0) : Vec3<double>{}, v = dice.vector(1.0);
      ContactState s{};
      s.overlap = overlap;
      s.radius = ri;
      s.partnerRadius = rj;
      s.branch[0] = ri + rj - overlap;
      s.effectiveRadius = rj > 0.0 ? ri * rj / (ri + rj) : ri;
      s.effectiveMass = 1.0;
      for (int d = 0; d < 3; ++d) {
        s.relativeVelocity[d] = v[d];
        s.surfaceSpin[d] = ri * wi[d] + rj * wj[d];
        s.spinDifference[d] = wi[d] - wj[d];
      }
      const HistoryLayout layout = historyLayout({m});
      double kept[3] = {};
      const ContactResult r = evaluateContact(m, layout, s, kept, 1e-3);
      const Vec3<double> friction{r.friction[0], r.friction[1], r.friction[2]},
          couple{r.torque[0], r.torque[1], r.torque[2]};
      // the partner's torque has its own arm
      const double arm = ri - lever * overlap, other = rj - lever * overlap;
      const double power = dot(friction, v) + dot(couple, wi) + (rj > 0.0 ? other / arm * dot(couple, wj) : 0.0);
      const double slip = dot(friction, Vec3<double>{kept[0], kept[1], kept[2]}) / 1e-3;
      ASSERT_TRUE(near(power, slip, exact(500.0))) << lever << " " << rj;
    }
  }
}

TEST(FurtherModels, WhatIsRefused)
{
  expectRefused(undamped("luding", {1e4, 0.0, 0.9e4, 0.0, 0.0}), "normal luding: the stiffness k2 of unloading");
  expectRefused(undamped("eepa", {1e4, 0.0, 0.9e4, 0.0, 0.0}), "normal eepa: the stiffness k2 of unloading");
  expectRefused(undamped("thornton_ning", {1e6, 0.0, 0.3, 0.0}), "thornton_ning Y = 0 must be positive");
  ContactModel m = luding(0.0, 0.0);
  m.limitDamping = true;
  expectRefused(m, "limit_damping would remove the adhesion of normal luding");
  m = wet(91.0);
  expectRefused(m, "cohesion capillary theta = 91 must lie between 0 and 90");
  m.cohesion = {"vdw", {1.0, 0.1, 0.05}};
  expectRefused(m, "cut-off s_c must not be below");
  m = wet();
  m.normal = {"jkr", {1e6, 0.0, 0.3, 1.0}};
  expectRefused(m, "normal jkr and cohesion capillary both act beyond touch");
  m.cohesion = {"sjkr", {1.0}};
  EXPECT_EQ(refusal(m), "");
  m = undamped("hooke", {1e4, 0.0});
  m.coulombBase = CoulombBase::Net;
  expectRefused(m, "there is no cohesion sub-model");
  m.coulombBase = CoulombBase::Contact;
  m.rolling = {"epsd2", {0.1}};
  expectRefused(m, "rolling epsd2 needs a tangential sub-model that has a spring");
  m.tangential = {"liggghts_history", {1e3, null, 0.5}};
  expectRefused(m, "needs a normal sub-model that names a material");
}

TEST(FurtherModels, ConventionsAreNotMixed)
{
  ContactModel a = wet(), b = wet();
  a.tangential = b.tangential = {"linear_history", {1e3, 0.5, 0.5}};
  b.cohesion.parameter = {8.0, 30.0, 4e-4};
  EXPECT_TRUE(near(mixModels(a, b).cohesion.parameter[0], 4.0, exact(4.0)));
  b.slipLever = 0.5;
  EXPECT_THROW(mixModels(a, b), Error);
  b.slipLever = 0.0;
  b.coulombBase = CoulombBase::Net;
  EXPECT_THROW(mixModels(a, b), Error);
  // sds keeps a displacement that looks the same from either grain, epsd a torque that does not
  a.rolling = {"sds", {1.0, 0.0, 0.1}};
  b.rolling = {"epsd", {0.1, 0.0}};
  EXPECT_THROW(historyLayout({a, b}), Error);
}

/// Blocks in the order tangential, rolling, twisting, normal, cohesion.
TEST(FurtherModels, LayoutOfTheSlots)
{
  ContactModel m = luding(0.0, 0.0);
  m.tangential = {"liggghts_linear_history", {1e3, 0.5, 0.5}};
  m.rolling = {"epsd", {0.1, 0.0}};
  m.twisting = {"sds", {1.0, 0.0, 0.1}};
  m.cohesion = {"capillary", {1.0, 0.0, 1e-4}};
  const HistoryLayout layout = historyLayout({m});
  EXPECT_EQ(layout.mirror, (std::vector<signed char>{-1, -1, -1, -1, -1, -1, 1, 1}));
  EXPECT_EQ(layout.at[static_cast<int>(ModelSlot::Normal)], 7);
  EXPECT_EQ(layout.at[static_cast<int>(ModelSlot::Cohesion)], 8);
  EXPECT_EQ(layout.length[static_cast<int>(ModelSlot::Cohesion)], 0);
}

}  // namespace
