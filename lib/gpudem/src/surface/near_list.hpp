// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a grain finds near it without walking the tree: triangles or nodes, the nearest first.
#pragma once

#include "surface/visit_triangles.hpp"

namespace gpudem {

/// Where a centre finds the surface, wherever it has gone since this was listed: all triangles within reach, or if they
/// are many the nodes that may hold a minimum of the distance. The nearest come first, each with its distance at that
/// time, so that a centre that has gone a little looks at those alone that may be within its radius now.
struct NearList {
  const std::uint32_t *first;  ///< null: not listed
  const float *gap;            ///< distances, not too large; noEntry behind the last entry, unless the list is full
  std::uint32_t stride;
  float moved;  ///< how far the centre has gone since, not too small (distance)

  static constexpr std::uint32_t most = 32;
  static constexpr float noEntry = 3.0e38f;
  static constexpr float tooMany = -1.0f;             ///< in the first place: cells and tree have them
  static constexpr std::uint32_t ofNode = 1u << 31;  ///< in the number of a node
  GPUDEM_HD std::uint32_t entry(std::uint32_t k) const { return first[static_cast<std::size_t>(stride) * k]; }
  GPUDEM_HD float gapOf(std::uint32_t k) const { return gap[static_cast<std::size_t>(stride) * k]; }
  GPUDEM_HD bool holdsMinima() const { return first && *gap != tooMany; }
  GPUDEM_HD bool holdsTriangles() const { return holdsMinima() && (*gap == noEntry || !(*first & ofNode)); }
};

/// What listNear() finds, the nearest first.
class NearEntries {
 public:
  /// \return is there room?
  GPUDEM_HD bool add(std::uint32_t entry, float gap)
  {
    if (found_++ >= NearList::most) return false;
    std::uint32_t k = found_ - 1;
    for (; k > 0 && gap_[k - 1] > gap; --k) {
      entry_[k] = entry_[k - 1];
      gap_[k] = gap_[k - 1];
    }
    entry_[k] = entry;
    gap_[k] = gap;
    return true;
  }
  GPUDEM_HD void forget() { found_ = 0; }
  GPUDEM_HD bool some() const { return found_ > 0; }
  GPUDEM_HD bool tooMany() const { return found_ > NearList::most; }
  GPUDEM_HD void write(std::uint32_t *entry, float *gap, std::uint32_t stride) const
  {
    if (tooMany()) {
      *gap = NearList::tooMany;
      return;
    }
    for (std::uint32_t k = 0; k < found_; ++k) {
      entry[static_cast<std::size_t>(stride) * k] = entry_[k];
      gap[static_cast<std::size_t>(stride) * k] = gap_[k];
    }
    if (found_ < NearList::most) gap[static_cast<std::size_t>(stride) * found_] = NearList::noEntry;
  }

 private:
  std::uint32_t entry_[NearList::most], found_ = 0;
  float gap_[NearList::most];
};

/// List what lies within \p reach of \p x, for centres within \p room of \p x and \p reach - \p room of the surface.
/// \param first, gap, stride as of NearList
/// \return is there anything?
GPUDEM_HD bool listNear(const SurfaceView &s, const Vec3<double> &x, double reach, double room, std::uint32_t *first,
                        float *gap, std::uint32_t stride)
{
  constexpr float down = 0.999999f;  // rounding must not hide what is there
  NearEntries found;
  visitNear(s, x, reach, [&](std::uint32_t k, const TrianglePoint &, double distance2) {
    return found.add(k, static_cast<float>(squareRoot(distance2)) * down);
  });
  const bool some = found.some();
  if (found.tooMany()) {
    found.forget();
    visitNodes<Wanted::Minima>(s, x, reach, static_cast<float>(room) * 1.00001f, [&](std::uint32_t n) {
      return found.add(n | NearList::ofNode, squareRoot(boxDistance2(s.node[n], x.as<float>())) * down);
    });
  }
  found.write(first, gap, stride);
  return some;
}

/// As visitNear(), where possible among what is listed.
template <Wanted wanted = Wanted::All, class Visit>
GPUDEM_HD void visitListed(const SurfaceView &s, const NearList &list, const Vec3<double> &x, double reach,
                           const Visit &visit)
{
  if (wanted == Wanted::All ? !list.holdsTriangles() : !list.holdsMinima()) return visitNear<wanted>(s, x, reach, visit);
  const float limit = (static_cast<float>(reach) + list.moved) * 1.000001f;
  for (std::uint32_t k = 0; k < NearList::most; ++k) {
    if (list.gapOf(k) > limit) return;
    const std::uint32_t entry = list.entry(k), n = entry & ~NearList::ofNode;
    if (entry == n) {
      if (!visitTriangle(s, n, x, reach, visit)) return;
      continue;
    }
    const Vec3<float> coarse = x.as<float>();
    if (boxDistance2(s.node[n], coarse) <= coarseReach2(reach) && mayHoldMinimum(s.cone[n], s.node[n], coarse))
      if (!visitTriangles(s, n, x, reach, visit)) return;
  }
}

}  // namespace gpudem
