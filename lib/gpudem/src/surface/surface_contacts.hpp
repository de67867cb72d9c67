// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contacts of a sphere with a surface of triangles.
#pragma once

#include "surface/contact_weights.hpp"
#include "surface/near_list.hpp"

namespace gpudem {

struct SurfaceContacts {
  SurfaceContact contact[maxSurfaceContacts];  ///< deepest first
  int count;
  bool overflow;  ///< there were more minima than room; the deepest are kept
};

/// Does the neighbour's corner \p v lie farther than the point at \p branch from the centre, that is, does the distance
/// not fall on the way there? The tolerance finds the foot on a flat edge, which rounding may put beyond both faces.
GPUDEM_HD bool risesTowards(const Vec3<double> &v, const Vec3<double> &branch)
{
  const Vec3<double> way = v + branch;  // v is relative to the centre
  const double along = dot(branch, way);
  return along <= 0.0 || along * along <= 1e-18 * dot(branch, branch) * dot(way, way);
}

/// Is the nearest point of triangle \p t a minimum of the distance among all points of the surface nearby?
GPUDEM_HD bool isMinimum(const SurfaceView &s, const SurfaceTriangle &t, const TrianglePoint &p, const Vec3<double> &x)
{
  if (p.feature == Feature::Face) return true;
  if (p.feature >= Feature::Corner0) {
    const std::uint32_t v = t.corner[static_cast<int>(p.feature) - static_cast<int>(Feature::Corner0)];
    for (std::uint32_t k = s.spokeStart[v]; k < s.spokeStart[v + 1]; ++k)
      if (!risesTowards(s.vertex[s.spoke[k]] - x, p.branch)) return false;
    return true;
  }
  const std::uint32_t across = t.across[static_cast<int>(p.feature) - static_cast<int>(Feature::Edge0)];
  if (across == ownFace) return true;
  if (!(across & manyFaces)) return risesTowards(s.vertex[across] - x, p.branch);
  const std::uint32_t *fan = s.fan + (across & ~manyFaces);
  for (std::uint32_t k = 1; k <= fan[0]; ++k)
    if (!risesTowards(s.vertex[fan[k]] - x, p.branch)) return false;
  return true;
}

/// Normal of the face, not of unit length.
GPUDEM_HD Vec3<double> faceNormal(const SurfaceView &s, const SurfaceTriangle &t)
{
  const Vec3<double> a = s.vertex[t.corner[0]];
  return cross(s.vertex[t.corner[1]] - a, s.vertex[t.corner[2]] - a);
}

/// Pseudonormal of a feature of triangle \p k.
GPUDEM_HD Vec3<double> pseudonormal(const SurfaceView &s, std::uint32_t k, Feature feature)
{
  const SurfaceTriangle &t = s.triangle[k];
  if (feature == Feature::Face) return faceNormal(s, t);
  if (feature >= Feature::Corner0)
    return s.vertexNormal[t.corner[static_cast<int>(feature) - static_cast<int>(Feature::Corner0)]].as<double>();
  return s.edgeNormal[3 * k + static_cast<std::uint32_t>(feature) - static_cast<std::uint32_t>(Feature::Edge0)]
      .as<double>();
}

/// Squared chord between directions that are the same up to rounding.
constexpr double sameDirection2 = 1e-14;

/// Minima found so far, deepest first.
class MinimumList {
 public:
  GPUDEM_HD explicit MinimumList(SurfaceContacts &out) : out_(out)
  {
    out.count = 0;
    out.overflow = false;
  }
  /// A minimum in the direction of one in the list is the same point, or hidden: the nearer stays.
  GPUDEM_HD void add(const SurfaceContact &c)
  {
    for (int i = 0; i < out_.count; ++i) {
      const Vec3<double> chord = out_.contact[i].normal - c.normal;
      if (dot(chord, chord) > sameDirection2) continue;
      const SurfaceContact &old = out_.contact[i];
      if (c.distance > old.distance || (c.distance == old.distance && c.triangle >= old.triangle)) return;
      for (int k = i; k + 1 < out_.count; ++k) out_.contact[k] = out_.contact[k + 1];
      --out_.count;
      break;
    }
    int at = out_.count;
    while (at > 0 && before(c, out_.contact[at - 1])) --at;
    if (out_.count == maxSurfaceContacts) {
      out_.overflow = true;
      if (at == maxSurfaceContacts) return;
      --out_.count;
    }
    for (int k = out_.count; k > at; --k) out_.contact[k] = out_.contact[k - 1];
    out_.contact[at] = c;
    ++out_.count;
  }

 private:
  GPUDEM_HD static bool before(const SurfaceContact &a, const SurfaceContact &b)
  {
    return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
  }
  SurfaceContacts &out_;
};

/// Is the centre behind the contact's feature?
GPUDEM_HD bool onWrongSide(const SurfaceView &s, const SurfaceContact &c)
{
  return dot(pseudonormal(s, c.triangle, c.feature), c.normal) * s.side < 0.0;
}

/// Sides of closed bodies. A centre inside is pushed out through the nearest point, the way it came in; seen from
/// outside, faces that look away belong to the far side of a thin part.
GPUDEM_HD void chooseSides(const SurfaceView &s, SurfaceContacts &out)
{
  if (out.count == 0) return;
  if (onWrongSide(s, out.contact[0])) {
    out.count = 1;
    out.contact[0].normal = out.contact[0].normal * -1.0;
    out.contact[0].distance = -out.contact[0].distance;
    return;
  }
  int left = 1;
  for (int i = 1; i < out.count; ++i)
    if (!onWrongSide(s, out.contact[i])) out.contact[left++] = out.contact[i];
  out.count = left;
}

/// The contact at the nearest point \p p of triangle \p k, where the distance has a minimum.
GPUDEM_HD SurfaceContact contactAt(const SurfaceView &s, std::uint32_t k, const TrianglePoint &p, double distance)
{
  SurfaceContact c;
  c.weight = 1.0;
  c.triangle = k;
  c.feature = p.feature;
  c.distance = distance;
  if (distance > 0.0) {
    c.normal = p.branch * (1.0 / distance);
  } else {  // the centre is on the surface
    const Vec3<double> n = faceNormal(s, s.triangle[k]);
    c.normal = n * ((s.side < 0 ? -1.0 : 1.0) / squareRoot(dot(n, n)));
  }
  return c;
}

/// How far each contact stands out from the tangent planes of the nearest points of all triangles that are nearer.
GPUDEM_HD void findProminence(const SurfaceView &s, const NearList &list, const Vec3<double> &x, double reach,
                              const SurfaceContacts &c, Prominence *prominence)
{
  for (int j = 0; j < c.count; ++j) prominence[j] = {1.0, 0.0};
  const auto compare = [&](std::uint32_t k, const TrianglePoint &p, double distance2) {
    if (distance2 == 0.0) return true;
    SurfaceContact nearer;
    nearer.triangle = k;
    nearer.distance = squareRoot(distance2);
    nearer.normal = p.branch * (1.0 / nearer.distance);
    for (int j = c.count - 1; j > 0 && c.contact[j].distance > nearer.distance; --j) {
      const Vec3<double> chord = c.contact[j].normal - nearer.normal;
      if (dot(chord, chord) > sameDirection2) compareWith(nearer, c.contact[j], reach, prominence[j]);
    }
    return true;
  };
  visitListed(s, list, x, c.contact[c.count - 1].distance, compare);
}

/// Contacts of a sphere of radius \p reach around \p x with the surface, with their weights.
/// \param list from listNear() with this reach and as much more as the centre has moved since
/// \pre reach <= s.reach
GPUDEM_HD void surfaceContacts(const SurfaceView &s, const Vec3<double> &x, double reach, SurfaceContacts &out,
                               const NearList &list = {})
{
  MinimumList minima(out);
  visitListed<Wanted::Minima>(s, list, x, reach, [&](std::uint32_t k, const TrianglePoint &p, double distance2) {
    if (isMinimum(s, s.triangle[k], p, x)) minima.add(contactAt(s, k, p, squareRoot(distance2)));
    return true;
  });
  if (s.side != 0) chooseSides(s, out);
  if (out.count < 2) return;
  Prominence prominence[maxSurfaceContacts];
  findProminence(s, list, x, reach, out, prominence);
  out.count = weighContacts(out.contact, out.count, reach, prominence);
}

}  // namespace gpudem
