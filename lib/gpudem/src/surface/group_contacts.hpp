// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contacts of a sphere with a surface, found by several lanes of a warp together (GPU).
///
/// The triangles near a grain, and then their nearest points against the minima, are shared among the lanes of a group; the
/// few steps between are left to the first of them. Same contacts as surfaceContacts() finds.
#pragma once

#include "base/warp.hpp"
#include "surface/surface_contacts.hpp"

namespace gpudem {

/// What the lanes of a group share while they search.
template <std::uint32_t lanes>
struct GroupScratch {
  SurfaceContact candidate[lanes];
  Prominence prominence[maxSurfaceContacts];
};

/// Lanes of a warp that work for one grain.
template <std::uint32_t lanes>
struct LaneGroup {
  static_assert(lanes > 1 && lanes < warpWidth && (lanes & (lanes - 1)) == 0, "a power of two");
  std::uint32_t member = warpLane() % lanes;

  GPUDEM_HD bool leads() const { return member == 0; }
  /// Bit k: \p condition of member k.
  GPUDEM_HD std::uint32_t ballot(bool condition) const
  {
    return warpBallot(condition) >> (warpLane() - member) & ((1u << lanes) - 1u);
  }
  GPUDEM_HD double least(double value) const
  {
    for (std::uint32_t apart = lanes / 2; apart > 0; apart /= 2) {
      const double other = warpTake(value, warpLane() ^ apart);
      value = other < value ? other : value;
    }
    return value;
  }
};

/// Walks the tree, for the few grains whose list has no room for what is near.
GPUDEM_RARE void surfaceContactsAlone(const SurfaceView &s, const Vec3<double> &x, double reach, SurfaceContacts &out,
                                      const NearList &list)
{
  surfaceContacts(s, x, reach, out, list);
}

/// All lanes of a warp call this. \param wanted in all lanes of a group alike; the others only keep them company
template <std::uint32_t lanes>
class GroupSearch {
 public:
  /// \param found, scratch of the group
  GPUDEM_HD GroupSearch(const SurfaceView &s, const Vec3<double> &x, double reach, const NearList &list,
                        SurfaceContacts &found, GroupScratch<lanes> &scratch)
      : s_(s), x_(x), reach_(reach), list_(list), found_(found), scratch_(scratch)
  {
  }

  /// surfaceContacts() into the contacts of the group, seen by all lanes afterwards.
  GPUDEM_HD void find(bool wanted)
  {
    const bool together = wanted && list_.holdsTriangles();
    const std::uint32_t listed = findMinima(together);
    if (group_.leads() && wanted) {
      if (!together) surfaceContactsAlone(s_, x_, reach_, found_, list_);
      else if (s_.side != 0) chooseSides(s_, found_);
    }
    warpSync();
    weigh(together ? found_.count : 0, listed);
  }

 private:
  /// \return listed triangles that were looked at
  GPUDEM_HD std::uint32_t findMinima(bool together)
  {
    MinimumList minima(found_);
    const float limit = (static_cast<float>(reach_) + list_.moved) * 1.000001f;
    std::uint32_t listed = 0;
    bool more = together;
    for (std::uint32_t first = 0; first < NearList::most && warpAny(more); first += lanes) {
      const std::uint32_t k = first + group_.member;
      const std::uint32_t within = group_.ballot(more && list_.gapOf(k) <= limit);
      const std::uint32_t run = (~within & (within + 1u)) - 1u;  // behind the first that is not, there is nothing
      more = more && run == (1u << lanes) - 1u;
      listed += static_cast<std::uint32_t>(bitCount(run));
      const bool minimum = run >> group_.member & 1u ? look(k) : false;
      std::uint32_t found = group_.ballot(minimum);
      warpSync();
      for (; group_.leads() && found; found &= found - 1) minima.add(scratch_.candidate[lowestBit(found)]);
      warpSync();
    }
    return listed;
  }

  /// Entry \p k of the list. \return is its nearest point a minimum, which is then a candidate?
  GPUDEM_HD bool look(std::uint32_t k)
  {
    bool minimum = false;
    visitTriangle(s_, list_.entry(k), x_, reach_, [&](std::uint32_t triangle, const TrianglePoint &p, double distance2) {
      minimum = isMinimum(s_, s_.triangle[triangle], p, x_);
      if (minimum) scratch_.candidate[group_.member] = contactAt(s_, triangle, p, squareRoot(distance2));
      return true;
    });
    return minimum;
  }

  /// As findProminence() and weighContacts().
  GPUDEM_HD void weigh(int count, std::uint32_t listed)
  {
    const int most = static_cast<int>(warpMax(static_cast<std::uint32_t>(count)));
    if (most < 2) return;
    for (int j = 1; j < most; ++j) {
      Prominence p{1.0, 0.0};
      for (std::uint32_t k = group_.member; j < count && k < listed; k += lanes) compare(k, found_.contact[j], p);
      p.least = group_.least(p.least);
      p.hidden = -group_.least(-p.hidden);
      if (group_.leads()) scratch_.prominence[j] = p;
    }
    if (group_.leads() && count > 1) {
      scratch_.prominence[0] = {1.0, 0.0};
      found_.count = weighContacts(found_.contact, count, reach_, scratch_.prominence);
    }
    warpSync();
  }

  GPUDEM_HD void compare(std::uint32_t k, const SurfaceContact &contact, Prominence &p) const
  {
    const auto against = [&](std::uint32_t, const TrianglePoint &point, double distance2) {
      SurfaceContact nearer;
      nearer.distance = squareRoot(distance2);
      if (!(nearer.distance < contact.distance) || nearer.distance == 0.0) return true;
      nearer.normal = point.branch * (1.0 / nearer.distance);
      const Vec3<double> chord = contact.normal - nearer.normal;
      if (dot(chord, chord) > sameDirection2) compareWith(nearer, contact, reach_, p);
      return true;
    };
    visitTriangle(s_, list_.entry(k), x_, contact.distance, against);
  }

  const SurfaceView &s_;
  const Vec3<double> x_;
  const double reach_;
  const NearList &list_;
  SurfaceContacts &found_;
  GroupScratch<lanes> &scratch_;
  LaneGroup<lanes> group_;
};

}  // namespace gpudem
