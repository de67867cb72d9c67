// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Which contact of the last step a contact continues, so that springs live on.
///
/// Two contacts of one grain with one surface differ in their direction (contact_weights.hpp), and the direction changes
/// little in a step, also where the grain rolls from triangle to triangle. So the direction, in the frame of the body,
/// is a contact's identity, whatever the triangles are. A contact that appears beside another one, because the next
/// facet of a concave wall comes within reach, begins with weight 0 and takes over a copy of its spring; when the old
/// one's weight has gone to 0, the spring has moved on to the next facet undiminished.
#pragma once

#include "surface/surface_contacts.hpp"

namespace gpudem {

/// Largest squared chord between the directions of a contact in two steps, for \p contacts of a sphere of radius
/// \p reach. A contact appears on the tangent plane of a deeper one, at an angle whose sine is at most a/R, a the radius
/// of the disc that the deepest plane cuts out of the sphere; and a grain that rolls over an edge turns between two
/// steps. Never from one face of a corner to another.
GPUDEM_HD double identityChord2(const SurfaceContacts &contacts, double reach)
{
  constexpr double least = 0.01, most = 0.5;
  const double ratio = contacts.count > 0 ? contacts.contact[0].distance / reach : 1.0;
  const double chord2 = 1.5 * (1.0 - ratio * ratio);
  return chord2 < least ? least : chord2 > most ? most : chord2;
}

/// Index of the contact of the last step that \p now continues, or -1.
/// \param old [n] directions of the last step's contacts \param chord2 from identityChord2()
GPUDEM_HD int continuedContact(const Vec3<double> *old, int n, const SurfaceContact &now, double chord2)
{
  double best = chord2;
  int found = -1;
  for (int i = 0; i < n; ++i) {
    const Vec3<double> chord = old[i] - now.normal;
    const double d2 = dot(chord, chord);
    if (d2 < best) {
      best = d2;
      found = i;
    }
  }
  return found;
}

}  // namespace gpudem
