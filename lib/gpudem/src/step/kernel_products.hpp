// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The products of sub-models that have GPU kernels of their own. Every other product runs in the kernel that
/// chooses its members at run time. A line here costs four kernels per precision; the CPU needs none
/// (batch_models.hpp).
#pragma once

#include "contact/product.hpp"

#include <type_traits>

namespace gpudem {

using KernelProducts =
    ModelList<Product<HertzNormal, AnyDamping, MindlinTangential, NoRolling, NoTwisting>,
              Product<HertzNormal, AnyDamping, MindlinTangential, SdsRolling, NoTwisting>,
              Product<HookeNormal, AnyDamping, LinearHistoryTangential, NoRolling, NoTwisting>, AnyProduct>;

/// Is the sub-model number \p index of the list evaluated by \p Member? A sub-model that differs from another only in
/// how its coefficients come about derives from it.
template <class Member, class List>
bool serves(List list, int index)
{
  bool found = false;
  int m = 0;
  forEachModel(
      list, [&](auto member) { found = found || (index == m++ && std::is_base_of<Member, decltype(member)>::value); });
  return found;
}

template <class N, class D, class T, class R, class W, class C>
bool servesAll(Product<N, D, T, R, W, C>, const int *model, bool slipLever)
{
  const auto at = [&](ModelSlot slot) { return model[static_cast<int>(slot)]; };
  return (!slipLever || Product<N, D, T, R, W, C>::takesSlipLever) &&
         (std::is_same<N, AnyNormal>::value || serves<N>(NormalModels{}, at(ModelSlot::Normal))) &&
         (std::is_same<D, AnyDamping>::value || serves<D>(DampingModels{}, at(ModelSlot::Damping))) &&
         (std::is_same<T, AnyTangential>::value || serves<T>(TangentialModels{}, at(ModelSlot::Tangential))) &&
         (std::is_same<R, AnyRolling>::value || serves<R>(RollingModels{}, at(ModelSlot::Rolling))) &&
         (std::is_same<W, AnyTwisting>::value || serves<W>(TwistingModels{}, at(ModelSlot::Twisting))) &&
         (std::is_same<C, AnyCohesion>::value || serves<C>(CohesionModels{}, at(ModelSlot::Cohesion)));
}

/// visit(product) for the first product that serves the sub-models \p model (-1: they differ between type pairs).
/// \param slipLever the arm of the slip velocity is shortened
template <class Visit>
void withKernelProduct(const int *model, bool slipLever, Visit &&visit)
{
  bool done = false;
  forEachModel(KernelProducts{}, [&](auto product) {
    if (done || !servesAll(product, model, slipLever)) return;
    done = true;
    visit(product);
  });
}

}  // namespace gpudem
