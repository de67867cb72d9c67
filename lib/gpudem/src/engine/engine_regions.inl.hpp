// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: region walls, which run ahead of the contacts.
#pragma once

#include "engine/engine_impl.hpp"

namespace gpudem {

/// Shapes of the regions, and the place of the other walls in a launch.
template <class Exec, class P>
void EngineImpl<Exec, P>::setRegions()
{
  regionShapes_.clear();
  regionLoad_.clear();
  wallPlace_.clear();
  wallSweeps_.clear();
  int plain = 0;
  for (const WallSpec &wall : scene_.walls) {
    regionShapes_.emplace_back("shapes of a region");
    regionLoad_.emplace_back("loads of a region wall");
    wallPlace_.push_back(isApart(wall) ? -1 : plain++);
    wallSweeps_.push_back(0);
    if (wall.shape != WallShape::Region) continue;
    if (wall.mostContacts < 1 || wall.mostContacts > maxRegionContacts)
      throw Error(fmt::format("a region wall of {} contacts per grain; 1 to {} are possible", wall.mostContacts,
                              maxRegionContacts));
    const std::vector<RegionShape> shapes = regionShapes(wall.region);
    wallSweeps_.back() = sweeps(shapes) ? 1 : 0;
    regionShapes_.back().reserve(shapes.size());
    exec_.copyIn(regionShapes_.back().data(), shapes.data(), shapes.size());
  }
}

template <class Exec, class P>
RegionStep<P> EngineImpl<Exec, P>::regionStep(const StepView<P> &v, std::size_t w, const StepInputs &in)
{
  const WallSpec &spec = scene_.walls[w];
  RegionStep<P> r{};
  r.count = count_;
  r.sequence = v.sequence;
  r.status = v.status;
  r.position = v.in;
  r.motion = v.motionIn;
  r.anchor = v.anchor;
  r.cell = v.cell;
  r.grid = v.grid;
  r.frame = v.frame;
  r.dt = v.dt;
  r.advance = v.advanceSprings;
  r.wall = wallView(w, in.step);
  // only events record, and they made the room for it
  if (spec.recordContacts && v.sequence == 0) r.wall.contacts = wallContacts_[w].data();
  r.mostContacts = spec.mostContacts;
  r.pull = wallPullOffGap(spec, scene_.largestRadius);
  r.shape = regionShapes_[w].data();
  r.parts = static_cast<int>(spec.region.size());
  const bool given = w < in.wallMotion.size() && in.wallMotion[w].size() == spec.region.size();
  for (std::size_t k = 0; k < spec.region.size(); ++k)
    r.state[k] = partState(given ? in.wallMotion[w][k] : PartMotion{});
  for (const ForceTerm &term : scene_.terms) {
    if (term.wall == static_cast<int>(w)) break;
    if (term.kind == ForceTermKind::Enforce2d) r.flatRole |= roles_.of(term.groupMask);
  }
  r.load = regionLoad_[w].data();
  return r;
}

/// Which grains the region walls may reach until the next rebuild.
template <class Exec, class P>
void EngineImpl<Exec, P>::markNearRegions()
{
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (!isRegion(w)) continue;
    MarkNearRegion<P> m{};
    m.position = positions();
    m.motion = motion_[motNow_].data();
    m.cell = cell_.data();
    m.grid = grid_;
    m.frame = frame_;
    m.role = roles_.of(scene_.walls[w].groupMask);
    m.sweeps = wallSweeps_[w] != 0;
    m.margin = wallPullOffGap(scene_.walls[w], scene_.largestRadius) + 0.5 * skin_ + drift_.room();
    m.shape = regionShapes_[w].data();
    m.parts = static_cast<int>(scene_.walls[w].region.size());
    m.history = wallSize_[w] ? wallHistory_[w].data() : nullptr;
    m.historySize = wallSize_[w];
    m.anchor = anchor_.data();
    exec_.forEach(count_, m);
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::throwCrowded(std::uint32_t particle, std::int64_t step)
{
  std::int32_t tag = 0;
  exec_.copyOut(&tag, tag_.data() + particle, 1);
  resetStatus();
  rowsValid_ = false;
  throw Error(
      fmt::format("atom {} at step {} touches more faces of a region wall, or more places of a surface, than one grain "
                  "may: it is too large for the region, deep in the surface, or the facets of a hollow surface are small "
                  "against the overlap (keyword max/contacts)",
                  tag, step));
}

}  // namespace gpudem
