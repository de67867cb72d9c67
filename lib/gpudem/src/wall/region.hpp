// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file A region: the tree of its parts, and the contacts of a sphere with it.
///
/// As in LAMMPS, a contact with a member of a union counts where its point lies in no other member, one with a member
/// of an intersection where its point lies in all others; seen from outside the two change roles. An open shape
/// contains every point, and hides none of the contacts with the other members of a union.
#pragma once

#include "wall/region_prism.hpp"
#include "wall/region_round.hpp"
#include "wall/region_shape.hpp"

namespace gpudem {

struct RegionView {
  const RegionShape *part;
  const PartState *state;  ///< [parts], read where a part moves
  int parts;
};

struct RegionContact {
  Vec3<double> branch;  ///< from the contact point to the centre of the grain (distance)
  double curvature;     ///< as in SurfacePoint
  int number;           ///< of the face in the region, LAMMPS' iwall
  int part;
};

GPUDEM_HD bool isShape(const RegionShape &s)
{
  return s.kind != RegionKind::Union && s.kind != RegionKind::Intersect;
}

GPUDEM_HD Vec3<double> rotated(const RegionShape &s, const Vec3<double> &x, double cosine, double sine)
{
  const Vec3<double> arm = x - s.pivot, along = s.pivotAxis * dot(arm, s.pivotAxis), a = arm - along;
  return s.pivot + along + a * cosine + cross(s.pivotAxis, a) * sine;
}
/// From the box to where the part was defined, and back.
GPUDEM_HD Vec3<double> toPart(const RegionShape &s, const PartState &at, Vec3<double> x)
{
  if (s.moves) x -= at.displacement;
  return s.rotates ? rotated(s, x, at.cosine, -at.sine) : x;
}
GPUDEM_HD Vec3<double> fromPart(const RegionShape &s, const PartState &at, Vec3<double> x)
{
  if (s.rotates) x = rotated(s, x, at.cosine, at.sine);
  return s.moves ? x + at.displacement : x;
}

/// Is \p x, in the frame of the shape, in it or on its surface?
GPUDEM_HD bool contains(const RegionShape &s, const Vec3<double> &x)
{
  switch (s.kind) {
    case RegionKind::Block:
      return blockContains(s, x);
    case RegionKind::Prism:
      return prismLeastDepth(s, x) >= 0.0;
    case RegionKind::Sphere:
      return squaredDistance(x, s.centre) <= s.radius * s.radius;
    case RegionKind::Plane:
      return planeHeight(s, x) >= 0.0;
    default:
      return roundContains(s, axialPlace(s, x));
  }
}

/// Points of a shape that touch a sphere of radius \p reach around \p x, both in the frame of the shape.
GPUDEM_HD int surfacePoints(const RegionShape &s, const Vec3<double> &x, double reach, bool fromInside,
                            SurfacePoint *point)
{
  switch (s.kind) {
    case RegionKind::Block:
      return fromInside ? blockFromInside(s, x, reach, point) : blockFromOutside(s, x, reach, point);
    case RegionKind::Prism:
      return fromInside ? prismFromInside(s, x, reach, point) : prismFromOutside(s, x, reach, point);
    case RegionKind::Sphere:
      return spherePoint(s, x, reach, fromInside, point);
    case RegionKind::Plane:
      return planePoint(s, x, reach, fromInside, point);
    default:
      return fromInside ? roundFromInside(s, x, reach, point) : roundFromOutside(s, x, reach, point);
  }
}

/// No contact of the shape with a grain at \p x is nearer than this (distance).
GPUDEM_HD double surfaceDistance(const RegionShape &s, const Vec3<double> &x)
{
  switch (s.kind) {
    case RegionKind::Block:
      return blockDistance(s, x);
    case RegionKind::Prism:
      return absolute(prismLeastDepth(s, x));
    case RegionKind::Sphere:
      return absolute(squareRoot(squaredDistance(x, s.centre)) - s.radius);
    case RegionKind::Plane:
      return absolute(planeHeight(s, x));
    default:
      return roundDistance(s, x);
  }
}

/// Is \p x on the side of part \p k where grains are? \param turned the sides of part k are exchanged
GPUDEM_HD bool matches(const RegionView &g, int k, const Vec3<double> &x, bool turned)
{
  std::uint32_t match = 0;  // bit per part; members come after their union or intersection
  for (int j = k + g.part[k].size - 1; j >= k; --j) {
    const RegionShape &s = g.part[j];
    bool in = s.kind == RegionKind::Intersect;
    if (isShape(s)) {
      in = contains(s, toPart(s, g.state[j], x));
    } else {
      for (int c = j + 1; c < j + s.size; c += g.part[c].size) {
        const bool member = (match >> c & 1u) != 0;
        in = s.kind == RegionKind::Union ? in || member : in && member;
      }
    }
    if (s.open || in == (s.inside != (turned && j == k))) match |= 1u << j;
  }
  return (match >> k & 1u) != 0;
}

/// LAMMPS gives all faces that a member of a tree shows to its outside one number; from the second on they get one
/// here.
constexpr int ownNumbers = 6 * maxRegionParts;

/// Does the contact of part \p k at \p at count in the unions and intersections above it?
/// \param number of the face in the part; becomes its number in the region
GPUDEM_HD bool countsAbove(const RegionView &g, int k, const Vec3<double> &at, int &number)
{
  const int face = number;
  bool shared = false;
  for (int child = k, a = g.part[k].parent; a >= 0; child = a, a = g.part[a].parent) {
    const RegionShape &s = g.part[a], &c = g.part[child];
    const bool joins = (s.kind == RegionKind::Union) == s.listsInside;  // members hide each other's surfaces
    for (int j = a + 1; j < a + s.size; j += g.part[j].size)
      if (j != child && !(joins && g.part[j].open) && matches(g, j, at, !s.listsInside) == joins) return false;
    shared = shared || (!s.listsInside && number != 0);
    number = s.listsInside ? number + c.numberOffset : c.order;
  }
  if (shared) number = ownNumbers + maxSurfacePoints * k + face;
  return true;
}

/// Contacts of a sphere of radius \p reach around \p x with the region.
/// \return their number, at most maxRegionContacts + 1: then there are more than \p contact holds
GPUDEM_HD int regionContacts(const RegionView &g, const Vec3<double> &x, double reach, RegionContact *contact)
{
  if (!matches(g, 0, x, false)) return 0;
  int n = 0;
  for (int k = 0; k < g.parts; ++k) {
    const RegionShape &s = g.part[k];
    if (!isShape(s)) continue;
    const PartState &state = g.state[k];
    const Vec3<double> own = toPart(s, state, x);
    for (int side = 0; side < 2; ++side) {
      const bool fromInside = side == 1;
      if (!s.open && fromInside != s.listsInside) continue;
      SurfacePoint point[maxSurfacePoints];
      const int points = surfacePoints(s, own, reach, fromInside, point);
      for (int p = 0; p < points; ++p) {
        const Vec3<double> at = fromPart(s, state, point[p].at);
        const Vec3<double> branch = s.rotates ? x - at : own - point[p].at;
        int number = point[p].face;
        // a centre on the surface has no normal
        if (dot(branch, branch) == 0.0 || !countsAbove(g, k, at, number)) continue;
        if (n == maxRegionContacts) return n + 1;
        contact[n++] = {branch, point[p].curvature, number, k};
      }
    }
  }
  return n;
}

/// Velocity of the surface of part \p k at the point \p at of the box (distance/time).
GPUDEM_HD Vec3<double> surfaceVelocity(const RegionView &g, int k, const Vec3<double> &at)
{
  const RegionShape &s = g.part[k];
  const PartState &state = g.state[k];
  Vec3<double> v{0.0, 0.0, 0.0};
  if (s.moves) v = state.velocity;
  if (!s.turns) return v;
  Vec3<double> centre = s.pivot;
  if (s.moves) centre += state.displacement;
  return v + cross(s.pivotAxis * state.angularVelocity, at - centre);
}

}  // namespace gpudem
