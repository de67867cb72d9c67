// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the contact laws of a scene keep and how far they reach. Host code.
#pragma once

#include "gpudem/scene.h"

#include <algorithm>

namespace gpudem {

/// Layout of a law of LAMMPS' gran/ styles: the tangential spring or nothing.
inline HistoryLayout historyLayout(const ContactLaw &law)
{
  HistoryLayout layout;
  if (!law.hasHistory()) return layout;
  layout.size = layout.length[static_cast<int>(ModelSlot::Tangential)] = 3;
  layout.mirror.assign(3, -1);
  return layout;
}

/// Numbers that the pairs of a scene keep per contact.
inline HistoryLayout pairLayout(const SceneSpec &scene)
{
  return scene.pairModels.empty() ? historyLayout(scene.pair) : historyLayout(scene.pairModels);
}

/// Do contacts outlive touch?
inline bool pairsReachBeyond(const SceneSpec &scene)
{
  return std::any_of(scene.pairModels.begin(), scene.pairModels.end(), reachesBeyondTouch);
}

/// Largest gap across which two grains of the scene pull on each other (distance).
inline double largestPullOffGap(const SceneSpec &scene)
{
  double gap = 0.0;
  for (const ContactModel &model : scene.pairModels) gap = std::max(gap, pullOffGap(model, 0.5 * scene.largestRadius));
  return gap;
}

constexpr double widestFit = 10.0;  ///< largest effective radius at a region, in radii of the grain

/// Largest gap across which a wall pulls on a grain of the scene (distance). Inside a cylinder the effective radius of
/// a grain that fits is up to twice its radius.
inline double wallPullOffGap(const WallSpec &wall, double largestRadius)
{
  if (!wall.model) return 0.0;
  const bool flat = wall.shape == WallShape::Plane || wall.shape == WallShape::Surface;
  const double fit = flat ? 1.0 : wall.shape == WallShape::Cylinder ? 2.0 : widestFit;
  return pullOffGap(*wall.model, fit * largestRadius);
}

/// How far a surface may move until the grains near it are looked for anew (distance).
inline double surfaceRoom(const SceneSpec &scene)
{
  return scene.skin;
}
constexpr double widestSkin = 3.0;  ///< to which a GPU widens the skin of rows, in skins of the script
/// Largest gap within which a grain may count as near a surface: what the wall pulls across, what the surface may move,
/// and what the grain may while the rows have skins up to \p skin (distance).
inline double surfaceMargin(const WallSpec &wall, const SceneSpec &scene, double skin)
{
  constexpr double grainSkins = 3.0;  // from half a skin here to half a skin there; CommonDrift::room() is two at most
  return wallPullOffGap(wall, scene.largestRadius) + grainSkins * skin + surfaceRoom(scene);
}

/// Numbers that a wall keeps per contact, without the flag of adhesion.
inline HistoryLayout wallLayout(const WallSpec &wall)
{
  return wall.model ? historyLayout(std::vector<ContactModel>{*wall.model}) : historyLayout(wall.law);
}
/// 1 if the wall's numbers begin with a flag that says whether the grain is in contact.
inline int wallFlag(const WallSpec &wall)
{
  return wall.model && reachesBeyondTouch(*wall.model) ? 1 : 0;
}
constexpr int directionNumbers = 3;  ///< of a contact with a surface: its unit vector, 0 where there is none
/// Numbers that a wall keeps per grain: those of its contact, or the slots of all contacts with a region or a surface.
inline int wallKeeps(const WallSpec &wall)
{
  const int contact = wallFlag(wall) + wallLayout(wall).size;
  if (wall.shape == WallShape::Surface) return wall.mostContacts * (directionNumbers + contact);
  if (wall.shape != WallShape::Region) return contact;
  return contact ? wall.mostContacts * (1 + contact) : 0;
}

}  // namespace gpudem
