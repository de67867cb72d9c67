// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: the grains of other ranks.
#pragma once

#include "engine/engine_impl.hpp"

namespace gpudem {

template <class Exec, class P>
Vec3<double> EngineImpl<Exec, P>::periods() const
{
  const auto period = [&](int d) { return box_.periodic[d] ? box_.hi[d] - box_.lo[d] : 0.0; };
  return {period(0), period(1), period(2)};
}

/// Velocities of all grains of all ranks. With several ranks all learn of each other on the way.
template <class Exec, class P>
VelocityRange EngineImpl<Exec, P>::velocities()
{
  const float huge = std::numeric_limits<float>::max();
  const VelocityRange none{{huge, huge, huge}, {-huge, -huge, -huge}};
  if (!layer_.joined()) return exec_.reduce(count_, GrainVelocity<Real>{motion_[motNow_].data()}, JoinRanges{}, none);
  const double far = std::numeric_limits<double>::max();
  const RankExtent nothing{{far, far, far}, {-far, -far, -far}, 0.0, none};
  const Vec3<double> middle = toVec3(home_.middle), period = periods();
  RankExtent own = nothing;
  if (count_)
    own = exec_.reduce(count_, GrainInRank<P>{positions(), cell_.data(), grid_, frame_, middle, period},
                       JoinRankExtents{}, nothing);
  const double beyond = 1.0001 * skin_ + pullOffGap_ + static_cast<double>(reachSlackOf(frame_));
  return layer_.survey(exec_, own, count_, middle, period, beyond);
}

/// Room for the ghosts in an array whose grains must stay.
template <class Exec, class P>
template <class T>
void EngineImpl<Exec, P>::extend(Array<T> &a)
{
  const std::size_t total = static_cast<std::size_t>(count_) + ghosts_;
  if (a.capacity() >= total) return;
  Array<T> larger(a.name());
  larger.reserveWithSlack(total);
  exec_.forEach(count_, CopyValues<T>{a.data(), larger.data()});
  exec_.synchronize();
  a.swap(larger);
}

/// Which grains others need, and the ghosts that this rank needs.
template <class Exec, class P>
void EngineImpl<Exec, P>::exchangeGrains()
{
  ghosts_ = layer_.select(exec_, count_, {positions(), cell_.data(), grid_, frame_, periods(), nullptr, 0},
                          Exec::onGpu ? 32u : grainsPerChunk);
  const bool several = levels_.levels > 1;
  for (int k = 0; k < 2; ++k) {
    extend(coarse_[k]);
    if (P::fine) extend(fine_[k]);
    extend(motion_[k]);
  }
  extend(type_);
  extend(tag_);
  extend(mask_);
  extend(cell_);
  if (several) extend(searchCell_);
  layer_.introduce(exec_, count_, {positions(), tag_.data(), type_.data(), mask_.data(), cell_.data()},
                   positions(1 - posNow_, 1 - motNow_), levels_, grid_, frame_,
                   several ? searchCell_.data() : cell_.data());
  report_.ghosts = ghosts_;
  report_.sent = layer_.sent();
  report_.partners = layer_.partners();
}

/// After a drift: fetch the motion of the ghosts, and agree whether all ranks may go on.
template <class Exec, class P>
void EngineImpl<Exec, P>::followGhosts(const PositionArrays<P> &grains)
{
  layer_.beginRefresh(exec_, grains);
  finishGhosts(grains);
}

/// A fused step: the grains that others see first, the others while messages travel.
template <class Exec, class P>
void EngineImpl<Exec, P>::stepAndFollowGhosts(const StepView<P> &v)
{
  const UnitList border = layer_.border(), interior = layer_.interior();
  part_ = &border;
  launchContactsIn<StepMode::Fused>(v);
  layer_.beginRefresh(exec_, v.out);
  part_ = &interior;
  launchContactsIn<StepMode::Fused>(v);
  part_ = nullptr;
  finishGhosts(v.out);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::finishGhosts(const PositionArrays<P> &grains)
{
  Status s;
  exec_.copyOut(&s, status_.data(), 1);
  double alarm[3] = {s.lastAllowed != noLimit ? 1.0 : 0.0, s.rebuildAfter != noLimit ? 1.0 : 0.0,
                     static_cast<double>(floatOf(s.longestStep2))};
  layer_.ranks().beginLargest(alarm, 3);
  layer_.finishRefresh(exec_, count_, grains);
  layer_.ranks().finishLargest();
  stopAgreed_ = stopAgreed_ || alarm[0] > 0.0;
  rebuildAgreed_ = rebuildAgreed_ || alarm[1] > 0.0;
  longestAgreed2_ = static_cast<float>(alarm[2]);
}

}  // namespace gpudem
