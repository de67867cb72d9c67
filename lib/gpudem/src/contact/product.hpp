// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A contact law as the product of six sub-models. Conventions of LAMMPS' pair_style granular:
///
///   F_n = F_ne - eta v_n;  the Coulomb limit counts from |F_n|, with adhesion from |F_ne + 2 F_pulloff|;
///   slip velocity with radii R - slipLever delta, 0 but for LIGGGHTS' convention; torque arm R - lever delta.
///
/// A cohesion sub-model adds its force to F_n. The Coulomb limit leaves it out, or counts from the sum: CoulombBase.
/// Where it outlives touch, the other sub-models act in touch only, and forget when the surfaces part.
#pragma once

#include "contact/any_model.hpp"

#include <type_traits>

namespace gpudem {

/// Normal force with damping, and what the frictional sub-models take from it.
template <class Real>
struct DampedNormal {
  Real push;  ///< F_n, repulsion positive
  Real base;  ///< normal force that Coulomb limits count from
  Real eta;   ///< coefficient of the normal dashpot (force time/distance)
};

template <class D, class Real>
GPUDEM_HD DampedNormal<Real> dampNormal(const ModelCoefficients<Real> &k, Real mass, Real normalRate,
                                        const NormalForce<Real> &f)
{
  DampedNormal<Real> d;
  d.eta = D::coefficient(k, mass, f);
  d.push = f.elastic - d.eta * normalRate;
  d.push = k.limitDamping && d.push < Real(0) ? Real(0) : d.push;
  d.base = absolute(f.adhesive ? f.elastic + Real(2) * f.pullOff : d.push);
  return d;
}

/// Add the force of the cohesion sub-model (repulsion positive).
template <class Real>
GPUDEM_HD void addCohesion(const ModelCoefficients<Real> &k, Real cohesion, DampedNormal<Real> &d)
{
  d.push += cohesion;
  d.base = k.netBase ? absolute(d.push) : d.base;
}

/// Do the sub-models other than cohesion act at this overlap?
template <class Real>
GPUDEM_HD bool surfacesAct(const ModelCoefficients<Real> &k, Real overlap)
{
  return overlap >= Real(0) || k.necks;
}

/// Everything one evaluation yields; the step reads sum(), output of single contacts reads the parts.
template <class Real>
struct ContactParts {
  ContactFrame<Real> frame;
  DampedNormal<Real> normal;  ///< cohesion included
  Vec3<Real> friction, rolling;
  Real twisting;
};

template <class N, class D, class T, class R, class W, class C = NoCohesion>
struct Product {
  static constexpr bool beyondTouch = N::beyondTouch || C::beyondTouch, beforeTouch = C::beforeTouch;
  static constexpr bool coheres = !std::is_same<C, NoCohesion>::value;
  /// Only the law whose members are chosen at run time shortens the arm of the slip velocity.
  static constexpr bool takesSlipLever = std::is_same<T, AnyTangential>::value;
  static constexpr bool takesInertia = R::takesInertia;
  static constexpr bool takesSpinDifference =
      takesSlipLever || !std::is_same<R, NoRolling>::value || !std::is_same<W, NoTwisting>::value;
  static constexpr int history[modelSlots] = {N::history, 0, T::history, R::history, W::history, C::history};

  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real effectiveRadius)
  {
    const Real neck = N::gap(k, effectiveRadius), bridge = C::gap(k, effectiveRadius);
    return neck > bridge ? neck : bridge;
  }

  template <class Real>
  GPUDEM_HD static ContactParts<Real> parts(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                            ModelHistory<Real> &h, Real dt, bool advance)
  {
    ContactParts<Real> p{};
    p.frame = contactFrame(c, takesSlipLever ? shortenedSpin(c, k.slipLever) : c.surfaceSpin);
    const Real cohesion = C::force(k, c, h.cohesion);
    if (C::beyondTouch && !surfacesAct(k, c.overlap)) {
      p.normal.push = cohesion;
      forgetTouch(h);
      return p;
    }
    const NormalForce<Real> f = N::force(k, c, h.normal);
    p.normal = dampNormal<D>(k, c.effectiveMass, p.frame.normalRate, f);
    if (coheres) addCohesion(k, cohesion, p.normal);
    const Real a = f.contactRadius, eta = p.normal.eta, base = p.normal.base;
    p.friction = T::force(k, p.frame, a, eta, base, h.tangential, dt, advance);
    const TangentialStiffness<Real> t = T::stiffness(k, a, eta);
    p.rolling = R::moment(k, c, p.frame, f, t, base, h.rolling, dt, advance);
    p.twisting = W::torque(k, c, p.frame, a, t, base, h.twisting, dt, advance);
    return p;
  }

  template <class Real>
  GPUDEM_HD static ContactForce<Real> evaluate(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                               ModelHistory<Real> &h, Real dt, bool advance)
  {
    const ContactParts<Real> p = parts(k, c, h, dt, advance);
    const Vec3<Real> n = p.frame.normal;
    return {n * p.normal.push + p.friction, cross(n, p.friction), p.rolling + n * p.twisting, k.lever * c.overlap};
  }

 private:
  template <class Real>
  GPUDEM_HD static void forgetTouch(ModelHistory<Real> &h)
  {
    for (int d = 0; d < N::history; ++d) h.normal[d] = Real(0);
    for (int d = 0; d < T::history; ++d) h.tangential[d] = Real(0);
    for (int d = 0; d < R::history; ++d) h.rolling[d] = Real(0);
    for (int d = 0; d < W::history; ++d) h.twisting[d] = Real(0);
  }
};

/// The law whose members are all chosen at run time.
using AnyProduct = Product<AnyNormal, AnyDamping, AnyTangential, AnyRolling, AnyTwisting, AnyCohesion>;

}  // namespace gpudem
