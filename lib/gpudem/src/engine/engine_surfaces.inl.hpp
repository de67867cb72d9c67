// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: walls of triangles, which run ahead of the contacts.
#pragma once

#include "engine/engine_impl.hpp"

#include <chrono>

namespace gpudem {

/// The tables of the surfaces; those of the scene before are kept where mesh and side are the same and the reach
/// suffices.
template <class Exec, class P>
void EngineImpl<Exec, P>::setSurfaces()
{
  std::vector<SurfaceWall> before;
  before.swap(surfaces_);
  for (const WallSpec &wall : scene_.walls) {
    SurfaceWall &s = surfaces_.emplace_back();
    if (wall.shape != WallShape::Surface) continue;
    if (!wall.surface) throw Error("a wall of triangles has no mesh");
    if (wall.mostContacts < 1 || wall.mostContacts > maxSurfaceSlots)
      throw Error(fmt::format("a surface of {} contacts per grain; 1 to {} are possible", wall.mostContacts,
                              maxSurfaceSlots));
    const double reach = scene_.largestRadius + largestSurfaceMargin(wall, scene_);
    for (SurfaceWall &old : before)
      if (old.mesh == wall.surface && old.side == wall.surfaceSide && old.surface->reach() >= reach) {
        s.surface = old.surface;
        s.lo = old.lo;
        s.hi = old.hi;
        s.copy.swap(old.copy);
        old.mesh = nullptr;
      }
    s.mesh = wall.surface;
    s.side = wall.surfaceSide;
    if (!s.surface) {
      const auto start = std::chrono::steady_clock::now();
      s.surface = std::make_shared<const Surface>(*wall.surface, reach, wall.surfaceSide);
      surfaceReports_.push_back({wall.surface->triangle.size(), s.surface->bytes(),
                                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
      s.lo = {INFINITY, INFINITY, INFINITY};
      s.hi = s.lo * -1.0;
      for (const auto &p : wall.surface->vertex)
        for (int d = 0; d < 3; ++d) {
          s.lo[d] = std::min(s.lo[d], p[static_cast<std::size_t>(d)]);
          s.hi[d] = std::max(s.hi[d], p[static_cast<std::size_t>(d)]);
        }
      if (Exec::onGpu) {
        s.copy.reserve(s.surface->bytes());
        exec_.copyIn(s.copy.data(), static_cast<const unsigned char *>(s.surface->data()), s.surface->bytes());
      }
    }
    const void *data = Exec::onGpu ? static_cast<const void *>(s.copy.data()) : s.surface->data();
    s.view = s.surface->viewAt(data);
  }
}

template <class Exec, class P>
SurfaceAt EngineImpl<Exec, P>::surfaceAt(std::size_t w, const StepInputs &in)
{
  return {surfaces_[w].view, bodyPose(w < in.bodyMotion.size() ? in.bodyMotion[w] : BodyMotion{})};
}

/// Find the grains near a surface anew after a rebuild, and when it has moved by its share of the margin.
template <class Exec, class P>
void EngineImpl<Exec, P>::markNearSurfaces(const StepView<P> &v, const StepInputs &in)
{
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (!isSurface(w)) continue;
    SurfaceWall &s = surfaces_[w];
    const SurfaceAt at = surfaceAt(w, in);
    // what turns moves the grains around it farther than itself, seen from the body
    const Vec3<double> grain = Vec3<double>{1.0, 1.0, 1.0} * s.surface->reach();
    if (s.marked && largestMove(at.pose, s.markedAt, s.lo - grain, s.hi + grain) <= s.room) continue;
    const bool moves = dot(at.pose.velocity, at.pose.velocity) + dot(at.pose.spin, at.pose.spin) > 0.0;
    s.room = moves ? surfaceRoom(scene_) : 0.0;
    // a grain may be half a skin from where it was when the rows were built, and go as far to the other side
    const bool fresh = drift_.steps() == 0;
    const double room = (fresh ? 0.5 : 1.0) * skin_ + drift_.room() + s.room;
    s.marked = true;
    s.markQueued = v.sequence != 0;
    s.markedAt = at.pose;
    MarkNearSurface<P> m{};
    m.count = count_;
    m.sequence = v.sequence;
    m.status = v.status;
    m.position = v.in;
    m.motion = v.motionIn;
    m.cell = v.cell;
    m.grid = v.grid;
    m.frame = v.frame;
    m.role = roles_.of(scene_.walls[w].groupMask);
    m.margin = wallPullOffGap(scene_.walls[w], scene_.largestRadius) + room;
    m.at = at;
    m.history = wallHistory_[w].data();
    m.historySize = wallSize_[w];
    m.load = regionLoad_[w].data();
    m.anchor = anchor_.data();
    m.near = s.near.data();
    exec_.forEach(count_, m);
    uintScratch_.reserve(static_cast<std::size_t>(count_) + 1);
    s.nearGrains = exec_.exclusiveScan(s.near.data(), uintScratch_.data(), count_);
    s.nearGrain.reserveWithSlack(s.nearGrains);
    s.nearList.reserveWithSlack(static_cast<std::size_t>(NearList::most) * s.nearGrains);
    s.nearGap.reserveWithSlack(static_cast<std::size_t>(NearList::most) * s.nearGrains);
    s.nearFrom.reserveWithSlack(s.nearGrains);
    exec_.forEach(count_, ListMarked{s.near.data(), uintScratch_.data(), nullptr, 1, s.nearGrain.data()});
    s.nearSlots.reserveWithSlack(s.nearGrains);
    exec_.forEach(s.nearGrains, ListNear<P>{m, room, s.nearGrain.data(), s.nearGrains, scene_.walls[w].mostContacts,
                                            s.nearList.data(), s.nearGap.data(), s.nearFrom.data(), s.nearSlots.data()});
  }
}

template <class Exec, class P>
SurfaceStepView<P> EngineImpl<Exec, P>::surfaceStep(const StepView<P> &v, std::size_t w, const StepInputs &in)
{
  const WallSpec &spec = scene_.walls[w];
  SurfaceStepView<P> r{};
  r.count = count_;
  r.sequence = v.sequence;
  r.status = v.status;
  r.position = v.in;
  r.motion = v.motionIn;
  r.cell = v.cell;
  r.grid = v.grid;
  r.frame = v.frame;
  r.dt = v.dt;
  r.advance = v.advanceSprings;
  r.wall = wallView(w, in.step);
  // only events record, and they made the room for it
  if (spec.recordContacts && v.sequence == 0) r.wall.contacts = wallContacts_[w].data();
  r.mostContacts = spec.mostContacts;
  r.at = surfaceAt(w, in);
  for (const ForceTerm &term : scene_.terms) {
    if (term.wall == static_cast<int>(w)) break;
    if (term.kind == ForceTermKind::Enforce2d) r.flatRole |= roles_.of(term.groupMask);
  }
  r.nearGrain = surfaces_[w].nearGrain.data();
  r.nearList = surfaces_[w].nearList.data();
  r.nearGap = surfaces_[w].nearGap.data();
  r.nearFrom = surfaces_[w].nearFrom.data();
  r.nearSlots = surfaces_[w].nearSlots.data();
  r.nearGrains = surfaces_[w].nearGrains;
  r.load = regionLoad_[w].data();
  if (spec.recordTouches && v.sequence == 0) makeRoomForTouches(w, r);
  return r;
}

/// The kernel that holds the wall's law alone, where there is one.
template <class Exec, class P>
void EngineImpl<Exec, P>::launchSurface(const StepView<P> &v, std::size_t w, const StepInputs &in, Start start)
{
  const SurfaceStepView<P> step = surfaceStep(v, w, in);
  if (!scene_.walls[w].model) return launchSurfaceWith<AnyWallLaw>(step, start);
  const ModelCoefficients<Real> &law = wallModels_[w];
  withKernelProduct(law.model, law.slipLever != Real(0),
                    [&](auto product) { launchSurfaceWith<ModelWallLaw<decltype(product)>>(step, start); });
}

template <class Exec, class P>
template <class Law>
void EngineImpl<Exec, P>::launchSurfaceWith(const SurfaceStepView<P> &step, Start start)
{
  if constexpr (Exec::onGpu) {
    using InGroups = SurfaceGroupStep<P, Law>;
    const std::uint32_t lanes = InGroups::lanes * step.nearGrains;
    static const char *e = getenv("GPUDEM_GROUPS");
    const std::uint32_t most = e ? atoi(e) : 32 * 4 * exec_.fewWarps();
    const bool groups = warps_ ? warps_ > 1 : lanes <= most;
    if (groups) return exec_.forEachWarp(lanes, InGroups(step), start);
  }
  exec_.forEach(step.nearGrains, SurfaceStep<P, Law>(step), start);
}

/// Places for all contacts that grains near the surface may have.
template <class Exec, class P>
void EngineImpl<Exec, P>::makeRoomForTouches(std::size_t w, SurfaceStepView<P> &step)
{
  Touches &t = surfaces_[w].touches;
  t.at.reserve(static_cast<std::size_t>(count_) + 1);
  uintScratch_.reserve(static_cast<std::size_t>(count_) + 1);
  exec_.forEach(count_, CountRoomForTouches{anchor_.data(), static_cast<std::uint32_t>(step.mostContacts),
                                            uintScratch_.data()});
  t.total = exec_.exclusiveScan(uintScratch_.data(), t.at.data(), count_);
  t.room.reserve(static_cast<std::size_t>(t.total) + 1);
  exec_.fill(t.room.data(), static_cast<std::size_t>(t.total), 0xff);  // noTriangle
  step.touchAt = t.at.data();
  step.touch = t.room.data();
}

/// The contacts that were there, in the order of the grains on the device.
template <class Exec, class P>
void EngineImpl<Exec, P>::collectTouches(std::size_t w)
{
  Touches &t = surfaces_[w].touches;
  Array<std::uint32_t> to("places of touches");
  Array<SurfaceTouch> packed("touches");
  to.reserve(static_cast<std::size_t>(count_) + 1);
  exec_.forEach(count_, CountTouches{t.at.data(), t.room.data(), uintScratch_.data()});
  const auto total = static_cast<std::size_t>(exec_.exclusiveScan(uintScratch_.data(), to.data(), count_));
  packed.reserve(total + 1);
  exec_.forEach(count_, PackTouches{t.at.data(), to.data(), t.room.data(), tag_.data(), packed.data()});
  std::vector<SurfaceTouch> &out = observables_.wall[w].touches;
  out.resize(total);
  if (total) exec_.copyOut(out.data(), packed.data(), total);
}

/// What the grains did to each surface in the event that was just evaluated.
template <class Exec, class P>
void EngineImpl<Exec, P>::sumSurfaces(const StepView<P> &v, const StepInputs &in)
{
  observables_.wall.assign(scene_.walls.size(), WallSums{});
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (!isSurface(w) || !count_) continue;
    const SurfaceTerms<P> terms{count_,
                                v.in,
                                v.motionIn,
                                v.anchor,
                                v.cell,
                                v.grid,
                                v.frame,
                                roles_.of(scene_.walls[w].groupMask),
                                surfaceAt(w, in).pose.displacement,
                                regionLoad_[w].data(),
                                wallHistory_[w].data(),
                                scene_.walls[w].mostContacts,
                                wallSize_[w]};
    const Sums<7> s = exec_.reduce(count_, terms, AddSums{}, Sums<7>{});
    WallSums &sums = observables_.wall[w];
    for (std::size_t d = 0; d < 3; ++d) {
      sums.force[d] = s.value[d];
      sums.torque[d] = s.value[3 + d];
    }
    sums.contacts = static_cast<std::int64_t>(s.value[6] + 0.5);
    if (scene_.walls[w].recordTouches) collectTouches(w);
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::throwCrossed(std::uint32_t particle, std::int64_t step)
{
  std::int32_t tag = 0;
  exec_.copyOut(&tag, tag_.data() + particle, 1);
  resetStatus();
  rowsValid_ = false;
  throw Error(fmt::format("the centre of atom {} went through a wall of triangles before step {}: it is too fast for "
                          "the time step, or the wall too soft",
                          tag, step));
}

}  // namespace gpudem
