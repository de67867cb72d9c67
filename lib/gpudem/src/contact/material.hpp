// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The reference contact, at which the constant springs of rolling and twisting are taken. Host code.
#pragma once

#include "gpudem/material.h"

namespace gpudem {

/// Two grains of one radius, or one and a plane wall, at the largest overlap of a head-on elastic impact:
///
///   delta = (15 m* v^2/(16 sqrt(R*) E*))^(2/5),   a = sqrt(R* delta).    Johnson, Contact Mechanics (1985), 11.4.
struct ReferenceContact {
  double effectiveRadius = 0.0;  ///< R* (distance)
  double effectiveMass = 0.0;    ///< m*
  double contactRadius = 0.0;    ///< a (distance)
  double slipStiffness = 0.0;    ///< 8 G* a (force/distance)
};
/// \throws Error if radius, speed or a density is not known
ReferenceContact referenceContact(const Material &a, const Material &b, const MaterialLaw &law, Partner partner);

/// Parameters k, gamma, mu of rolling sds. k = 8 G* a: the rolling spring is as stiff as the slip spring (Iwashita and
/// Oda, J. Eng. Mech. 124 (1998) 285). gamma = 2 beta sqrt(k m_r), beta being the part of critical damping of the
/// restitution and m_r the inertia about the point of contact, 7/5 m R^2 each, over R*^2 (Ai, Chen, Rotter and Ooi,
/// Powder Technol. 206 (2011) 269).
std::vector<double> rollingParameters(const ReferenceContact &contact, const MaterialPair &pair, Partner partner);

/// Parameters k, gamma, mu of twisting sds. k = 8 G* a a^2/2, the spring of slip over the contact (Marshall, J. Comput.
/// Phys. 228 (2009) 1541); gamma = 2 beta sqrt(k I) with the inertia 2/5 m R^2 each about the normal.
std::vector<double> twistingParameters(const ReferenceContact &contact, const MaterialPair &pair, double radius);

}  // namespace gpudem
