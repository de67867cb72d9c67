// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The two families of contact laws as the step sees them: what to gather, what to keep, what to evaluate.
#pragma once

#include "contact/layout.hpp"
#include "contact/product.hpp"
#include "step/step_view.hpp"

namespace gpudem {

/// Law of LAMMPS' gran/ styles, the same for all types.
template <NormalModel normal, TangentialModel tangential>
struct ClassicLaw {
  static constexpr int numbers = tangential == TangentialModel::Spring ? 3 : 0;  ///< most numbers a contact keeps
  static constexpr bool beyondTouch = false;
  static constexpr bool takesRadius = normal == NormalModel::Hertz;  ///< reads the effective radius
  static constexpr bool takesSpinDifference = false;
  static constexpr bool torques = tangential != TangentialModel::None;  ///< contacts turn the grains
  static constexpr bool moments = false;  ///< torques without an arm, and arms shorter than the radius
  using WallProduct = AnyProduct;          ///< of walls in WallUse::Same

  template <class Real>
  using Coefficients = LawCoefficients<Real>;
  template <class Real>
  using History = Vec3<Real>;

  /// Does the table remember which pairs are in contact?
  template <class P>
  GPUDEM_HD static constexpr bool keeps(const StepView<P> &)
  {
    return tangential == TangentialModel::Spring;
  }
  /// Number of the pair's coefficients.
  template <class P>
  GPUDEM_HD static std::uint32_t kind(const StepView<P> &, std::uint32_t, std::uint32_t)
  {
    return 0;
  }
  template <class P>
  GPUDEM_HD static const LawCoefficients<typename P::Real> &coefficients(const StepView<P> &s, std::uint32_t)
  {
    return s.law;
  }
  template <class P>
  GPUDEM_HD static int historySize(const StepView<P> &)
  {
    return 3;
  }
  template <class P>
  GPUDEM_HD static Vec3<typename P::Real> load(const StepView<P> &, const typename P::Real *slot)
  {
    return {slot[0], slot[1], slot[2]};
  }
  template <class P>
  GPUDEM_HD static void store(const StepView<P> &, const Vec3<typename P::Real> &h, typename P::Real *slot)
  {
    slot[0] = h.x;
    slot[1] = h.y;
    slot[2] = h.z;
  }
  template <class Real>
  GPUDEM_HD static ContactForce<Real> evaluate(const LawCoefficients<Real> &k, const Contact<Real> &c, Vec3<Real> &h,
                                               Real dt, bool advance)
  {
    return springDashpot<normal, tangential>(k, c, h, dt, advance);
  }
  template <class P>
  GPUDEM_HD static constexpr bool takesInertia(const StepView<P> &)
  {
    return false;
  }
  template <class P>
  GPUDEM_HD static constexpr bool beforeTouch(const StepView<P> &, std::uint32_t)
  {
    return false;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const LawCoefficients<Real> &, Real, Real)
  {
    return Real(0);
  }
};

/// Product of sub-models, with coefficients per pair of types.
template <class Members>
struct ModelLaw {
  static constexpr int numbers =
      maxNormalHistory + maxTangentialHistory + maxRollingHistory + maxTwistingHistory + maxCohesionHistory;
  static constexpr bool beyondTouch = Members::beyondTouch;
  static constexpr bool takesRadius = true;
  static constexpr bool takesSpinDifference = Members::takesSpinDifference;
  static constexpr bool torques = true;
  static constexpr bool moments = true;
  using WallProduct = Members;

  template <class Real>
  using Coefficients = ModelCoefficients<Real>;
  template <class Real>
  using History = ModelHistory<Real>;

  template <class P>
  GPUDEM_HD static bool keeps(const StepView<P> &s)
  {
    return s.keeps;
  }
  template <class P>
  GPUDEM_HD static std::uint32_t kind(const StepView<P> &s, std::uint32_t i, std::uint32_t j)
  {
    return s.types > 1 ? static_cast<std::uint32_t>((s.type[i] - 1) * s.types + s.type[j] - 1) : 0u;
  }
  template <class P>
  GPUDEM_HD static const ModelCoefficients<typename P::Real> &coefficients(const StepView<P> &s, std::uint32_t kind)
  {
    return s.models[kind];
  }
  template <class P>
  GPUDEM_HD static int historySize(const StepView<P> &s)
  {
    return s.layout.size;
  }
  template <class P>
  GPUDEM_HD static ModelHistory<typename P::Real> load(const StepView<P> &s, const typename P::Real *slot)
  {
    using Real = typename P::Real;
    ModelHistory<Real> h{};
    moveHistory<Members>(s.layout, h, [&](Real &inRegister, int at) { inRegister = slot[at]; });
    return h;
  }
  template <class P>
  GPUDEM_HD static void store(const StepView<P> &s, ModelHistory<typename P::Real> &h, typename P::Real *slot)
  {
    using Real = typename P::Real;
    moveHistory<Members>(s.layout, h, [&](Real &inRegister, int at) { slot[at] = inRegister; });
  }
  template <class Real>
  GPUDEM_HD static ContactForce<Real> evaluate(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                               ModelHistory<Real> &h, Real dt, bool advance)
  {
    return Members::evaluate(k, c, h, dt, advance);
  }
  template <class P>
  GPUDEM_HD static bool takesInertia(const StepView<P> &s)
  {
    return Members::takesInertia && s.needs.inertia;
  }
  /// Are two grains in contact as soon as they are within the gap?
  template <class P>
  GPUDEM_HD static bool beforeTouch(const StepView<P> &s, std::uint32_t kind)
  {
    return Members::beforeTouch && s.needs.beforeTouch && s.models[kind].beforeTouch;
  }
  /// Gap across which two grains that were in contact still hold together (distance).
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real radius, Real radius2)
  {
    return Members::gap(k, divide(radius * radius2, radius + radius2));
  }
};

}  // namespace gpudem
