// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Force of a region wall on a grain: every contact with the law of the wall and numbers of its own.
#pragma once

#include "contact/scene_laws.hpp"
#include "wall/analytic_wall.hpp"
#include "wall/region.hpp"

namespace gpudem {

/// Contacts of one grain with one wall, [most][size]: the number of the face plus one, then what the law keeps.
template <class Real>
struct ContactSlots {
  Real *first;  ///< null if the law keeps nothing
  int most, size;

  GPUDEM_HD Real *at(int slot) const { return first + static_cast<std::size_t>(size) * slot; }
  /// Slot of the contact with face \p number, -1 if there was none.
  GPUDEM_HD int find(int number) const
  {
    for (int k = 0; first && k < most; ++k)
      if (at(k)[0] == static_cast<Real>(number + 1)) return k;
    return -1;
  }
  /// Forget the contacts whose bit in \p keep is not set.
  GPUDEM_HD void clearExcept(std::uint32_t keep) const
  {
    for (int k = 0; first && k < most; ++k)
      for (int d = 0; !(keep >> k & 1u) && d < size; ++d) at(k)[d] = Real(0);
  }
};

template <class Real>
struct RegionLoad {
  Vec3<Real> force, torque;
  bool crowded;  ///< more contacts than there are slots
};

/// Bounded: a surface more hollow than the grain is round would make it infinite or negative (distance).
GPUDEM_HD double regionEffectiveRadius(double radius, double curvature)
{
  const double effective = wallEffectiveRadius(radius, curvature);
  return effective > 0.0 && effective < widestFit * radius ? effective : widestFit * radius;
}

/// Force and torque of all contacts; what they keep and the recorded contact (the last, as in LAMMPS) are updated.
/// \param pull gap beyond which no contact of this wall holds (distance)
template <class Real>
GPUDEM_HD RegionLoad<Real> regionLoad(const WallView<Real> &wall, const RegionView &region,
                                      const ContactSlots<Real> &slots, std::uint32_t i, std::uint32_t count,
                                      const Vec3<double> &x, double radius, double pull, const Motion<Real> &m, Real dt,
                                      bool advance)
{
  RegionContact contact[maxRegionContacts];
  int slot[maxRegionContacts];
  const Vec3<Real> none{Real(0), Real(0), Real(0)};
  RegionLoad<Real> load{none, none, false};

  const int near = regionContacts(region, x, radius + (wall.flag ? pull : 0.0), contact);
  if (near > maxRegionContacts) load.crowded = true;
  int n = 0;
  std::uint32_t kept = 0;
  for (int c = 0; c < near && c < maxRegionContacts; ++c) {
    const double distance = squareRoot(dot(contact[c].branch, contact[c].branch));
    const int old = slots.find(contact[c].number);
    double reach = radius;
    if (wall.flag && old >= 0 && slots.at(old)[1] != Real(0))
      reach += static_cast<double>(
          AnyProduct::gap(*wall.model, static_cast<Real>(regionEffectiveRadius(radius, contact[c].curvature))));
    if (distance >= reach) continue;
    if (old >= 0) kept |= 1u << old;
    contact[n] = contact[c];
    slot[n++] = old;
  }
  slots.clearExcept(kept);
  if (n > slots.most) load.crowded = true;

  for (int c = 0; c < n && c < slots.most; ++c) {
    const RegionContact &k = contact[c];
    Real *numbers = nullptr;
    if (slots.first) {
      for (int free = 0; slot[c] < 0 && free < slots.most; ++free)
        if (!(kept >> free & 1u)) slot[c] = free;
      if (slot[c] < 0) break;
      kept |= 1u << slot[c];
      numbers = slots.at(slot[c]);
      *numbers++ = static_cast<Real>(k.number + 1);
    }
    const double distance = squareRoot(dot(k.branch, k.branch));
    const Vec3<double> at = x - k.branch;
    Contact<Real> in{};
    in.branch = k.branch.template as<Real>();
    in.distance = static_cast<Real>(distance);
    in.inverseDistance = static_cast<Real>(1.0 / distance);
    in.overlap = static_cast<Real>(radius - distance);
    in.effectiveRadius = static_cast<Real>(regionEffectiveRadius(radius, k.curvature));
    in.effectiveMass = m.mass;
    in.relativeVelocity = Vec3<Real>{m.vx, m.vy, m.vz} - surfaceVelocity(region, k.part, at).template as<Real>();
    in.surfaceSpin = Vec3<Real>{m.wx, m.wy, m.wz} * static_cast<Real>(radius);
    in.spinDifference = {m.wx, m.wy, m.wz};
    in.radiusDifference = -static_cast<Real>(radius);
    in.inertia = m.mass * static_cast<Real>(radius * radius);
    in.atWall = true;
    const ContactForce<Real> f =
        wall.model ? modelWallForce(wall, in, numbers, dt, advance) : classicWallForce(wall, in, numbers, dt, advance);
    load.force += f.force;
    load.torque += f.moment - f.couple * (static_cast<Real>(radius) - f.shorter);
    if (wall.contacts) recordContact(wall, i, count, f.force, at, radius);
  }
  return load;
}

}  // namespace gpudem
