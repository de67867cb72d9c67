// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: sorting, rows, and the springs carried across a rebuild.
#pragma once

#include "engine/engine_impl.hpp"

namespace gpudem {

inline BoxView toBoxView(const Box &box)
{
  return {toVec3(box.lo), toVec3(box.hi), {box.periodic[0], box.periodic[1], box.periodic[2]}};
}

template <class Exec, class P>
Extent EngineImpl<Exec, P>::extent(const Box &box)
{
  Extent e;
  e.lo = box.lo;
  e.hi = box.hi;
  if (!count_) return e;
  const bool seen = layer_.joined();
  const double huge = std::numeric_limits<double>::max();
  const ExtentSum none{{huge, huge, huge}, {-huge, -huge, -huge}, 0};
  const ExtentSum s = exec_.reduce(
      count_, GrainExtent<P>{positions(), cell_.data(), grid_, frame_, toBoxView(box), seen, toVec3(home_.middle)},
      JoinExtents{}, none);
  for (int d = 0; d < 3; ++d) {
    e.lo[d] = s.lo[d];
    e.hi[d] = s.hi[d];
  }
  e.outside = s.outside;
  return e;
}

template <class Exec, class P>
template <class T>
void EngineImpl<Exec, P>::permute(Array<T> &a, Array<T> &scratch)
{
  scratch.reserve(a.capacity());
  exec_.forEach(count_, Gather<T>{order_.data(), a.data(), scratch.data()});
  a.swap(scratch);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::extractSprings()
{
  uintScratch_.reserve(count_ + 1);
  table_.countSprings(exec_, count_, uintScratch_.data());
  storeOffset_.reserve(count_ + 1);
  const std::size_t total = exec_.exclusiveScan(uintScratch_.data(), storeOffset_.data(), count_);
  if (total == saturated) throw Error("the contacts exceed the 32-bit index of the contact store");
  storePartner_.reserveWithSlack(total);
  storeSpring_.reserveWithSlack(layout_.size * total);
  table_.extractSprings(exec_, count_, tag_.data(), storeOffset_.data(), layout_.mirror, storePartner_.data(),
                        storeSpring_.data());
  if (table_.mayHoldMore(longestUnsortedRow)) sortStore();
}

/// What the search for a partner in a long row relies on.
template <class Exec, class P>
void EngineImpl<Exec, P>::sortStore()
{
  storeSorter_.sort(exec_, count_, layout_.size, storeOffset_.data(), storePartner_.data(), storeSpring_.data());
}

template <class Exec, class P>
void EngineImpl<Exec, P>::rebuild(const Box &box)
{
  if (queued_) throw Error("a rebuild needs the queued steps to be flushed first");
  box_ = box;
  ++report_.rebuilds;
  if (!count_ && !layer_.joined()) {
    drift_.forget();
    rowsValid_ = true;
    return;
  }
  adaptSkin(box);
  const CellGrid fresh = chooseGrid(box, reachOf(scene_, pullOffGap_, skin_), mostCells);
  if (!spansSearch(frame_, box, fresh)) reframe(chooseFrame(box, fresh));
  explainMemory([&] { rebuildIn(fresh); });
  storeFresh_ = false;
  inner_.setSkin(skin_, reachSlackOf(frame_));
  rowsValid_ = true;
  resetStatus();
}

/// Rows that wear out quickly get a wider skin than the script asks for: on a GPU a step looks at near entries only, but
/// a rebuild of a small scene takes as long as ten steps. Results do not depend on the skin but for the order of sums;
/// large scenes keep theirs, as memory counts there, and so do several ranks, whose ghosts must reach alike.
template <class Exec, class P>
void EngineImpl<Exec, P>::adaptSkin(const Box &box)
{
  constexpr std::uint32_t mostGrains = 16000000;
  constexpr int few = 100, many = 400;  // steps
  const int lasted = drift_.steps();
  const bool worn = wornOut_;
  wornOut_ = false;
  if (!Exec::onGpu || !worn || layer_.joined() || count_ > mostGrains || (lasted >= few && lasted <= many)) return;
  const double widest = (hasSurfaces() ? 2.0 : 3.0) * scene_.skin;  // see mostRoomOfDrift()
  const double skin = lasted < few ? std::min(1.5 * skin_, widest) : std::max(skin_ / 1.5, scene_.skin);
  for (int d = 0; d < box.dimension; ++d)
    if (box.periodic[d] && box.hi[d] - box.lo[d] < 2.0 * reachOf(scene_, pullOffGap_, skin)) return;
  skin_ = skin;
  anchorRule_ = chooseAnchors(frame_, skin_);
}

template <class Exec, class P>
bool EngineImpl<Exec, P>::hasSurfaces() const
{
  for (std::size_t w = 0; w < scene_.walls.size(); ++w)
    if (isSurface(w)) return true;
  return false;
}

/// How far the common motion may carry all grains between two rebuilds (distance). The tables of a surface reach so far.
template <class Exec, class P>
double EngineImpl<Exec, P>::mostRoomOfDrift() const
{
  return hasSurfaces() ? surfaceGrainRoom(scene_) - skin_ : 2.0 * skin_;
}

/// Coordinates in other windows: a box that grew a lot has larger cells, and a window must span several.
template <class Exec, class P>
void EngineImpl<Exec, P>::reframe(const Frame &frame)
{
  exec_.forEach(count_, ReframeGrains<P>{positions(), cell_.data(), grid_, frame_, frame});
  frame_ = frame;
  anchorRule_ = chooseAnchors(frame_, skin_);
}

/// What grains keep of a wall, in their new order.
template <class Exec, class P>
void EngineImpl<Exec, P>::permuteWall(std::size_t w)
{
  const auto size = static_cast<std::uint32_t>(wallSize_[w]);
  if (size) {
    const std::uint32_t *keeps = isSurface(w) ? surfaces_[w].near.data() : nullptr;
    const std::uint32_t most = (1u << 31) / size;  // grains of a launch
    blockScratch_.reserve(wallHistory_[w].capacity());
    for (std::uint32_t first = 0; first < count_; first += most)
      exec_.forEach(std::min(most, count_ - first) * size, GatherBlocks<Real>{size, first, order_.data(), keeps,
                                                                              wallHistory_[w].data(), blockScratch_.data()});
    wallHistory_[w].swap(blockScratch_);
  }
  if (isSurface(w)) permute(surfaces_[w].near, uintScratch_);
}

/// The rebuild proper, into cells that are known to be good.
template <class Exec, class P>
void EngineImpl<Exec, P>::rebuildIn(const CellGrid &fresh)
{
  if (keepsContacts_ && !storeFresh_) extractSprings();
  ghosts_ = 0;

  key_.reserve(count_);
  order_.reserve(count_);
  levels_ = levelGrid(box_, levelRadii_, fresh, pullOffGap_, skin_);
  const bool several = levels_.levels > 1;
  if (several) {
    searchCell_.reserve(count_);
    uintScratch_.reserve(count_ + 1);
  }
  exec_.forEach(count_, PlaceGrains<P>{positions(), cell_.data(), grid_, levels_, fresh, frame_, toBoxView(box_),
                                       image_.data(), key_.data(), several ? uintScratch_.data() : nullptr});
  grid_ = fresh;
  exec_.sort(key_, several ? searchCell_ : cell_, order_, count_, levels_.cells());
  if (several) exec_.forEach(count_, Gather<std::uint32_t>{order_.data(), uintScratch_.data(), cell_.data()});

  exec_.forEach(count_, Gather<CoarsePosition>{order_.data(), coarse_[posNow_].data(), coarse_[1 - posNow_].data()});
  if (P::fine)
    exec_.forEach(count_, Gather<FinePosition>{order_.data(), fine_[posNow_].data(), fine_[1 - posNow_].data()});
  posNow_ = 1 - posNow_;
  exec_.forEach(count_, Gather<Motion<Real>>{order_.data(), motion_[motNow_].data(), motion_[1 - motNow_].data()});
  motNow_ = 1 - motNow_;
  permute(type_, intScratch_);
  permute(image_, intScratch_);
  permute(tag_, intScratch_);
  permute(hostIndex_, uintScratch_);
  permute(mask_, uintScratch_);
  if (forceValid_) {
    permute(force_, vecScratch_);
    permute(torque_, vecScratch_);
  }
  for (std::size_t w = 0; w < wallSize_.size(); ++w) permuteWall(w);
  if (origin_.capacity()) permute(origin_, originScratch_);

  const VelocityRange range = velocities();
  if (layer_.joined()) exchangeGrains();
  if (home_.commonMotion) drift_.start(range, scene_.timestep, skin_, mostRoomOfDrift());
  else drift_.forget();
  buildTable();
  setAnchors();
}

template <class Exec, class P>
void EngineImpl<Exec, P>::buildTable()
{
  BuildView<P> v{};
  v.count = count_;
  v.ghosts = ghosts_;
  v.position = positions();
  v.mask = mask_.data();
  v.type = type_.data();
  v.tag = tag_.data();
  v.cell = levels_.levels > 1 ? searchCell_.data() : cell_.data();
  v.levels = levels_;
  const bool dense = CellTable<Exec>::isDense(levels_.cells(), count_);
  v.directory = cells_.build(exec_, v.cell, count_, levels_.cells(), dense);
  if (ghosts_) {
    const bool denseGhosts = CellTable<Exec>::isDense(levels_.cells(), ghosts_);
    v.ghostDirectory = ghostCells_.build(exec_, v.cell + count_, ghosts_, levels_.cells(), denseGhosts);
  }
  v.frame = frame_;
  v.skin = static_cast<float>(skin_);
  v.reachSlack = reachSlackOf(frame_) + static_cast<float>(pullOffGap_);
  v.exclude.groups = static_cast<int>(scene_.exclusions.groups.size());
  for (int g = 0; g < v.exclude.groups; ++g) {
    v.exclude.groupA[g] = scene_.exclusions.groups[g].first;
    v.exclude.groupB[g] = scene_.exclusions.groups[g].second;
  }
  v.exclude.typeTable = typeTable_.capacity() ? typeTable_.data() : nullptr;
  v.exclude.types = scene_.types;

  v.cross = cross_.build(exec_, v);

  const ContactStore<Real> store{layout_.size, storeOffset_.data(), storePartner_.data(), storeSpring_.data()};
  table_.build(exec_, v, keepsContacts_, store, order_.data());
  report_.entriesPerGrain = count_ ? static_cast<double>(table_.entries()) / count_ : 0.0;
  report_.cells = levels_.cells();
  report_.levelRadii.assign(levelRadii_.begin(), levelRadii_.end());
}

template <class Exec, class P>
void EngineImpl<Exec, P>::setAnchors()
{
  SetAnchors<P> s{};
  s.position = positions();
  s.motion = motion_[motNow_].data();
  s.cell = cell_.data();
  s.grid = grid_;
  s.frame = frame_;
  s.rule = anchorRule_;
  s.room = 0.5 * skin_ + drift_.room();
  attachWalls(s.wall, 0);
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (isApart(scene_.walls[w])) continue;
    const WallSpec &spec = scene_.walls[w];
    const int k = s.walls++;
    s.wall[k].lo = spec.lo;
    s.wall[k].hi = spec.hi;
    s.wallPull[k] = wallPullOffGap(spec, scene_.largestRadius);
    const bool sweeps = spec.wiggle && spec.shape == WallShape::Plane && spec.axis == spec.motionAxis;
    s.wallLoReach[k] = sweeps ? std::min(0.0, 2.0 * spec.amplitude) : 0.0;
    s.wallHiReach[k] = sweeps ? std::max(0.0, 2.0 * spec.amplitude) : 0.0;
  }
  s.anchor = anchor_.data();
  exec_.forEach(count_, s);
  markNearRegions();
  for (SurfaceWall &s : surfaces_) s.marked = false;
}

}  // namespace gpudem
