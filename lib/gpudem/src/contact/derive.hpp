// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From the parameters of a ContactModel to the coefficients of the step. Host code.
#pragma once

#include "contact/coefficients.hpp"

namespace gpudem {

/// \throws Error for unknown names, wrong numbers of parameters and values out of range
ModelCoefficients<double> deriveCoefficients(const ContactModel &model);

/// Index of \p name in the list of its slot.
int modelIndex(ModelSlot slot, const std::string &name);

template <class Real>
ModelCoefficients<Real> coefficients(const ContactModel &model)
{
  const ModelCoefficients<double> d = deriveCoefficients(model);
  ModelCoefficients<Real> k{};
  for (int n = 0; n < maxNormalCoefficients; ++n) k.normal[n] = static_cast<Real>(d.normal[n]);
  for (int n = 0; n < maxCoefficients; ++n) {
    k.tangential[n] = static_cast<Real>(d.tangential[n]);
    k.rolling[n] = static_cast<Real>(d.rolling[n]);
    k.twisting[n] = static_cast<Real>(d.twisting[n]);
    k.cohesion[n] = static_cast<Real>(d.cohesion[n]);
  }
  k.damping = static_cast<Real>(d.damping);
  k.lever = static_cast<Real>(d.lever);
  k.slipLever = static_cast<Real>(d.slipLever);
  for (int s = 0; s < modelSlots; ++s) k.model[s] = d.model[s];
  k.limitDamping = d.limitDamping;
  k.netBase = d.netBase;
  k.necks = d.necks;
  k.beforeTouch = d.beforeTouch;
  k.readsInertia = d.readsInertia;
  return k;
}

}  // namespace gpudem
