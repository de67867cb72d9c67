// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file JKR and DMT: contact radius, pull-off force, gap.

#include "contact/derive.hpp"
#include "contact/product.hpp"
#include "testing/long_hand.h"
#include "testing/tolerance.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

constexpr double poisson = 0.3;

ContactModel adhesive(const std::string &normal, double young, double gamma)
{
  ContactModel m;
  m.normal = {normal, {young, 1.0, poisson, gamma}};
  m.tangential = {"none", {}};
  m.damping.name = "coeff_restitution";
  return m;
}
/// E* of the material with itself
double effectiveYoung(double young)
{
  return young / (2.0 * (1.0 - poisson * poisson));
}

template <class N, class Real>
NormalForce<Real> forceOf(const ContactModel &m, double overlap, double radius)
{
  const ModelCoefficients<Real> k = coefficients<Real>(m);
  Contact<Real> c{};
  c.overlap = static_cast<Real>(overlap);
  c.effectiveRadius = static_cast<Real>(radius);
  return N::force(k, c, static_cast<Real *>(nullptr));
}

const std::vector<double> youngs{1e5, 1e7, 1e9, 1e11}, radii{1e-5, 1e-2, 0.5},
    gammas{0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.05, 1.0, 30.0, 1e3, 1e5};

/// delta = a^2/R - 2 sqrt(pi gamma a/E*), from the pull-off gap to deep overlap, relative to the largest of the terms.
template <class Real>
void expectContactRadius(Precision precision, double operations)
{
  for (const double young : youngs)
    for (const double gamma : gammas)
      for (const double radius : radii) {
        const ContactModel m = adhesive("jkr", young, gamma);
        const double gap = pullOffGap(m, radius), e = effectiveYoung(young);
        SCOPED_TRACE("E " + std::to_string(young) + " gamma " + std::to_string(gamma * 1e12) + "e-12 R " +
                     std::to_string(radius));
        for (int n = 0; n <= 400; ++n) {
          const double wanted = n < 100 ? -gap * (1.0 - n * 0.01) : radius * std::pow(10.0, -9.0 + (n - 100) * 0.03);
          const Real overlap = static_cast<Real>(wanted);
          const double a = forceOf<JkrNormal, Real>(m, wanted, radius).contactRadius;
          const double r = static_cast<Real>(radius), load = a * a / r, pull = 2.0 * std::sqrt(circle * gamma * a / e);
          const double largest = std::max(std::max(load, pull), std::abs(static_cast<double>(overlap)));
          ASSERT_TRUE(near(load - pull, overlap, roundOff(precision, largest, operations))) << "overlap " << wanted;
          ASSERT_GE(a, std::cbrt(0.25 * circle * gamma * r * r / e)) << "the larger root";
        }
      }
}

TEST(Jkr, ContactRadiusSolvesItsEquation)
{
  expectContactRadius<double>(Precision::Double, 64);
  expectContactRadius<float>(Precision::Mixed, 64);
}

TEST(Jkr, ForceFollowsFromTheContactRadius)
{
  for (const double young : youngs)
    for (const double gamma : gammas)
      for (const double radius : radii) {
        const ContactModel m = adhesive("jkr", young, gamma);
        const double gap = pullOffGap(m, radius), e = effectiveYoung(young);
        for (const double overlap : {-0.9 * gap, -0.3 * gap, 1e-6 * radius, 1e-3 * radius, 0.05 * radius}) {
          if (gamma == 0.0 && overlap <= 0.0) continue;
          const double a = jkrContactRadius(overlap, radius, gamma, e);
          const double load = 4.0 * e * a * a * a / (3.0 * radius);
          const double pull = a > 0.0 ? 2.0 * circle * a * a * std::sqrt(4.0 * gamma * e / (circle * a)) : 0.0;
          ASSERT_TRUE(near(forceOf<JkrNormal, double>(m, overlap, radius).elastic, load - pull,
                           roundOff(Precision::Double, load + pull, 1e3)));
          ASSERT_TRUE(near(forceOf<JkrNormal, float>(m, overlap, radius).elastic, load - pull,
                           roundOff(Precision::Mixed, load + pull, 1e3)));
        }
      }
}

/// The pull grows along the neck to 3 pi gamma R*, where a contact under load parts; there is the gap. (Held by its
/// position instead of a load, it would live on to a wider gap under a falling force.)
TEST(Jkr, PullOffForceAndGap)
{
  for (const double young : youngs)
    for (const double gamma : {1e-3, 0.05, 1.0, 30.0})
      for (const double radius : radii) {
        const ContactModel m = adhesive("jkr", young, gamma);
        const double expected = 3.0 * circle * gamma * radius, e = effectiveYoung(young), gap = pullOffGap(m, radius);
        const double a = std::cbrt(9.0 * circle * gamma * radius * radius / (4.0 * e));  // manual of LAMMPS, with E*
        const double longHandGap = 2.0 * std::sqrt(circle * gamma * a / e) - a * a / radius;
        EXPECT_TRUE(near(gap, longHandGap, roundOff(Precision::Double, longHandGap)));
        EXPECT_TRUE(near((JkrNormal::gap(coefficients<float>(m), static_cast<float>(radius))), gap,
                         roundOff(Precision::Mixed, gap)));
        double pull = 0.0;
        for (int n = 0; n <= 100; ++n) {
          const NormalForce<double> f = forceOf<JkrNormal, double>(m, -gap * n / 100, radius);
          EXPECT_LE(pull, -f.elastic * (1.0 + 1e-12)) << "grows towards the end";
          EXPECT_TRUE(near(f.pullOff, expected, roundOff(Precision::Double, expected)));
          pull = -f.elastic;
        }
        EXPECT_TRUE(near(pull, expected, roundOff(Precision::Double, expected, 64)));
        EXPECT_TRUE(near((forceOf<JkrNormal, double>(m, -1.001 * gap, radius).elastic), -expected, {1e-5, expected}))
            << "the extremum";
        EXPECT_TRUE(near((forceOf<JkrNormal, double>(m, 0.0, radius).elastic), -8.0 / 9.0 * expected,
                         roundOff(Precision::Double, expected, 64)))
            << "at touch";
      }
}

TEST(Jkr, WithoutAdhesionIsHertz)
{
  for (const double young : youngs) {
    const ContactModel m = adhesive("jkr", young, 0.0);
    EXPECT_EQ(pullOffGap(m, 0.5), 0.0);
    for (const double overlap : {1e-8, 1e-5, 1e-2}) {
      const double hertz = 4.0 / 3.0 * effectiveYoung(young) * std::sqrt(0.5) * std::pow(overlap, 1.5);
      EXPECT_TRUE(
          near((forceOf<JkrNormal, double>(m, overlap, 0.5).elastic), hertz, roundOff(Precision::Double, hertz)));
      EXPECT_TRUE(near((forceOf<JkrNormal, float>(m, overlap, 0.5).elastic), hertz, roundOff(Precision::Mixed, hertz)));
    }
    EXPECT_EQ((forceOf<JkrNormal, double>(m, -1e-9, 0.5).elastic), 0.0);
    const ContactModel faint = adhesive("jkr", young, 1e-14);  // adhesion that float cannot see
    const double hertz = 4.0 / 3.0 * effectiveYoung(young) * std::sqrt(0.5) * 1e-3;
    EXPECT_TRUE(
        near((forceOf<JkrNormal, float>(faint, 1e-2, 0.5).elastic), hertz, roundOff(Precision::Mixed, hertz, 64)));
  }
}

TEST(Dmt, PullOffForceIsFourPiGammaRadius)
{
  for (const double gamma : {0.0, 0.05, 3.0})
    for (const double radius : radii) {
      const ContactModel m = adhesive("dmt", 1e7, gamma);
      const double expected = 4.0 * circle * gamma * radius;
      const NormalForce<double> f = forceOf<DmtNormal, double>(m, 0.0, radius);
      EXPECT_TRUE(near(-f.elastic, expected, roundOff(Precision::Double, expected)));
      EXPECT_TRUE(near(f.pullOff, expected, roundOff(Precision::Double, expected)));
      EXPECT_EQ(pullOffGap(m, radius), 0.0);
      EXPECT_FALSE(reachesBeyondTouch(m));
    }
}

}  // namespace
