// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "region_parts.h"

#include "formula.h"
#include "lammps_compat.h"

#include "domain.h"
#include "lammps.h"
#include "region.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_intersect.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"
#include "region_union.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>

using namespace LAMMPS_NS;
using gpudem::RegionKind;

namespace {

RegionKind kindOf(Region *region)
{
  if (dynamic_cast<RegUnion *>(region)) return RegionKind::Union;
  if (dynamic_cast<RegIntersect *>(region)) return RegionKind::Intersect;
  if (dynamic_cast<RegBlock *>(region)) return RegionKind::Block;
  if (dynamic_cast<RegPrism *>(region)) return RegionKind::Prism;
  if (dynamic_cast<RegSphere *>(region)) return RegionKind::Sphere;
  if (dynamic_cast<RegCylinder *>(region)) return RegionKind::Cylinder;
  if (dynamic_cast<RegCone *>(region)) return RegionKind::Cone;
  return RegionKind::Plane;
}

bool isTree(RegionKind kind)
{
  return kind == RegionKind::Union || kind == RegionKind::Intersect;
}

void copy(gpudem::Array3 &to, const double *from)
{
  std::copy_n(from, 3, to.begin());
}

/// Shape and place; the motion of a union is that of its members.
std::string describeShape(LAMMPS *lmp, Region *region, gpudem::RegionPart &part)
{
  GpudemCompat::RegionNumbers n{};
  if (!GpudemCompat::regionNumbers(region, n))
    return fmt::format("region {} is of style {}", region->id, region->style);
  if (region->varshape) return fmt::format("region {} changes its shape with a variable", region->id);
  copy(part.lo, n.lo);
  copy(part.hi, n.hi);
  copy(part.tilt, n.tilt);
  copy(part.centre, n.centre);
  copy(part.normal, n.normal);
  part.axis = n.axis;
  part.radius = n.radius;
  part.radiusHi = n.radiusHi;
  part.moves = region->moveflag != 0;
  part.rotates = region->rotateflag != 0;
  const GpudemCompat::RegionMotion motion = GpudemCompat::regionMotion(region);
  if (part.rotates) {
    copy(part.pivot, motion.pivot);
    copy(part.pivotAxis, motion.unit);
  }
  for (const char *name : motion.variable)
    if (name && !isHostFree(lmp, name, FormulaScope::StepOnly))
      return fmt::format("region {} moves with variable {}, which depends on more than the step", region->id, name);
  return "";
}

void append(LAMMPS *lmp, Region *region, RegionParts &to)
{
  const std::size_t at = to.parts.size();
  gpudem::RegionPart part;
  part.kind = kindOf(region);
  part.inside = region->interior != 0;
  part.open = region->openflag != 0;
  for (std::size_t face = 0; face < part.openFace.size(); ++face) part.openFace[face] = region->open_faces[face] != 0;
  if (!isTree(part.kind)) to.obstacle = describeShape(lmp, region, part);
  else if (part.open)
    to.obstacle = fmt::format("region {} is a {} with open faces of its own", region->id, region->style);
  to.parts.push_back(part);
  to.regions.push_back(region);
  if (isTree(part.kind))
    for (int k = 0; k < region->nregion && to.obstacle.empty(); ++k)
      append(lmp, lmp->domain->regions[region->list[k]], to);
  to.parts[at].size = static_cast<int>(to.parts.size() - at);
}

/// Bring the region to the present step: dx, theta, and the velocities by difference from the step before.
void advance(Update *update, Region *region)
{
  const bigint now = update->ntimestep;
  if (region->vel_timestep == now) return;
  if (!update->setupflag && region->vel_timestep != now - 1) {
    update->ntimestep = now - 1;
    region->prematch();
    update->ntimestep = now;
    const double before[4] = {region->dx, region->dy, region->dz, region->theta};
    std::copy_n(before, region->rotateflag ? 4 : 3, region->prev);
  }
  region->prematch();
  region->set_velocity();
}

}  // namespace

bool RegionParts::moves() const
{
  return std::any_of(parts.begin(), parts.end(), [](const gpudem::RegionPart &p) { return p.moves || p.rotates; });
}

RegionParts LAMMPS_NS::regionParts(LAMMPS *lmp, Region *region)
{
  RegionParts r;
  append(lmp, region, r);
  if (r.obstacle.empty() && r.parts.size() > gpudem::maxRegionParts)
    r.obstacle =
        fmt::format("region {} has {} parts, the device takes {}", region->id, r.parts.size(), gpudem::maxRegionParts);
  return r;
}

std::vector<gpudem::PartMotion> LAMMPS_NS::partMotions(LAMMPS *lmp, const std::vector<Region *> &regions)
{
  std::vector<gpudem::PartMotion> motions(regions.size());
  for (std::size_t k = 0; k < regions.size(); ++k) {
    Region *region = regions[k];
    if (!region->dynamic || isTree(kindOf(region))) continue;
    advance(lmp->update, region);
    gpudem::PartMotion &m = motions[k];
    if (region->moveflag) m.displacement = {region->dx, region->dy, region->dz};
    if (region->rotateflag) m.angle = region->theta;
    // a run begins at rest, as in LAMMPS where its difference is one; not so where the region was elsewhere before
    if (lmp->update->setupflag) continue;
    if (region->moveflag) copy(m.velocity, region->v);
    if (!region->rotateflag) continue;
    // LAMMPS multiplies the angular velocity by the axis as the script gives it, whatever its length
    const double *axis = GpudemCompat::regionMotion(region).axis, *w = region->omega;
    m.angularVelocity = (w[0] * axis[0] + w[1] * axis[1] + w[2] * axis[2]) /
                        (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  }
  return motions;
}
