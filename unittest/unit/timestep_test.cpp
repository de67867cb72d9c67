// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Characteristic times against closed forms.

#include "gpudem/errors.h"
#include "gpudem/timestep.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace gpudem;

namespace {

constexpr double pi = 3.14159265358979323846;

HeadOnImpact springImpact(double gamma)
{
  ContactLaw law;
  law.normalStiffness = 2e4;
  law.normalDamping = gamma;
  HeadOnImpact impact;
  impact.model = headOnModel(law);
  impact.mass = 0.5;
  impact.partnerMass = 0.7;
  impact.radius = 0.4;
  impact.partnerRadius = 0.5;
  impact.speed = 1.3;
  return impact;
}

HeadOnImpact hertzImpact(double restitution)
{
  HeadOnImpact impact;
  impact.model.normal = {"hertz/material", {1e7, restitution, 0.3}};
  impact.model.damping = {"tsuji", {}};
  impact.model.tangential = {"linear_nohistory", {0.0, 0.0}};
  impact.mass = 1e-4;
  impact.radius = 2e-3;
  impact.speed = 2.0;
  return impact;
}

TEST(Timestep, RayleighTime)
{
  // glass, R 1 mm: G = 48 GPa/2.4, rho 2500, nu 0.2
  EXPECT_NEAR(rayleighTime(1e-3, 2500.0, 48e9, 0.2), pi * 1e-3 * std::sqrt(2500.0 / 20e9) / 0.90922, 1e-12);
  EXPECT_NEAR(rayleighTime(1e-3, 2500.0, 48e9, 0.2, 4.0), 0.5 * rayleighTime(1e-3, 2500.0, 48e9, 0.2), 1e-15);
}

TEST(Timestep, SpringDashpotContactLastsPiOverOmega)
{
  const double mass = 0.5 * 0.7 / 1.2;
  for (const double gamma : {0.0, 50.0, 200.0}) {
    const ImpactResult r = resolveImpact(springImpact(gamma));
    const double omega = std::sqrt(2e4 / mass - 0.25 * gamma * gamma);
    EXPECT_NEAR(r.duration / (pi / omega), 1.0, 1e-3) << gamma;
    EXPECT_NEAR(r.rebound, std::exp(-0.5 * gamma * pi / omega), 1e-3) << gamma;
    EXPECT_GT(r.steps, 1000);
  }
}

TEST(Timestep, ElasticHertzContactLastsTheHertzTime)
{
  HeadOnImpact impact = hertzImpact(1.0);
  const double young = 1e7 / (2.0 * (1.0 - 0.09));  // E* of two bodies
  const double time = hertzTime(impact.mass, impact.radius, young, impact.speed);
  const ImpactResult r = resolveImpact(impact);
  EXPECT_NEAR(r.duration / time, 1.0, 3e-3);
  EXPECT_NEAR(r.rebound, 1.0, 1e-4);
  const double overlap = std::pow(15.0 * impact.mass * impact.speed * impact.speed / (16.0 * young * std::sqrt(impact.radius)), 0.4);
  EXPECT_NEAR(r.largestOverlap / overlap, 1.0, 1e-3);
  impact.acceleration = 4.0;
  EXPECT_NEAR(resolveImpact(impact).duration / r.duration, std::pow(4.0, -0.4), 3e-3);
}

TEST(Timestep, RestitutionComesOut)
{
  for (const double e : {0.2, 0.5, 0.9}) EXPECT_NEAR(resolveImpact(hertzImpact(e)).rebound, e, 2e-3) << e;
}

/// Velocity Verlet is of third order for an elastic spring whose contact begins anywhere in a step, of first order
/// with a dashpot that sees the velocity of the half step.
TEST(Timestep, ProposalsKeepTheErrorAndItsOrder)
{
  for (const double gamma : {0.0, 100.0}) {
    const HeadOnImpact impact = springImpact(gamma);
    const ImpactResult exact = resolveImpact(impact);
    const double coarse = timestepForError(impact, 1e-3), fine = timestepForError(impact, 1e-4);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(10.0), gamma == 0.0 ? 1.0 / 3.0 : 1.0, 0.15) << gamma;
    double sum = 0.0;
    for (int p = 0; p < 50; ++p) sum += std::pow(integrateImpact(impact, fine, (p + 0.5) / 50).rebound - exact.rebound, 2);
    EXPECT_LT(std::sqrt(sum / 50), 1.2e-4) << gamma;
    EXPECT_GT(std::sqrt(sum / 50), 1e-5) << gamma;
  }
}

TEST(Timestep, GrainsThatStickEnd)
{
  HeadOnImpact impact = hertzImpact(0.1);
  impact.model.normal = {"jkr", {1e7, 0.1, 0.3, 5.0}};
  impact.speed = 0.01;
  const ImpactResult r = resolveImpact(impact);
  EXPECT_EQ(r.rebound, 0.0);
  EXPECT_GT(r.duration, 0.0);
  EXPECT_GE(timestepForError(impact, 0.01), 0.0);
}

TEST(Timestep, NothingMovesAtNoSpeed)
{
  HeadOnImpact impact = springImpact(0.0);
  impact.speed = 0.0;
  EXPECT_THROW(resolveImpact(impact), Error);
}

}  // namespace
