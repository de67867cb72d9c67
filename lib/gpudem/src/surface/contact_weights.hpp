// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file How much each of several contacts of one sphere with one surface counts.
///
/// A sphere of radius R around a centre touches a surface where the distance from the centre has a local minimum
/// f < R. In the corner of a room each face has one, and each is a contact of its own. A curved wall made of facets has
/// as many minima beneath a deep enough sphere as facets, although it is one contact: counted in full they would double
/// the force when a facet comes within reach, and merging by an angle would make it jump. The weights below make a
/// continuous passage between the two cases.
///
/// Contact i with unit vector u_i towards the centre is replaced by its tangent plane, which cuts a disc of radius
/// a_i = sqrt(R^2 - f_i^2) out of the sphere. The planes of i and j meet in a line, which lies at the distance
///   L_ij = (f_j - f_i c) / sqrt(1 - c^2),   c = u_i . u_j,
/// from the middle of disc i. If L_ij >= a_i the discs do not overlap (then L_ji >= a_j too, since both say that the
/// line is outside the sphere) and the contacts are separate. If L_ji <= 0 contact j lies behind the plane of i: it is
/// hidden. A minimum that appears while the sphere moves does so on the border of its facet, on the plane of a nearer
/// contact, and so begins with L_ji = 0; one that appears by coming within reach begins with no overlap. With
///   K_ij = 1 - S(min(L_ij/a_i, L_ji/a_j)),        S(q) = q^2 (3 - 2 q) for 0 < q < 1,   1 the same, 0 separate
///   M_i = (R - f_i) prod over j deeper than i of max(0, L_ij/L_ji)
/// the weight w_i = M_i / sum_j K_ij M_j is 1 for separate contacts, sums to 1 over contacts that are the same, and is
/// 0 for a contact that appears or goes: the force sum_i w_i F_i has no jump. S makes the sum exceed 1 by the square of
/// the angle between facets only, the order of the error of the facets themselves. The force of a single plane, of
/// separate faces and of a convex edge is the exact one.
///
/// Known contact hierarchies (Kremmer and Favier, Int. J. Numer. Meth. Eng. 51 (2001) 1407; Hu, Hu, Fang and Zhang, Int.
/// J. Numer. Meth. Eng. 94 (2013) 787) decide whether an edge or a corner counts beside a face; local minima answer that
/// without a case list, and the weights add what a hierarchy lacks, continuity across facets of a concave wall.
#pragma once

#include "base/real.hpp"
#include "base/vec3.hpp"
#include "surface/triangle_point.hpp"

#include <cstdint>

namespace gpudem {

constexpr int maxSurfaceContacts = 12;

struct SurfaceContact {
  Vec3<double> normal;     ///< unit vector towards where the grain belongs
  double distance;         ///< from the surface to the centre; negative if the centre is inside a body (distance)
  double weight;           ///< 0 < weight <= 1, factor of the force
  std::uint32_t triangle;  ///< in SurfaceView::triangle
  Feature feature;         ///< of the triangle, on which the contact lies
};

/// Two contacts seen from each other.
struct ContactPair {
  double lineFromDeep, lineFromShallow;  ///< L_ij and L_ji, i the deeper one (distance)
  bool opposed;
};
GPUDEM_HD ContactPair seePair(const SurfaceContact &deep, const SurfaceContact &shallow)
{
  const Vec3<double> chord = deep.normal - shallow.normal;
  const double versine = 0.5 * dot(chord, chord);  // 1 - c without cancellation
  const double sine = squareRoot(versine * (2.0 - versine < 0.0 ? 0.0 : 2.0 - versine));
  const double step = shallow.distance - deep.distance;
  ContactPair p;
  p.opposed = versine > 1.999;
  p.lineFromDeep = (step + deep.distance * versine) / sine;
  p.lineFromShallow = (shallow.distance * versine - step) / sine;
  return p;
}

/// S above.
GPUDEM_HD double separateness(double q)
{
  return q <= 0.0 ? 0.0 : q >= 1.0 ? 1.0 : q * q * (3.0 - 2.0 * q);
}

/// max(0, min(1, L_ij/L_ji)) of a contact behind a deeper point of the surface.
GPUDEM_HD double prominence(const ContactPair &p)
{
  if (p.opposed || p.lineFromShallow >= p.lineFromDeep) return 1.0;
  return p.lineFromShallow <= 0.0 ? 0.0 : p.lineFromShallow / p.lineFromDeep;
}

/// Do any two of \p n contacts share a part of their discs, so that their weights are not 1?
/// \param[out] disc radii a_i (distance)
GPUDEM_HD bool findDiscs(const SurfaceContact *contact, int n, double reach, double *disc)
{
  bool overlap = false;
  for (int j = 0; j < n; ++j) {
    const double f = contact[j].distance;
    disc[j] = squareRoot((reach - f) * (reach + f));
    for (int i = 0; i < j; ++i) {
      const ContactPair p = seePair(contact[i], contact[j]);
      overlap = overlap || (!p.opposed && (p.lineFromDeep < disc[i] || p.lineFromShallow < disc[j]));
    }
  }
  return overlap;
}

/// Sets the weights of \p n contacts, deepest first, with different normals; those of no weight are dropped.
/// \param reach radius of the sphere, above every distance \param least [n] least prominence
/// \return number of contacts left
GPUDEM_HD int weighContacts(SurfaceContact *contact, int n, double reach, const double *disc, const double *least)
{
  double mass[maxSurfaceContacts], sum[maxSurfaceContacts];
  for (int j = 0; j < n; ++j) sum[j] = mass[j] = (reach - contact[j].distance) * least[j];
  for (int j = 1; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      const ContactPair p = seePair(contact[i], contact[j]);
      if (p.opposed) continue;
      const double qi = p.lineFromDeep / disc[i], qj = p.lineFromShallow / disc[j];
      const double same = 1.0 - separateness(qi < qj ? qi : qj);
      sum[i] += same * mass[j];
      sum[j] += same * mass[i];
    }
  constexpr double leastWeight = 1e-10;  // rounding of a contact that lies on another one's plane
  int left = 0;
  for (int i = 0; i < n; ++i) {
    if (!(mass[i] > leastWeight * sum[i])) continue;
    contact[left] = contact[i];
    contact[left++].weight = mass[i] / sum[i];
  }
  return left;
}

}  // namespace gpudem
