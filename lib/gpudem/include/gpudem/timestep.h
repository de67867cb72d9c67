// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file How long a time step may be: characteristic times of grains and contacts.
#pragma once

#include "gpudem/contact_model.h"
#include "gpudem/scene.h"

namespace gpudem {

/// Time of a Rayleigh wave over a grain, pi R sqrt(rho/G)/(0.1631 nu + 0.8766) (Li, Xu and Thornton, Powder Technol.
/// 160 (2005) 219).
/// \param radius (distance) \param density (mass/volume) \param young, poisson of the material (force/area; -)
/// \param acceleration per force/mass: 1 in consistent units
double rayleighTime(double radius, double density, double young, double poisson, double acceleration = 1.0);

/// Duration of an elastic Hertz contact, 2.87 (m*^2/(R* E*^2 v))^(1/5) (Johnson, Contact Mechanics, Cambridge 1985,
/// section 11.4).
double hertzTime(double effectiveMass, double effectiveRadius, double effectiveYoung, double speed,
                 double acceleration = 1.0);

/// The law of a gran/ style as a product of sub-models, as far as head-on impacts go.
ContactModel headOnModel(const ContactLaw &law);

/// Two grains, or a grain and a wall, that meet head-on.
struct HeadOnImpact {
  ContactModel model;
  double mass = 0, partnerMass = 0;      ///< partner 0: a wall
  double radius = 0, partnerRadius = 0;  ///< partner 0: a wall (distance)
  double speed = 0;                      ///< of approach (distance/time)
  double acceleration = 1.0;             ///< per force/mass
};

struct ImpactResult {
  double duration = 0;     ///< of the contact; if the grains stick, twice the time to the largest overlap (time)
  double rebound = 0;      ///< speed afterwards over speed before, 0 if they stick
  double largestOverlap = 0;  ///< (distance)
  int steps = 0;           ///< in contact
};

/// The impact by velocity Verlet as LAMMPS integrates it: dashpots see the velocity of the half step.
/// \param dt time step \param phase where in its step the contact begins, 0 to 1
/// \throws Error if the grains neither part nor come to rest within 10^6 steps
ImpactResult integrateImpact(const HeadOnImpact &impact, double dt, double phase);

/// The impact with some 4000 steps.
ImpactResult resolveImpact(const HeadOnImpact &impact);

/// Largest time step for which the speed after the impact is off by less than \p error of the speed before (root mean
/// square over where in a step the contact begins), at this and all smaller steps; 0 if a two-thousandth of the
/// duration is still too large.
double timestepForError(const HeadOnImpact &impact, double error);

}  // namespace gpudem
