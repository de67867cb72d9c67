// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Materials, what is measured of two of them, and the contact law that follows. Units are the caller's.
#pragma once

#include "gpudem/contact_model.h"

#include <cmath>
#include <string>
#include <vector>

namespace gpudem {

/// An elastic material.
struct Material {
  double young = 0.0;    ///< E (pressure)
  double poisson = 0.0;  ///< nu
  double density = 0.0;  ///< (mass/volume), 0 if it is not known: no law but rolling and twisting needs it
};

/// What is measured of two materials and follows from neither.
struct MaterialPair {
  double restitution = 0.0;    ///< e of a head-on impact without adhesion
  double friction = 0.0;       ///< mu
  double rolling = 0.0;        ///< mu_r: the rolling torque is at most mu_r R* F_n0
  double twisting = 0.0;       ///< (distance) the twisting torque is at most this times F_n0
  double surfaceEnergy = 0.0;  ///< gamma (energy/distance^2), half of the work of adhesion
};

/// Which sub-models are made of materials. The springs of rolling and twisting are constants, where those of Hertz and
/// Mindlin grow with the contact: they are taken at a reference contact, the largest overlap of a head-on impact.
struct MaterialLaw {
  std::string normal;  ///< empty: jkr where the pair has a surface energy, else hertz/material
  std::string tangential = "mindlin";
  std::string rolling = "sds";     ///< none: the pairs' rolling numbers are not used
  std::string twisting = "sds";    ///< none: the pairs' twisting numbers are not used
  bool limitDamping = false;       ///< as in ContactModel
  double tangentialDamping = NAN;  ///< xgt; not-a-number: tangentialDampingRatio()
  double radius = 0.0;             ///< of the two grains of the reference contact (distance)
  double speed = 0.0;              ///< of their impact (distance/time)
};

/// The sub-models of \p slot that a law made of materials can have.
const std::vector<std::string> &materialNames(ModelSlot slot);

/// A number of \p Of: its word and range, and whether it must be given.
template <class Of>
struct NumberOf {
  ParameterInfo info;
  double Of::*value;
  bool needed;
};
const std::vector<NumberOf<Material>> &materialNumbers();
const std::vector<NumberOf<MaterialPair>> &pairNumbers();
const std::vector<NumberOf<MaterialLaw>> &lawNumbers();

/// 1/E* = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b, 1/G* = (2 - nu_a)/G_a + (2 - nu_b)/G_b with G = E/(2 (1 + nu)).
ContactModuli contactModuli(const Material &a, const Material &b);

/// Ratio xgt of the tangential to the normal dashpot for which both directions have the same part of critical damping:
/// sqrt(k_t/k_n) = 2 sqrt(G*/E*), with the stiffnesses k_n = 2 E* a and k_t = 8 G* a of Hertz and Mindlin. For one
/// material this is sqrt(2 (1 - nu)/(2 - nu)).
double tangentialDampingRatio(const ContactModuli &moduli);

enum class Partner { Grain, Wall };

/// Contact radius (distance) at the largest overlap of an impact of law.speed between grains of law.radius, or of one
/// with a plane wall.
double referenceContactRadius(const Material &a, const Material &b, const MaterialLaw &law, Partner partner);

/// The law of material \p a against \p b.
/// \throws Error naming what is out of range, missing, or contradicts
ContactModel materialModel(const Material &a, const Material &b, const MaterialPair &pair, const MaterialLaw &law,
                           Partner partner = Partner::Grain);

}  // namespace gpudem
