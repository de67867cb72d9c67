// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Force of a wall of triangles on a grain: every contact with the law of the wall, numbers of its own, and its
/// weight (surface/contact_weights.hpp).
#pragma once

#include "contact/scene_laws.hpp"
#include "surface/contact_identity.hpp"
#include "wall/analytic_wall.hpp"
#include "wall/body_pose.hpp"

namespace gpudem {

/// A surface at one step.
struct SurfaceAt {
  SurfaceView surface;
  BodyPose pose;
};

/// Contacts of one grain with one surface, [most][size]: direction in the frame of the body, then what the law keeps.
template <class Real>
struct SurfaceSlots {
  Real *first;
  int most, size;
  std::uint32_t inUse;  ///< a bit for each slot; the numbers of the others are zero

  GPUDEM_HD Real *at(int slot) const { return first + static_cast<std::size_t>(size) * slot; }
  GPUDEM_HD Vec3<double> direction(int slot) const
  {
    const Real *s = at(slot);
    return Vec3<Real>{s[0], s[1], s[2]}.template as<double>();
  }
  GPUDEM_HD bool used(int slot) const { return inUse >> slot & 1u; }
  GPUDEM_HD void clear(int slot)
  {
    for (int d = 0; d < size; ++d) at(slot)[d] = Real(0);
    inUse &= ~(1u << slot);
  }
};

/// The slots of a grain as its numbers \p kept tell them. \param wall maxSurfaceSlots contacts at most
template <class Real>
GPUDEM_HD SurfaceSlots<Real> slotsOf(Real *kept, int mostContacts, int historySize)
{
  SurfaceSlots<Real> slots{kept, mostContacts, historySize / mostContacts, 0u};
  for (int k = 0; k < mostContacts; ++k) {
    const Vec3<double> n = slots.direction(k);
    if (dot(n, n) > 0.5) slots.inUse |= 1u << k;
  }
  return slots;
}

enum class SurfaceTrouble : std::uint32_t {
  None,
  Crowded,  ///< more contacts than there are slots
  Crossed   ///< the centre went through a sheet since the last step
};

template <class Real>
struct SurfaceLoad {
  Vec3<Real> force, torque;
  SurfaceTrouble trouble;
};

/// Did the centre pass through a sheet? Then a contact turns up deep in the grain on the other side of an old one.
template <class Real>
GPUDEM_HD bool crossedSheet(const SurfaceSlots<Real> &slots, const SurfaceContact &now, double radius)
{
  if (now.distance > 0.5 * radius) return false;  // the far wall of a slot is about a radius away
  for (int k = 0; k < slots.most; ++k)
    if (slots.used(k) && dot(slots.direction(k), now.normal) < -0.9) return true;
  return false;
}

/// placeContacts() for one contact at most, now and before: what nearly all grains have.
template <class Real>
GPUDEM_HD void placeContact(SurfaceSlots<Real> &slots, const SurfaceContacts &c, double radius, bool checkSides,
                            int *slot, SurfaceTrouble &trouble)
{
  const int at = slots.inUse ? lowestBit(slots.inUse) : 0;
  if (c.count == 0) return slots.clear(at);
  const SurfaceContact &now = c.contact[0];
  if (slots.inUse) {
    const Vec3<double> old = slots.direction(at), chord = old - now.normal;
    if (!(dot(chord, chord) < identityChord2(c, radius))) {
      if (checkSides && crossedSheet(slots, now, radius)) trouble = SurfaceTrouble::Crossed;
      slots.clear(at);
    }
  }
  Real *kept = slots.at(at);
  for (int d = 0; d < directionNumbers; ++d) kept[d] = static_cast<Real>(now.normal[d]);
  slots.inUse = 1u << at;
  slot[0] = at;
}

/// Slots of the contacts: that of the contact each continues, or a free one, filled with a copy of what the contact
/// that it comes from keeps, or with zeros. Slots that no contact uses are cleared.
template <class Real>
GPUDEM_HD void placeContacts(SurfaceSlots<Real> &slots, const SurfaceContacts &c, double radius, bool checkSides,
                             int *slot, SurfaceTrouble &trouble)
{
  if (c.count == 0 && slots.inUse == 0) return;
  if (c.count <= 1 && (slots.inUse & (slots.inUse - 1)) == 0)
    return placeContact(slots, c, radius, checkSides, slot, trouble);
  Vec3<double> old[maxSurfaceSlots];
  for (int k = 0; k < slots.most; ++k)
    old[k] = slots.used(k) ? slots.direction(k) : Vec3<double>{1e3, 1e3, 1e3};  // far from every direction
  const double chord2 = identityChord2(c, radius);
  int from[maxSurfaceSlots];
  std::uint32_t claimed = 0;
  for (int k = 0; k < c.count; ++k) {
    from[k] = continuedContact(old, slots.most, c.contact[k], chord2);
    slot[k] = -1;
    if (from[k] < 0 && checkSides && crossedSheet(slots, c.contact[k], radius)) trouble = SurfaceTrouble::Crossed;
    if (from[k] < 0 || claimed >> from[k] & 1u) continue;
    slot[k] = from[k];
    claimed |= 1u << from[k];
  }
  for (int k = 0; k < c.count; ++k) {
    for (int free = 0; slot[k] < 0 && free < slots.most; ++free) {
      if (claimed >> free & 1u) continue;
      slot[k] = free;
      claimed |= 1u << free;
      for (int d = 0; d < slots.size; ++d) slots.at(free)[d] = from[k] < 0 ? Real(0) : slots.at(from[k])[d];
    }
    Real *kept = slots.at(slot[k]);
    for (int d = 0; d < directionNumbers; ++d) kept[d] = static_cast<Real>(c.contact[k].normal[d]);
  }
  for (int k = 0; k < slots.most; ++k)
    if (slots.used(k) && !(claimed >> k & 1u)) slots.clear(k);
  slots.inUse = claimed;
}

/// What the law is given of one contact.
template <class Real>
GPUDEM_HD Contact<Real> surfaceContact(const SurfaceContact &c, const Vec3<double> &normal, const Vec3<double> &surface,
                                       double radius, const Motion<Real> &m)
{
  // a centre on the surface, or behind it, is pushed along the normal all the same
  const double least = 1e-6 * radius, away = absolute(c.distance);
  const double distance = away > least ? away : least;
  Contact<Real> in{};
  in.branch = (normal * distance).template as<Real>();
  in.distance = static_cast<Real>(distance);
  in.inverseDistance = static_cast<Real>(1.0 / distance);
  in.overlap = static_cast<Real>(radius - c.distance);
  in.effectiveRadius = static_cast<Real>(radius);
  in.effectiveMass = m.mass;
  in.relativeVelocity = Vec3<Real>{m.vx, m.vy, m.vz} - surface.template as<Real>();
  in.surfaceSpin = Vec3<Real>{m.wx, m.wy, m.wz} * static_cast<Real>(radius);
  in.spinDifference = {m.wx, m.wy, m.wz};
  in.radiusDifference = -static_cast<Real>(radius);
  in.inertia = m.mass * static_cast<Real>(radius * radius);
  in.atWall = true;
  return in;
}

/// The law of a wall of triangles, chosen when it acts.
struct AnyWallLaw {
  static constexpr bool beyondTouch = true;
  template <class Real>
  GPUDEM_HD static ContactForce<Real> force(const WallView<Real> &wall, const Contact<Real> &c, Real *kept, Real dt,
                                            bool advance)
  {
    return wall.model ? modelWallForce(wall, c, kept, dt, advance) : classicWallForce(wall, c, kept, dt, advance);
  }
};
/// The same of a wall whose law is known to be this product.
template <class Law>
struct ModelWallLaw {
  static constexpr bool beyondTouch = Law::beyondTouch;
  template <class Real>
  GPUDEM_HD static ContactForce<Real> force(const WallView<Real> &wall, const Contact<Real> &c, Real *kept, Real dt,
                                            bool advance)
  {
    return modelWallForce<Law>(wall, c, kept, dt, advance);
  }
};
template <>
struct ModelWallLaw<AnyProduct> : AnyWallLaw {};

/// How far from the centre contacts hold: the radius, and farther where adhesive ones were there (distance).
template <class Law, class Real>
GPUDEM_HD double holdingReach(const WallView<Real> &wall, const SurfaceSlots<Real> &slots, double radius)
{
  bool holds = false;
  if (Law::beyondTouch && wall.flag) {
    holds = wall.model->beforeTouch;
    for (int k = 0; k < slots.most; ++k) holds = holds || (slots.used(k) && slots.at(k)[directionNumbers] != Real(0));
  }
  return radius + (holds ? static_cast<double>(AnyProduct::gap(*wall.model, static_cast<Real>(radius))) : 0.0);
}

/// One contact in \p touch.
template <class Real>
GPUDEM_HD void recordTouch(const SurfaceAt &s, const SurfaceContact &contact, const Vec3<double> &normal,
                           const Vec3<double> &at, const Contact<Real> &in, const Vec3<Real> &force,
                           const Vec3<Real> &torque, SurfaceTouch &touch)
{
  const Vec3<Real> n = normal.template as<Real>();
  const Vec3<Real> sliding = in.relativeVelocity - n * dot(n, in.relativeVelocity) - cross(in.surfaceSpin, n);
  touch.triangle = s.surface.triangle[contact.triangle].original;
  touch.slip = static_cast<double>(squareRoot(dot(sliding, sliding)));
  touch.push = static_cast<double>(dot(n, force));
  const Vec3<double> couple = torque.template as<double>() +
                              cross(normal * contact.distance, force.template as<double>());
  for (int d = 0; d < 3; ++d) {
    touch.place[d] = at[d];
    touch.force[d] = -static_cast<double>(force[d]);
    touch.couple[d] = -couple[d];
  }
}

/// A grain at a surface.
template <class Real>
struct GrainAtSurface {
  std::uint32_t index;
  Vec3<double> x, inBody;  ///< the centre, also in the frame of the body (distance)
  double radius;
  Motion<Real> motion;
};

/// Force and torque of one contact, with its weight.
template <class Real>
struct ContactLoad {
  Vec3<Real> force, torque;
  bool acts;  ///< no: it was found because the neck of another one made the search reach farther
};

/// What one contact keeps is updated.
/// \param slot of the contact \param touch of the contact, or null
template <class Law, class Real>
GPUDEM_HD ContactLoad<Real> contactLoad(const WallView<Real> &wall, const SurfaceAt &s, const SurfaceSlots<Real> &slots,
                                        int slot, const SurfaceContact &contact, const GrainAtSurface<Real> &g, Real dt,
                                        bool advance, SurfaceTouch *touch)
{
  ContactLoad<Real> load{};
  Real *kept = slots.size > directionNumbers ? slots.at(slot) + directionNumbers : nullptr;
  if (Law::beyondTouch && wall.flag && contact.distance >= g.radius && kept[0] == Real(0) && !wall.model->beforeTouch)
    return load;
  const Vec3<double> normal = s.pose.turned(contact.normal), at = g.x - normal * contact.distance;
  const Contact<Real> in = surfaceContact(contact, normal, s.pose.velocityAt(at), g.radius, g.motion);
  const ContactForce<Real> f = Law::force(wall, in, kept, dt, advance);
  const Real weight = static_cast<Real>(contact.weight);
  load.acts = true;
  load.force = f.force * weight;
  load.torque = (f.moment - f.couple * (static_cast<Real>(g.radius) - f.shorter)) * weight;
  if (touch) recordTouch(s, contact, normal, at, in, load.force, load.torque, *touch);
  return load;
}

/// Find a slot for each of the contacts, if there is room for all.
template <class Real>
GPUDEM_HD SurfaceTrouble takeSlots(const SurfaceAt &s, SurfaceSlots<Real> &slots, SurfaceContacts &c, double radius,
                                   int *slot)
{
  SurfaceTrouble trouble = SurfaceTrouble::None;
  if (c.count > slots.most) {
    trouble = SurfaceTrouble::Crowded;
    c.count = slots.most;
  }
  placeContacts(slots, c, radius, s.surface.side == 0, slot, trouble);
  return trouble;
}

/// Sum over the contacts; the recorded one is the deepest. \param of(k) load of contact \p k
template <class Real, class Load>
GPUDEM_HD SurfaceLoad<Real> sumOfContacts(const WallView<Real> &wall, const SurfaceAt &s, SurfaceSlots<Real> &slots,
                                          const SurfaceContacts &c, const int *slot, const GrainAtSurface<Real> &g,
                                          std::uint32_t count, SurfaceTrouble trouble, const Load &of)
{
  const Vec3<Real> none{Real(0), Real(0), Real(0)};
  SurfaceLoad<Real> load{none, none, trouble};
  for (int k = c.count - 1; k >= 0; --k) {
    const ContactLoad<Real> l = of(k);
    if (!l.acts) {
      slots.clear(slot[k]);
      continue;
    }
    load.force += l.force;
    load.torque += l.torque;
    if (!wall.contacts) continue;
    const Vec3<double> at = g.x - s.pose.turned(c.contact[k].normal) * c.contact[k].distance;
    recordContact(wall, g.index, count, l.force, at, g.radius);
  }
  return load;
}

/// Force and torque of all contacts; what they keep and the recorded contact (the deepest) are updated.
/// \param list where to look, see surfaceContacts() \param count grains in all
/// \param touch [mostContacts] all contacts, those without force left as they are; null if not wanted
template <class Law = AnyWallLaw, class Real>
GPUDEM_HD SurfaceLoad<Real> surfaceLoad(const WallView<Real> &wall, const SurfaceAt &s, SurfaceSlots<Real> &slots,
                                        const GrainAtSurface<Real> &g, std::uint32_t count, Real dt, bool advance,
                                        const NearList &list, SurfaceTouch *touch)
{
  SurfaceContacts c;
  surfaceContacts(s.surface, g.inBody, holdingReach<Law>(wall, slots, g.radius), c, list);
  int slot[maxSurfaceSlots];
  const SurfaceTrouble trouble = takeSlots(s, slots, c, g.radius, slot);
  return sumOfContacts(wall, s, slots, c, slot, g, count, trouble, [&](int k) {
    return contactLoad<Law>(wall, s, slots, slot[k], c.contact[k], g, dt, advance, touch ? touch + k : nullptr);
  });
}

}  // namespace gpudem
