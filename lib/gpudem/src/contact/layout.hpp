// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a contact keeps, in memory and in registers.
#pragma once

#include "contact/coefficients.hpp"

namespace gpudem {

/// HistoryLayout without its host parts.
struct LayoutView {
  int size;
  int at[modelSlots], length[modelSlots];
};
inline LayoutView layoutView(const HistoryLayout &layout)
{
  LayoutView v{};
  v.size = layout.size;
  for (int s = 0; s < modelSlots; ++s) {
    v.at[s] = layout.at[s];
    v.length[s] = layout.length[s];
  }
  return v;
}

/// Move the numbers of one slot; \p most is known when compiling, so that they stay in registers.
template <int most, class Move>
GPUDEM_HD void moveSlot(const LayoutView &layout, ModelSlot slot, Move &&move)
{
  GPUDEM_UNROLL
  for (int d = 0; d < most; ++d)
    if (d < layout.length[static_cast<int>(slot)]) move(d, layout.at[static_cast<int>(slot)] + d);
}

/// Visit (register, number in memory) of all that Law keeps.
template <class Law, class Real, class Move>
GPUDEM_HD void moveHistory(const LayoutView &layout, ModelHistory<Real> &h, Move &&move)
{
  moveSlot<Law::history[static_cast<int>(ModelSlot::Normal)]>(layout, ModelSlot::Normal,
                                                              [&](int d, int at) { move(h.normal[d], at); });
  moveSlot<Law::history[static_cast<int>(ModelSlot::Tangential)]>(layout, ModelSlot::Tangential,
                                                                  [&](int d, int at) { move(h.tangential[d], at); });
  moveSlot<Law::history[static_cast<int>(ModelSlot::Rolling)]>(layout, ModelSlot::Rolling,
                                                               [&](int d, int at) { move(h.rolling[d], at); });
  moveSlot<Law::history[static_cast<int>(ModelSlot::Twisting)]>(layout, ModelSlot::Twisting,
                                                                [&](int d, int at) { move(h.twisting[d], at); });
  moveSlot<Law::history[static_cast<int>(ModelSlot::Cohesion)]>(layout, ModelSlot::Cohesion,
                                                                [&](int d, int at) { move(h.cohesion[d], at); });
}

}  // namespace gpudem
