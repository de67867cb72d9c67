// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Members that choose the sub-model at run time: for contacts that are few (walls), for scenes whose type pairs
/// differ in their sub-models, and for products that have no kernel of their own.
#pragma once

#include "contact/sub_models.hpp"

namespace gpudem {

struct AnyNormal {
  static constexpr bool beyondTouch = true;
  static constexpr int history = maxNormalHistory;
  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    return selectModel<NormalForce<Real>>(NormalModels{}, k.model[static_cast<int>(ModelSlot::Normal)],
                                          [&](auto m) { return decltype(m)::force(k, c, history); });
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real effectiveRadius)
  {
    return selectModel<Real>(NormalModels{}, k.model[static_cast<int>(ModelSlot::Normal)],
                             [&](auto m) { return decltype(m)::gap(k, effectiveRadius); });
  }
};

struct AnyDamping {
  template <class Real>
  GPUDEM_HD static Real coefficient(const ModelCoefficients<Real> &k, Real mass, const NormalForce<Real> &f)
  {
    return selectModel<Real>(DampingModels{}, k.model[static_cast<int>(ModelSlot::Damping)],
                             [&](auto m) { return decltype(m)::coefficient(k, mass, f); });
  }
};

struct AnyTangential {
  static constexpr int history = maxTangentialHistory;
  template <class Real>
  GPUDEM_HD static Vec3<Real> force(const ModelCoefficients<Real> &k, const ContactFrame<Real> &f, Real a, Real eta,
                                    Real base, Real *history, Real dt, bool advance)
  {
    return selectModel<Vec3<Real>>(TangentialModels{}, k.model[static_cast<int>(ModelSlot::Tangential)], [&](auto m) {
      return decltype(m)::force(k, f, a, eta, base, history, dt, advance);
    });
  }
  template <class Real>
  GPUDEM_HD static TangentialStiffness<Real> stiffness(const ModelCoefficients<Real> &k, Real a, Real eta)
  {
    return selectModel<TangentialStiffness<Real>>(TangentialModels{}, k.model[static_cast<int>(ModelSlot::Tangential)],
                                                  [&](auto m) { return decltype(m)::stiffness(k, a, eta); });
  }
};

struct AnyRolling {
  static constexpr int history = maxRollingHistory;
  static constexpr bool takesInertia = true;
  template <class Real>
  GPUDEM_HD static Vec3<Real> moment(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                     const ContactFrame<Real> &f, const NormalForce<Real> &n,
                                     const TangentialStiffness<Real> &t, Real base, Real *history, Real dt,
                                     bool advance)
  {
    return selectModel<Vec3<Real>>(RollingModels{}, k.model[static_cast<int>(ModelSlot::Rolling)], [&](auto m) {
      return decltype(m)::moment(k, c, f, n, t, base, history, dt, advance);
    });
  }
};

struct AnyTwisting {
  static constexpr int history = maxTwistingHistory;
  template <class Real>
  GPUDEM_HD static Real torque(const ModelCoefficients<Real> &k, const Contact<Real> &c, const ContactFrame<Real> &f,
                               Real a, const TangentialStiffness<Real> &t, Real base, Real *history, Real dt,
                               bool advance)
  {
    return selectModel<Real>(TwistingModels{}, k.model[static_cast<int>(ModelSlot::Twisting)],
                             [&](auto m) { return decltype(m)::torque(k, c, f, a, t, base, history, dt, advance); });
  }
};

struct AnyCohesion {
  static constexpr bool beyondTouch = true, beforeTouch = true;
  static constexpr int history = maxCohesionHistory;
  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    return selectModel<Real>(CohesionModels{}, k.model[static_cast<int>(ModelSlot::Cohesion)],
                             [&](auto m) { return decltype(m)::force(k, c, history); });
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real effectiveRadius)
  {
    return selectModel<Real>(CohesionModels{}, k.model[static_cast<int>(ModelSlot::Cohesion)],
                             [&](auto m) { return decltype(m)::gap(k, effectiveRadius); });
  }
};

}  // namespace gpudem
