// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file From the parts of a region and their motion to what a launch carries. Host code.
#pragma once

#include "gpudem/engine.h"
#include "gpudem/errors.h"
#include "step/scene_views.hpp"
#include "wall/region.hpp"

#include <cmath>
#include <vector>

namespace gpudem {

/// Faces of a shape by which contacts are numbered (LAMMPS' cmax).
inline int faceCount(RegionKind kind)
{
  switch (kind) {
    case RegionKind::Block:
    case RegionKind::Prism:
      return 6;
    case RegionKind::Cylinder:
    case RegionKind::Cone:
      return 3;
    default:
      return 1;
  }
}

/// Does the rotation leave the surface where it is? Round shapes on the axis, and planes across it.
inline bool turnsInPlace(const RegionPart &part)
{
  const Vec3<double> axis = toVec3(part.pivotAxis), arm = toVec3(part.centre) - toVec3(part.pivot);
  const Vec3<double> off = cross(axis, arm);
  const double scale = dot(arm, arm) + part.radius * part.radius + part.radiusHi * part.radiusHi;
  const bool onAxis = dot(off, off) <= 1e-28 * scale;
  switch (part.kind) {
    case RegionKind::Sphere:
      return onAxis;
    case RegionKind::Cylinder:
    case RegionKind::Cone:
      return onAxis && std::abs(axis[part.axis]) == 1.0;
    case RegionKind::Plane: {
      const Vec3<double> across = cross(axis, toVec3(part.normal));
      return dot(across, across) <= 1e-28;
    }
    default:
      return false;
  }
}

inline RegionShape shapeOf(const RegionPart &part)
{
  RegionShape s{};
  s.kind = part.kind;
  s.size = part.size;
  s.parent = -1;
  s.inside = s.listsInside = part.inside;
  s.open = part.open;
  s.moves = part.moves;
  s.turns = part.rotates;
  s.rotates = part.rotates && !turnsInPlace(part);
  for (int face = 0; face < 6; ++face) s.openFaces |= part.openFace[static_cast<std::size_t>(face)] ? 1u << face : 0u;
  s.axis = part.axis;
  s.lo = toVec3(part.lo);
  s.hi = toVec3(part.hi);
  s.tilt = toVec3(part.tilt);
  s.centre = toVec3(part.centre);
  s.normal = toVec3(part.normal);
  s.radius = part.radius;
  s.radiusHi = part.radiusHi;
  s.pivot = toVec3(part.pivot);
  s.pivotAxis = toVec3(part.pivotAxis);
  return s;
}

/// Parts with their places in the tree. \throws Error if the sizes do not make a tree
inline std::vector<RegionShape> regionShapes(const std::vector<RegionPart> &parts)
{
  const int count = static_cast<int>(parts.size());
  if (count == 0 || count > maxRegionParts || parts[0].size != count)
    throw Error("a region wall has " + std::to_string(count) + " parts (1 to " + std::to_string(maxRegionParts) +
                "), the first of which must hold all others");
  std::vector<RegionShape> shapes;
  for (const RegionPart &part : parts) shapes.push_back(shapeOf(part));
  std::vector<int> faces(parts.size());
  for (int k = count - 1; k >= 0; --k) {
    RegionShape &s = shapes[static_cast<std::size_t>(k)];
    faces[static_cast<std::size_t>(k)] = isShape(s) ? faceCount(s.kind) : 0;
    const int end = k + s.size;
    for (int c = k + 1; c < end; c += shapes[static_cast<std::size_t>(c)].size) {
      RegionShape &member = shapes[static_cast<std::size_t>(c)];
      member.parent = k;
      member.order = s.members++;
      member.numberOffset = faces[static_cast<std::size_t>(k)];
      faces[static_cast<std::size_t>(k)] += faces[static_cast<std::size_t>(c)];
      if (c + member.size > end) throw Error("a region wall's parts are not a tree");
    }
    if (isShape(s) != (s.members == 0)) throw Error("a region wall's unions need members, and its shapes none");
  }
  // seen from outside, the members show their other sides
  for (RegionShape &s : shapes)
    if (s.parent >= 0) s.listsInside = s.inside == shapes[static_cast<std::size_t>(s.parent)].listsInside;
  return shapes;
}

/// Does any surface of the region change its place?
inline bool sweeps(const std::vector<RegionShape> &shapes)
{
  for (const RegionShape &s : shapes)
    if (s.moves || s.rotates) return true;
  return false;
}

inline PartState partState(const PartMotion &motion)
{
  return {toVec3(motion.displacement), toVec3(motion.velocity), std::cos(motion.angle), std::sin(motion.angle),
          motion.angularVelocity};
}

}  // namespace gpudem
