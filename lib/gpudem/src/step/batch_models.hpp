// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Products of sub-models over a batch of pairs on the CPU.
///
/// Each slot is a loop of its own over the batch, for the one sub-model that the scene uses: the compiler vectorises
/// it, and the number of compiled loops is the sum of the sub-models, not their product. The functions are those of
/// Product. Where type pairs differ in their sub-models, a loop chooses for every pair.
#pragma once

#include "step/contact_batch.hpp"

#include <algorithm>

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
    // known when compiling, or the loops would not vectorise
    if (s.types > 1) advance ? evaluate<false, true>(s, b) : evaluate<false, false>(s, b);
    else advance ? evaluate<true, true>(s, b) : evaluate<true, false>(s, b);
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

  template <bool uniform, bool advance, class P>
  void evaluate(const StepView<P> &s, Batch &b)
  {
    const Table<uniform> table(s.models);
    if (s.needs.slipLever) contacts<true>(table, b);
    else contacts<false>(table, b);
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
    choose(CohesionModels{}, ModelSlot::Cohesion, AnyCohesion{},
           [&](auto m) { cohesion<decltype(m)>(table, s.layout, b); });
    choose(TangentialModels{}, ModelSlot::Tangential, AnyTangential{},
           [&](auto m) { tangential<decltype(m), advance>(table, s.layout, b, s.dt); });
    choose(RollingModels{}, ModelSlot::Rolling, AnyRolling{},
           [&](auto m) { rolling<decltype(m), advance>(table, s.layout, b, s.dt); });
    choose(TwistingModels{}, ModelSlot::Twisting, AnyTwisting{},
           [&](auto m) { twisting<decltype(m), advance>(table, s.layout, b, s.dt); });
    finish(table, b);
    choose(CohesionModels{}, ModelSlot::Cohesion, AnyCohesion{},
           [&](auto m) { forgetTouch<decltype(m)>(table, s.layout, b); });
  }

  template <bool shortSlip, class T>
  void contacts(const T &table, const Batch &b)
  {
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      const Contact<Real> c = toContact<BatchModelLaw>(b.gathered(n));
      const ContactFrame<Real> f =
          contactFrame(c, shortSlip ? shortenedSpin(c, table.of(b.kind[n]).slipLever) : c.surfaceSpin);
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
  /// What normal, rolling, twisting and cohesion sub-models may read of the contact.
  Contact<Real> contact(const Batch &b, int n) const
  {
    Contact<Real> c{};
    c.overlap = overlap_[n];
    c.distance = b.reach[n] - overlap_[n];
    c.effectiveRadius = effectiveRadius_[n];
    c.effectiveMass = effectiveMass_[n];
    c.spinDifference = {b.rx[n], b.ry[n], b.rz[n]};
    c.inertia = b.inertia[n];
    return c;
  }
  NormalForce<Real> normalForce(int n) const
  {
    return {elastic_[n], contactRadius_[n], stiffness_[n], pullOff_[n], adhesive_[n] != Real(0)};
  }

  /// The numbers of one slot, a row of the batch each. A member chosen at run time may know more numbers than the
  /// scene's contacts keep: those are zero and forgotten.
  template <class M>
  struct Rows {
    Rows(BatchModels &models, const LayoutView &layout, ModelSlot slot, Batch &b)
    {
      for (int d = 0; d < M::history; ++d) {
        const bool kept = d < layout.length[static_cast<int>(slot)];
        row[d] = kept ? b.kept[layout.at[static_cast<int>(slot)] + d] : models.spare_[d];
        if (!kept) std::fill_n(models.spare_[d], batchStride, Real(0));
      }
    }
    void load(int n, Real *h) const
    {
      for (int d = 0; d < M::history; ++d) h[d] = row[d][n];
    }
    void store(int n, const Real *h) const
    {
      for (int d = 0; d < M::history; ++d) row[d][n] = h[d];
    }
    Real *row[M::history > 0 ? M::history : 1];
  };

  template <class M, class T>
  void normal(const T &table, const LayoutView layout, Batch &b)
  {
    const Rows<M> rows(*this, layout, ModelSlot::Normal, b);
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxNormalHistory];
      rows.load(n, h);
      const NormalForce<Real> f = M::force(table.of(b.kind[n]), contact(b, n), h);
      rows.store(n, h);
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

  /// Adds to the normal force. Pairs that only cohesion holds together have no other force left, and so no limit of
  /// friction, rolling and twisting, whatever the other loops make of their negative overlap.
  template <class M, class T>
  void cohesion(const T &table, const LayoutView layout, Batch &b)
  {
    if (std::is_same<M, NoCohesion>::value) return;
    const Rows<M> rows(*this, layout, ModelSlot::Cohesion, b);
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxCohesionHistory];
      rows.load(n, h);
      const ModelCoefficients<Real> &k = table.of(b.kind[n]);
      const Real force = M::force(k, contact(b, n), h);
      rows.store(n, h);
      DampedNormal<Real> d{push_[n], base_[n], eta_[n]};
      addCohesion(k, force, d);
      const bool acts = !M::beyondTouch || surfacesAct(k, overlap_[n]);
      push_[n] = acts ? d.push : force;
      base_[n] = acts ? d.base : Real(0);
      eta_[n] = acts ? d.eta : Real(0);
      elastic_[n] = acts ? elastic_[n] : Real(0);
      contactRadius_[n] = acts ? contactRadius_[n] : Real(0);
      stiffness_[n] = acts ? stiffness_[n] : Real(0);
    }
  }

  template <class M, bool advance, class T>
  void tangential(const T &table, const LayoutView layout, Batch &b, const Real dt)
  {
    const Rows<M> rows(*this, layout, ModelSlot::Tangential, b);
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxTangentialHistory];
      rows.load(n, h);
      const ModelCoefficients<Real> &k = table.of(b.kind[n]);
      const ContactFrame<Real> f = frame(n);
      const Vec3<Real> friction = M::force(k, f, contactRadius_[n], eta_[n], base_[n], h, dt, advance);
      rows.store(n, h);
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

  template <class M, bool advance, class T>
  void rolling(const T &table, const LayoutView layout, Batch &b, const Real dt)
  {
    const Rows<M> rows(*this, layout, ModelSlot::Rolling, b);
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxRollingHistory];
      rows.load(n, h);
      const Vec3<Real> m = M::moment(table.of(b.kind[n]), contact(b, n), frame(n), normalForce(n),
                                     {tangentialSpring_[n], tangentialDashpot_[n]}, base_[n], h, dt, advance);
      rows.store(n, h);
      b.mx[n] = m.x;
      b.my[n] = m.y;
      b.mz[n] = m.z;
    }
  }

  template <class M, bool advance, class T>
  void twisting(const T &table, const LayoutView layout, Batch &b, const Real dt)
  {
    if (std::is_same<M, NoTwisting>::value) return;
    const Rows<M> rows(*this, layout, ModelSlot::Twisting, b);
    const int size = b.padded();
#pragma GCC ivdep
    for (int n = 0; n < size; ++n) {
      Real h[maxTwistingHistory];
      rows.load(n, h);
      const TangentialStiffness<Real> t{tangentialSpring_[n], tangentialDashpot_[n]};
      const Real torque =
          M::torque(table.of(b.kind[n]), contact(b, n), frame(n), contactRadius_[n], t, base_[n], h, dt, advance);
      rows.store(n, h);
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

  /// As in Product: pairs that only cohesion holds together keep nothing of their touch.
  template <class M, class T>
  void forgetTouch(const T &table, const LayoutView layout, Batch &b)
  {
    if (!M::beyondTouch) return;
    const int size = b.padded();
    const int cohesion = static_cast<int>(ModelSlot::Cohesion), kept = layout.size - layout.length[cohesion];
    for (int d = 0; d < kept; ++d)  // what cohesion keeps comes last
#pragma GCC ivdep
      for (int n = 0; n < size; ++n)
        b.kept[d][n] = surfacesAct(table.of(b.kind[n]), overlap_[n]) ? b.kept[d][n] : Real(0);
  }

  Real overlap_[batchStride], effectiveRadius_[batchStride], effectiveMass_[batchStride], normalRate_[batchStride];
  Real nx_[batchStride], ny_[batchStride], nz_[batchStride], sx_[batchStride], sy_[batchStride], sz_[batchStride];
  Real elastic_[batchStride], contactRadius_[batchStride], stiffness_[batchStride], pullOff_[batchStride],
      adhesive_[batchStride];
  Real push_[batchStride], base_[batchStride], eta_[batchStride];
  Real tangentialSpring_[batchStride], tangentialDashpot_[batchStride];
  Real spare_[maxTangentialHistory][batchStride];
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
