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
/// hidden. With
///   K_ij = 1 - S(min(L_ij/a_i, L_ji/a_j)),   S(q) = q^2 (3 - 2 q) for 0 < q < 1:   1 the same, 0 separate
///   rho_ij = max(0, min(1, L_ij/L_ji)),   j nearer than i:                         0 hidden, 1 as deep as j
///   M_i = (R - f_i) min_t rho_it,   H_i = max_t K_it (1 - rho_it)
/// where t runs over the nearest points of all triangles that are nearer than f_i, the weight is
///   w_i = M_i / max(sum_j K_ij M_j, H_i (R - f_i)),
/// 1 for separate contacts, with the sum 1 over contacts that are the same.
///
/// The force sum_i w_i F_i has no jump. A minimum comes and goes either at f = R, where its force is 0, or on the
/// border of its facet, from where the distance falls along another triangle t. That triangle is convex, so it lies
/// behind the tangent plane of its own nearest point, and with it the minimum: rho_it = 0 and K_it = 1, hence w_i = 0
/// and M_i = 0, and no other weight notices. Nearest points of triangles move continuously; where one becomes nearer
/// than f_i, rho_it = 1. The nearest contact of all has rho = 1 always.
///
/// S makes the sum exceed 1 by the square of the angle between facets only, the order of the error of the facets
/// themselves. The force of a plane, of separate faces and of a convex edge is exact, however they are cut into
/// triangles; where discs overlap and a weight is neither 0 nor 1 the cutting enters through t. The weighted force is
/// not the gradient of a potential.
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

constexpr int maxSurfaceContacts = 24;  ///< before those of no weight are dropped; few are left

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

/// Radius of the disc that the tangent plane at \p distance cuts out of the sphere (distance).
GPUDEM_HD double discRadius(double distance, double reach)
{
  return squareRoot((reach - distance) * (reach + distance));
}

/// K_ij above: 1 for contacts that are the same, 0 for separate ones.
GPUDEM_HD double sameness(const ContactPair &p, double deepDisc, double shallowDisc)
{
  if (p.opposed) return 0.0;
  const double qi = p.lineFromDeep / deepDisc, qj = p.lineFromShallow / shallowDisc;
  return 1.0 - separateness(qi < qj ? qi : qj);
}

/// Prominence of a contact among the nearer points of the surface.
struct Prominence {
  double least;   ///< min over them of rho = max(0, min(1, L_ij/L_ji)); M = (R - f) * least
  double hidden;  ///< max over them of K (1 - rho), which is H
};

/// Takes account of one more point that is nearer than the contact.
GPUDEM_HD void compareWith(const SurfaceContact &nearer, const SurfaceContact &contact, double reach, Prominence &p)
{
  const ContactPair pair = seePair(nearer, contact);
  if (pair.opposed || pair.lineFromShallow >= pair.lineFromDeep) return;
  const double rho = pair.lineFromShallow <= 0.0 ? 0.0 : pair.lineFromShallow / pair.lineFromDeep;
  const double same = sameness(pair, discRadius(nearer.distance, reach), discRadius(contact.distance, reach));
  if (rho < p.least) p.least = rho;
  if (same * (1.0 - rho) > p.hidden) p.hidden = same * (1.0 - rho);
}

/// Sets the weights of \p n contacts, deepest first, with different normals; those of no weight are dropped.
/// \param reach radius of the sphere, above every distance \param prominence [n]
/// \return number of contacts left
GPUDEM_HD int weighContacts(SurfaceContact *contact, int n, double reach, const Prominence *prominence)
{
  double mass[maxSurfaceContacts], sum[maxSurfaceContacts];
  for (int j = 0; j < n; ++j) sum[j] = mass[j] = (reach - contact[j].distance) * prominence[j].least;
  for (int j = 1; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      const double same = sameness(seePair(contact[i], contact[j]), discRadius(contact[i].distance, reach),
                                   discRadius(contact[j].distance, reach));
      sum[i] += same * mass[j];
      sum[j] += same * mass[i];
    }
  constexpr double leastWeight = 1e-10;  // rounding of a contact that lies on another one's plane
  int left = 0;
  for (int i = 0; i < n; ++i) {
    const double hider = (reach - contact[i].distance) * prominence[i].hidden;
    const double whole = sum[i] > hider ? sum[i] : hider;
    if (!(mass[i] > leastWeight * whole)) continue;
    contact[left] = contact[i];
    contact[left++].weight = mass[i] / whole;
  }
  return left;
}

}  // namespace gpudem
