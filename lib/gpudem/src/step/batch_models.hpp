// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Products of sub-models over a batch of pairs on the CPU.
///
/// Each slot is a loop of its own over the batch, for the one sub-model that the scene uses: the compiler vectorises
/// it, and the number of compiled loops is the sum of the sub-models, not their product. The functions are those of
/// Product. Where type pairs differ in their sub-models, a loop chooses for every pair.
#pragma once

#include "step/contact_batch.hpp"

namespace gpudem {

/// The law of the CPU for products; the members are chosen per batch.
using BatchModelLaw = ModelLaw<AnyProduct>;

template <class Real>
class BatchModels {
 public:
  using Batch = ContactBatch<BatchModelLaw, Real>;

  template <class P>
  void evaluate(const StepView<P> &s, Batch &b, bool advance)
  {
    for (int n = b.size; n < b.padded(); ++n) b.kind[n] = 0;  // an index, unlike the rest behind the last pair
    if (s.types > 1) evaluate<false>(s, b, advance);
    else evaluate<true>(s, b, advance);
  }

 private:
  /// Coefficients of a pair: the same for all, or by the kind of the pair.
  template <bool uniform>
  struct Table {
    explicit Table(const ModelCoefficients<Real> *models) : first(models[0]), all(models) {}
    const ModelCoefficients<Real> &of(std::uint32_t kind) const { return uniform ? first : all[kind]; }
    const ModelCoefficients<Real> first;
    const ModelCoefficients<Real> *all;
  };

  template <bool uniform, class P>
  void evaluate(const StepView<P> &s, Batch &b, bool advance)
  {
    const Table<uniform> table(s.models);
    contacts(b);
    const auto choose = [&](auto list, ModelSlot slot, auto any, const auto &run) {
      const int model = s.commonModel[static_cast<int>(slot)];
      if (model < 0) return run(any);
      int m = 0;
      forEachModel(list, [&](auto member) {
        if (model == m++) run(member);
      });
    };
    choose(NormalModels{}, ModelSlot::Normal, AnyNormal{}, [&](auto m) { normal<decltype(m)>(table, s.layout, b); });
    choose(DampingModels{}, ModelSlot::Damping, AnyDamping{}, [&](auto m) { damping<decltype(m)>(table, b); });
    choose(TangentialModels{}, ModelSlot::Tangential, AnyTangential{},
           [&](auto m) { tangential<decltype(m)>(table, s.layout, b, s.dt, advance); });
    choose(RollingModels{}, ModelSlot::Rolling, AnyRolling{},
           [&](auto m) { rolling<decltype(m)>(table, s.layout, b, s.dt, advance); });
    choose(TwistingModels{}, ModelSlot::Twisting, AnyTwisting{},
           [&](auto m) { twisting<decltype(m)>(table, s.layout, b, s.dt, advance); });
    finish(table, b);
  }

  void contacts(const Batch &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      const Contact<Real> c = toContact<BatchModelLaw>(b.gathered(n));
      const ContactFrame<Real> f = contactFrame(c);
      overlap_[n] = c.overlap;
      effectiveRadius_[n] = c.effectiveRadius;
      effectiveMass_[n] = c.effectiveMass;
      normalRate_[n] = f.normalRate;
      nx_[n] = f.normal.x;
      ny_[n] = f.normal.y;
      nz_[n] = f.normal.z;
      sx_[n] = f.slip.x;
      sy_[n] = f.slip.y;
      sz_[n] = f.slip.z;
    }
  }

  ContactFrame<Real> frame(int n) const
  {
    return {{nx_[n], ny_[n], nz_[n]}, normalRate_[n], {sx_[n], sy_[n], sz_[n]}};
  }
  /// What normal, rolling and twisting sub-models may read of the contact.
  Contact<Real> contact(const Batch &b, int n) const
  {
    Contact<Real> c{};
    c.overlap = overlap_[n];
    c.effectiveRadius = effectiveRadius_[n];
    c.effectiveMass = effectiveMass_[n];
    c.spinDifference = {b.rx[n], b.ry[n], b.rz[n]};
    return c;
  }
  NormalForce<Real> normalForce(int n) const
  {
    return {elastic_[n], contactRadius_[n], stiffness_[n], pullOff_[n], adhesive_[n] != Real(0)};
  }

  template <int most>
  static void load(const LayoutView &layout, ModelSlot slot, const Batch &b, int n, Real *h)
  {
    for (int d = 0; d < most; ++d)
      h[d] = d < layout.length[static_cast<int>(slot)] ? b.kept[layout.at[static_cast<int>(slot)] + d][n] : Real(0);
  }
  template <int most>
  static void store(const LayoutView &layout, ModelSlot slot, Batch &b, int n, const Real *h)
  {
    for (int d = 0; d < most; ++d)
      if (d < layout.length[static_cast<int>(slot)]) b.kept[layout.at[static_cast<int>(slot)] + d][n] = h[d];
  }

  template <class M, class T>
  void normal(const T &table, const LayoutView layout, Batch &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxNormalHistory];
      load<M::history>(layout, ModelSlot::Normal, b, n, h);
      const NormalForce<Real> f = M::force(table.of(b.kind[n]), contact(b, n), h);
      store<M::history>(layout, ModelSlot::Normal, b, n, h);
      elastic_[n] = f.elastic;
      contactRadius_[n] = f.contactRadius;
      stiffness_[n] = f.stiffness;
      pullOff_[n] = f.pullOff;
      adhesive_[n] = f.adhesive ? Real(1) : Real(0);
    }
  }

  template <class M, class T>
  void damping(const T &table, const Batch &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      const DampedNormal<Real> d =
          dampNormal<M>(table.of(b.kind[n]), effectiveMass_[n], normalRate_[n], normalForce(n));
      push_[n] = d.push;
      base_[n] = d.base;
      eta_[n] = d.eta;
    }
  }

  template <class M, class T>
  void tangential(const T &table, const LayoutView layout, Batch &b, const Real dt, const bool advance)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxTangentialHistory];
      load<M::history>(layout, ModelSlot::Tangential, b, n, h);
      const ModelCoefficients<Real> &k = table.of(b.kind[n]);
      const ContactFrame<Real> f = frame(n);
      const Vec3<Real> friction = M::force(k, f, contactRadius_[n], eta_[n], base_[n], h, dt, advance);
      store<M::history>(layout, ModelSlot::Tangential, b, n, h);
      const TangentialStiffness<Real> t = M::stiffness(k, contactRadius_[n], eta_[n]);
      tangentialSpring_[n] = t.spring;
      tangentialDashpot_[n] = t.dashpot;
      const Vec3<Real> couple = cross(f.normal, friction), force = f.normal * push_[n] + friction;
      b.fx[n] = force.x;
      b.fy[n] = force.y;
      b.fz[n] = force.z;
      b.cx[n] = couple.x;
      b.cy[n] = couple.y;
      b.cz[n] = couple.z;
    }
  }

  template <class M, class T>
  void rolling(const T &table, const LayoutView layout, Batch &b, const Real dt, const bool advance)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxRollingHistory];
      load<M::history>(layout, ModelSlot::Rolling, b, n, h);
      const Vec3<Real> m =
          M::moment(table.of(b.kind[n]), contact(b, n), frame(n), normalForce(n), base_[n], h, dt, advance);
      store<M::history>(layout, ModelSlot::Rolling, b, n, h);
      b.mx[n] = m.x;
      b.my[n] = m.y;
      b.mz[n] = m.z;
    }
  }

  template <class M, class T>
  void twisting(const T &table, const LayoutView layout, Batch &b, const Real dt, const bool advance)
  {
    if (std::is_same<M, NoTwisting>::value) return;
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxTwistingHistory];
      load<M::history>(layout, ModelSlot::Twisting, b, n, h);
      const TangentialStiffness<Real> t{tangentialSpring_[n], tangentialDashpot_[n]};
      const Real torque =
          M::torque(table.of(b.kind[n]), contact(b, n), frame(n), contactRadius_[n], t, base_[n], h, dt, advance);
      store<M::history>(layout, ModelSlot::Twisting, b, n, h);
      b.mx[n] += nx_[n] * torque;
      b.my[n] += ny_[n] * torque;
      b.mz[n] += nz_[n] * torque;
    }
  }

  template <class T>
  void finish(const T &table, Batch &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) b.shorter[n] = table.of(b.kind[n]).lever * overlap_[n];
  }

  Real overlap_[batchStride], effectiveRadius_[batchStride], effectiveMass_[batchStride], normalRate_[batchStride];
  Real nx_[batchStride], ny_[batchStride], nz_[batchStride], sx_[batchStride], sy_[batchStride], sz_[batchStride];
  Real elastic_[batchStride], contactRadius_[batchStride], stiffness_[batchStride], pullOff_[batchStride],
      adhesive_[batchStride];
  Real push_[batchStride], base_[batchStride], eta_[batchStride];
  Real tangentialSpring_[batchStride], tangentialDashpot_[batchStride];
};

template <class Law, class Real>
struct BatchEvaluator;
template <NormalModel n, TangentialModel t, class Real>
struct BatchEvaluator<ClassicLaw<n, t>, Real> {
  template <class P>
  void operator()(const StepView<P> &s, ContactBatch<ClassicLaw<n, t>, Real> &b, bool advance)
  {
    BatchLaw<n, t>::evaluate(s, b, advance);
  }
};
template <class Real>
struct BatchEvaluator<BatchModelLaw, Real> {
  template <class P>
  void operator()(const StepView<P> &s, ContactBatch<BatchModelLaw, Real> &b, bool advance)
  {
    models.evaluate(s, b, advance);
  }
  BatchModels<Real> models;
};

}  // namespace gpudem
