// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Pairs in contact on the CPU, one array per quantity, and the contact law over all of them.
#pragma once

#include "step/pair_contact.hpp"

namespace gpudem {

constexpr std::uint32_t batchCapacity = 128;  ///< pairs in a batch
/// Length of the arrays: they must not all start in the same set of the L1 cache.
constexpr int batchStride = batchCapacity + 16;

/// What the law is given and returns, of every pair.
template <class Law, class Real>
struct ContactBatch {
  int size = 0;
  std::uint32_t pair[batchStride];
  Real radius[batchStride], radius2[batchStride];
  Real bx[batchStride], by[batchStride], bz[batchStride], room2[batchStride], reach[batchStride];
  Real product[batchStride], sum[batchStride], vx[batchStride], vy[batchStride], vz[batchStride];
  Real wx[batchStride], wy[batchStride], wz[batchStride];
  Real fx[batchStride], fy[batchStride], fz[batchStride], cx[batchStride], cy[batchStride], cz[batchStride];
  Real kept[Law::numbers > 0 ? Law::numbers : 1][batchStride];  ///< what the contact keeps, in the order of memory
  // laws of sub-models
  static constexpr int models = Law::moments ? batchStride : 1;
  std::uint32_t kind[models];
  Real rx[models], ry[models], rz[models];  ///< difference of the spins
  Real inertia[models];                     ///< for laws that take it
  Real mx[models], my[models], mz[models], shorter[models];

  /// Whole vectors: what lies behind the last pair is whatever the memory holds, and nobody reads the result.
  int padded() const { return (size + 15) / 16 * 16; }

  GatheredPair<Real> gathered(int n) const
  {
    GatheredPair<Real> g{};
    g.branch = {bx[n], by[n], bz[n]};
    g.room2 = room2[n];
    g.reach = reach[n];
    g.massProduct = product[n];
    g.massSum = sum[n];
    g.radius = radius[n];
    g.radius2 = radius2[n];
    g.relativeVelocity = {vx[n], vy[n], vz[n]};
    g.surfaceSpin = {wx[n], wy[n], wz[n]};
    if (Law::takesSpinDifference) g.spinDifference = {rx[n], ry[n], rz[n]};
    return g;
  }

  /// Append the pair \p k; it counts once size is raised.
  void put(std::uint32_t k, std::uint32_t kindOfPair, const GatheredPair<Real> &g)
  {
    const int n = size;
    pair[n] = k;
    radius[n] = g.radius;
    radius2[n] = g.radius2;
    bx[n] = g.branch.x;
    by[n] = g.branch.y;
    bz[n] = g.branch.z;
    room2[n] = g.room2;
    reach[n] = g.reach;
    product[n] = g.massProduct;
    sum[n] = g.massSum;
    vx[n] = g.relativeVelocity.x;
    vy[n] = g.relativeVelocity.y;
    vz[n] = g.relativeVelocity.z;
    wx[n] = g.surfaceSpin.x;
    wy[n] = g.surfaceSpin.y;
    wz[n] = g.surfaceSpin.z;
    if (Law::moments) kind[n] = kindOfPair;
    if (Law::takesSpinDifference) {
      rx[n] = g.spinDifference.x;
      ry[n] = g.spinDifference.y;
      rz[n] = g.spinDifference.z;
    }
  }

  void putForce(int n, const ContactForce<Real> &f)
  {
    fx[n] = f.force.x;
    fy[n] = f.force.y;
    fz[n] = f.force.z;
    cx[n] = f.couple.x;
    cy[n] = f.couple.y;
    cz[n] = f.couple.z;
    if (Law::moments) {
      mx[n] = f.moment.x;
      my[n] = f.moment.y;
      mz[n] = f.moment.z;
      shorter[n] = f.shorter;
    }
  }
};

/// The law of the gran/ styles in one loop.
template <NormalModel normal, TangentialModel tangential>
struct BatchLaw {
  using Law = ClassicLaw<normal, tangential>;

  template <class P>
  static void evaluate(const StepView<P> &s, ContactBatch<Law, typename P::Real> &b, bool advance)
  {
    if (advance) evaluate<true>(s.law, s.dt, b);
    else evaluate<false>(s.law, s.dt, b);
  }

 private:
  template <bool advance, class Real>
  static void evaluate(const LawCoefficients<Real> law, const Real dt, ContactBatch<Law, Real> &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Vec3<Real> spring{Real(0), Real(0), Real(0)};
      if (Law::numbers) spring = {b.kept[0][n], b.kept[1][n], b.kept[2][n]};
      b.putForce(n, Law::evaluate(law, toContact<Law>(b.gathered(n)), spring, dt, advance));
      if (Law::numbers) {
        b.kept[0][n] = spring.x;
        b.kept[1][n] = spring.y;
        b.kept[2][n] = spring.z;
      }
    }
  }
};

}  // namespace gpudem
