// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Everything that stays constant between two events: laws, walls, force terms, integrators.
///
/// Units are those of the caller (LAMMPS' unit style); nothing in the library depends on them.
#pragma once

#include "gpudem/contact_model.h"
#include "gpudem/surface.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gpudem {

using Array3 = std::array<double, 3>;

enum class Precision { Double, Mixed };
enum class DeviceKind { Cpu, Gpu };

enum class NormalModel { Hooke, Hertz };
enum class TangentialModel { None, Viscous, Spring };

/// Spring-dashpot contact law of LAMMPS' gran/ styles; see contact/spring_dashpot.hpp for the formulas.
struct ContactLaw {
  NormalModel normal = NormalModel::Hooke;
  TangentialModel tangential = TangentialModel::None;
  double normalStiffness = 0;      ///< kn (force/distance; Hertz: force/distance^2)
  double tangentialStiffness = 0;  ///< kt (same units as kn)
  double normalDamping = 0;        ///< gamma_n (1/time; Hertz: 1/(time distance))
  double tangentialDamping = 0;    ///< gamma_t (same units as gamma_n)
  double friction = 0;             ///< Coulomb coefficient (-)
  bool limitDamping = false;       ///< clip the normal force at zero: no attraction from the dashpot

  bool hasHistory() const { return tangential == TangentialModel::Spring; }
};

enum class RegionKind { Block, Prism, Sphere, Cylinder, Cone, Plane, Union, Intersect };

/// One shape of a region, or the union or intersection of the parts that follow it. Conventions of LAMMPS' region
/// command; faces are numbered as its contacts are: block x- x+ y- y+ z- z+, prism z- z+ y- y+ x- x+, cylinder and cone
/// lower end, upper end, curved face.
struct RegionPart {
  RegionKind kind = RegionKind::Block;
  int size = 1;                    ///< parts of this subtree: itself and, for union and intersection, its members
  bool inside = true;              ///< grains are held inside (side in), false: outside
  bool open = false;               ///< keyword open was given: both sides of the closed faces act
  std::array<bool, 6> openFace{};  ///< by number
  Array3 lo{}, hi{};               ///< block, prism: corners; cylinder, cone: ends at lo[axis], hi[axis] (distance)
  Array3 tilt{};                   ///< prism: xy, xz, yz (distance)
  Array3 centre{};                 ///< of a sphere; point on the axis of cylinder and cone; point of a plane (distance)
  Array3 normal{};                 ///< plane: unit vector towards the inside
  int axis = 2;                    ///< of cylinder and cone
  double radius = 0;               ///< sphere, cylinder; cone at its lower end (distance)
  double radiusHi = 0;             ///< cone at its upper end (distance)
  bool moves = false;              ///< is displaced by PartMotion::displacement
  bool rotates = false;            ///< is turned by PartMotion::angle, before it is displaced
  Array3 pivot{}, pivotAxis{};     ///< a point on the axis of rotation (distance) and its unit vector
};

/// Most parts of one region wall: its kernel carries the motion of each.
constexpr int maxRegionParts = 16;
/// Most contacts of one grain with one region wall.
constexpr int maxRegionContacts = 16;

/// Most contacts of one grain with one surface of triangles.
constexpr int maxSurfaceSlots = 16;

enum class WallShape { Plane, Cylinder, Region, Surface };

/// One wall: a pair of planes normal to an axis, a cylinder around the z axis, a region, or a surface of triangles.
struct WallSpec {
  ContactLaw law;
  std::optional<ContactModel> model;  ///< takes the place of law if there is one
  WallShape shape = WallShape::Plane;
  int axis = 2;                                          ///< normal of the planes (0, 1, 2)
  double lo = -std::numeric_limits<double>::infinity();  ///< lower plane (distance), -inf if absent
  double hi = std::numeric_limits<double>::infinity();   ///< upper plane (distance), +inf if absent
  double radius = 0;                                     ///< cylinder (distance)
  std::uint32_t groupMask = ~0u;                         ///< grains that feel the wall
  bool wiggle = false;
  bool shear = false;
  int motionAxis = 0;              ///< direction of wiggle or shear
  double amplitude = 0;            ///< wiggle (distance)
  double angularFrequency = 0;     ///< wiggle (radian/time)
  std::int64_t stepOrigin = 0;     ///< step at which the wiggle starts
  double shearSpeed = 0;           ///< (distance/time)
  bool recordContacts = false;     ///< keep the eight columns of LAMMPS' "contacts" output
  std::vector<RegionPart> region;  ///< Region: the whole first, members after their union or intersection
  int mostContacts = 1;            ///< Region, Surface: contacts that one grain may have at a time
  std::shared_ptr<const SurfaceMesh> surface;    ///< Surface: cleaned, in the frame of the body
  SurfaceSide surfaceSide = SurfaceSide::Both;  ///< Surface: where the grains are
  bool recordTouches = false;                   ///< Surface: hand out every contact at events
};

enum class ForceTermKind { Gravity, Viscous, SetForce, Freeze, Enforce2d, Wall, RegionWall };

/// One entry of the ordered list of per-grain force terms (LAMMPS' order of fixes).
struct ForceTerm {
  ForceTermKind kind = ForceTermKind::Gravity;
  std::uint32_t groupMask = ~0u;
  Array3 value{};                    ///< gravity: acceleration; setforce: force
  std::array<bool, 3> prescribed{};  ///< setforce: which components are set
  int wall = -1;                     ///< Wall, RegionWall: index into SceneSpec::walls (a surface is a RegionWall)
  bool record = false;               ///< sum the force that stood here before the term (fix vector)
  std::vector<double> dragPerType;   ///< viscous: gamma of types 1..n at [1..n] (force time/distance)
};

enum class IntegratorKind { NveSphere, Prescribed, Rotate };

/// Who moves which grains. A grain belongs to at most one integrator.
struct IntegratorSpec {
  IntegratorKind kind = IntegratorKind::NveSphere;
  std::uint32_t groupMask = ~0u;
  double inertia = 0.4;              ///< moment of inertia / (m R^2): 2/5 sphere, 1/2 disc
  std::array<bool, 3> prescribed{};  ///< Prescribed: components that are not integrated
  bool wiggle = false;               ///< Prescribed: sinusoidal instead of linear
  Array3 vector{};                   ///< Prescribed: velocity (linear) or amplitude (wiggle)
  Array3 point{};                    ///< Rotate: a point on the axis
  Array3 axis{};                     ///< Rotate: unit vector
  double angularFrequency = 0;       ///< wiggle, Rotate (radian/time)
  std::int64_t stepOrigin = 0;       ///< step of the stored original positions
};

/// Pairs that are never neighbours (neigh_modify exclude).
struct Exclusions {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> groups;  ///< group bits, either order
  std::vector<std::pair<int, int>> types;                       ///< types, either order
  bool any() const { return !groups.empty() || !types.empty(); }
};

struct SceneSpec {
  ContactLaw pair;                       ///< one law for all types
  std::vector<ContactModel> pairModels;  ///< [types][types], takes the place of pair where not empty
  std::uint32_t frozenMask = 0;          ///< grains whose partner's mass alone is the effective mass
  std::vector<WallSpec> walls;
  std::vector<ForceTerm> terms;
  std::vector<IntegratorSpec> integrators;
  Exclusions exclusions;
  double timestep = 0;       ///< dt (time)
  double halfKick = 0;       ///< dt/2 times the conversion of force/mass to acceleration
  double skin = 0;           ///< neighbour skin (distance)
  double largestRadius = 0;  ///< of all grains present and to come (distance)
  int levels = 0;            ///< of grains by size, at most mostLevels; 0: as many as the sizes need
  double levelRatio = 0;     ///< of the largest radii of successive levels, where levels is 0; 0: what pays on the device
  int types = 1;
};

constexpr int mostLevels = 12;  ///< of grains by size

/// Limits of the tables that travel with every launch.
constexpr int maxWalls = 8;  ///< planes and cylinders; a region wall has a launch of its own
constexpr int maxTerms = 16;
constexpr int maxIntegrators = 4;
constexpr int maxGroupExclusions = 16;

/// Orthogonal box.
struct Box {
  Array3 lo{}, hi{};
  std::array<bool, 3> periodic{};
  int dimension = 3;  ///< 2: z is ignored by the neighbour search
};

}  // namespace gpudem
