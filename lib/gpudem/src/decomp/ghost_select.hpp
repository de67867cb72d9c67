// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Where the grains of a rank are, and which of them another rank must know.
///
/// A rank needs every grain that may touch one of its own before rows are built anew. It tells the others the smallest
/// box around its grains and its largest radius; whoever has a grain within reach of that box sends it. This asks for
/// no order of sub-domains: ranks far apart, thin sub-domains and grains outside theirs are nothing special.
#pragma once

#include "neighbor/common_drift.hpp"
#include "neighbor/place.hpp"

namespace gpudem {

/// The grains of a rank, seen from the middle of its sub-domain.
struct RankExtent {
  double lo[3], hi[3];  ///< from the middle, the shorter way round a period (distance)
  double radius;        ///< largest (distance)
  VelocityRange velocity;
};
struct JoinRankExtents {
  GPUDEM_HD RankExtent operator()(const RankExtent &a, const RankExtent &b) const
  {
    RankExtent r;
    for (int d = 0; d < 3; ++d) {
      r.lo[d] = a.lo[d] < b.lo[d] ? a.lo[d] : b.lo[d];
      r.hi[d] = a.hi[d] > b.hi[d] ? a.hi[d] : b.hi[d];
    }
    r.radius = a.radius > b.radius ? a.radius : b.radius;
    r.velocity = JoinRanges{}(a.velocity, b.velocity);
    return r;
  }
};

template <class P>
struct GrainInRank {
  PositionArrays<P> position;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  Vec3<double> middle, period;
  GPUDEM_HD RankExtent operator()(std::uint32_t i) const
  {
    const FixedPosition p = loadPosition(position, i);
    const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
    RankExtent r;
    for (int d = 0; d < 3; ++d) r.lo[d] = r.hi[d] = shorterWay(x[d] - middle[d], period[d]);
    r.radius = p.radius;
    r.velocity = GrainVelocity<typename P::Real>{position.motion}(i);
    return r;
  }
};

/// The grains of another rank.
struct PartnerExtent {
  Vec3<double> middle, half;  ///< box around its grains (distance)
  double reach;               ///< its largest radius, skin and what else a row allows for (distance)
};

/// May a grain of \p radius at \p x touch a grain of \p r?
GPUDEM_HD bool mayReach(const PartnerExtent &r, const Vec3<double> &x, double radius, const Vec3<double> &period)
{
  double apart2 = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double apart = absolute(shorterWay(x[d] - r.middle[d], period[d])) - r.half[d];
    if (apart > 0.0) apart2 += apart * apart;
  }
  const double reach = r.reach + radius * 1.00001;
  return apart2 <= reach * reach;
}

template <class P>
struct SelectionView {
  PositionArrays<P> position;
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  Vec3<double> period;
  const PartnerExtent *partner;  ///< [partners]
  std::uint32_t partners;

  GPUDEM_HD bool reaches(std::uint32_t i, std::uint32_t from, std::uint32_t to) const
  {
    const FixedPosition p = loadPosition(position, i);
    const Vec3<double> x = absolutePosition(p, cell[i], grid, frame);
    for (std::uint32_t k = from; k < to; ++k)
      if (mayReach(partner[k], x, p.radius, period)) return true;
    return false;
  }
};

/// 1 for grains that any partner needs.
template <class P>
struct MarkBoundary {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  SelectionView<P> s;
  std::uint32_t *flag;
  GPUDEM_HD void operator()(std::uint32_t i) const { flag[i] = s.reaches(i, 0, s.partners) ? 1u : 0u; }
};
/// 1 for pairs of a partner and a grain of the boundary that it needs, partner by partner.
template <class P>
struct MarkSent {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  SelectionView<P> s;
  const std::uint32_t *boundary;
  std::uint32_t size;  ///< of the boundary
  std::uint32_t *flag;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const std::uint32_t partner = k / size;
    flag[k] = s.reaches(boundary[k % size], partner, partner + 1) ? 1u : 0u;
  }
};
/// The flagged of 0 .. n-1, or what \p value says of them, one after the other.
struct ListMarked {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *flag, *place;  ///< place: exclusive scan of flag
  const std::uint32_t *value;         ///< [size], null: k itself
  std::uint32_t size;
  std::uint32_t *out;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    if (flag[k]) out[place[k]] = value ? value[k % size] : k;
  }
};
/// Every \p stride-th number.
struct PickEvery {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *in;
  std::uint32_t stride;
  std::uint32_t *out;
  GPUDEM_HD void operator()(std::uint32_t k) const { out[k] = in[k * stride]; }
};

}  // namespace gpudem
