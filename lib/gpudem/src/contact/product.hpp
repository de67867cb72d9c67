// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A contact law as the product of five sub-models. Conventions of LAMMPS' pair_style granular:
///
///   F_n = F_ne - eta v_n;  the Coulomb limit counts from |F_n|, with adhesion from |F_ne + 2 F_pulloff|;
///   slip velocity with full radii; torque arm R - lever delta.
#pragma once

#include "contact/any_model.hpp"

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

/// Everything one evaluation yields; the step reads sum(), output of single contacts reads the parts.
template <class Real>
struct ContactParts {
  ContactFrame<Real> frame;
  DampedNormal<Real> normal;
  Vec3<Real> friction, rolling;
  Real twisting;
};

template <class N, class D, class T, class R, class W>
struct Product {
  static constexpr bool beyondTouch = N::beyondTouch;
  static constexpr int history[modelSlots] = {N::history, 0, T::history, R::history, W::history};

  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real effectiveRadius)
  {
    return N::gap(k, effectiveRadius);
  }

  template <class Real>
  GPUDEM_HD static ContactParts<Real> parts(const ModelCoefficients<Real> &k, const Contact<Real> &c,
                                            ModelHistory<Real> &h, Real dt, bool advance)
  {
    ContactParts<Real> p;
    p.frame = contactFrame(c);
    const NormalForce<Real> f = N::force(k, c, h.normal);
    p.normal = dampNormal<D>(k, c.effectiveMass, p.frame.normalRate, f);
    const Real a = f.contactRadius, eta = p.normal.eta, base = p.normal.base;
    p.friction = T::force(k, p.frame, a, eta, base, h.tangential, dt, advance);
    p.rolling = R::moment(k, c, p.frame, f, base, h.rolling, dt, advance);
    p.twisting = W::torque(k, c, p.frame, a, T::stiffness(k, a, eta), base, h.twisting, dt, advance);
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
};

/// The law whose members are all chosen at run time.
using AnyProduct = Product<AnyNormal, AnyDamping, AnyTangential, AnyRolling, AnyTwisting>;

}  // namespace gpudem
