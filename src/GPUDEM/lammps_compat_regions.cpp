// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "lammps_compat.h"

#include "lammps_expose.h"

#include "fix_wall_gran_region.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
using Triple = double[3];

GPUDEM_EXPOSE(WallRegion, FixWallGranRegion, Region *, region);
GPUDEM_EXPOSE(WallMost, FixWallGranRegion, int, tmax);
GPUDEM_EXPOSE(WallContacts, FixWallGranRegion, int *, ncontact);
GPUDEM_EXPOSE(WallFaces, FixWallGranRegion, int **, walls);
GPUDEM_EXPOSE(WallHistory, FixWallGranRegion, double ***, history_many);

GPUDEM_EXPOSE(RegionX, Region, char *, xstr);
GPUDEM_EXPOSE(RegionY, Region, char *, ystr);
GPUDEM_EXPOSE(RegionZ, Region, char *, zstr);
GPUDEM_EXPOSE(RegionTheta, Region, char *, tstr);
GPUDEM_EXPOSE(RegionPoint, Region, Triple, point);
GPUDEM_EXPOSE(RegionUnit, Region, Triple, runit);
GPUDEM_EXPOSE(RegionAxis, Region, Triple, axis);

GPUDEM_EXPOSE(BlockXlo, RegBlock, double, xlo);
GPUDEM_EXPOSE(BlockXhi, RegBlock, double, xhi);
GPUDEM_EXPOSE(BlockYlo, RegBlock, double, ylo);
GPUDEM_EXPOSE(BlockYhi, RegBlock, double, yhi);
GPUDEM_EXPOSE(BlockZlo, RegBlock, double, zlo);
GPUDEM_EXPOSE(BlockZhi, RegBlock, double, zhi);
GPUDEM_EXPOSE(PrismXlo, RegPrism, double, xlo);
GPUDEM_EXPOSE(PrismXhi, RegPrism, double, xhi);
GPUDEM_EXPOSE(PrismYlo, RegPrism, double, ylo);
GPUDEM_EXPOSE(PrismYhi, RegPrism, double, yhi);
GPUDEM_EXPOSE(PrismZlo, RegPrism, double, zlo);
GPUDEM_EXPOSE(PrismZhi, RegPrism, double, zhi);
GPUDEM_EXPOSE(PrismXy, RegPrism, double, xy);
GPUDEM_EXPOSE(PrismXz, RegPrism, double, xz);
GPUDEM_EXPOSE(PrismYz, RegPrism, double, yz);
GPUDEM_EXPOSE(SphereX, RegSphere, double, xc);
GPUDEM_EXPOSE(SphereY, RegSphere, double, yc);
GPUDEM_EXPOSE(SphereZ, RegSphere, double, zc);
GPUDEM_EXPOSE(SphereRadius, RegSphere, double, radius);
GPUDEM_EXPOSE(PlaneX, RegPlane, double, xp);
GPUDEM_EXPOSE(PlaneY, RegPlane, double, yp);
GPUDEM_EXPOSE(PlaneZ, RegPlane, double, zp);
GPUDEM_EXPOSE(PlaneNormal, RegPlane, Triple, normal);
GPUDEM_EXPOSE(CylinderAxis, RegCylinder, char, axis);
GPUDEM_EXPOSE(CylinderC1, RegCylinder, double, c1);
GPUDEM_EXPOSE(CylinderC2, RegCylinder, double, c2);
GPUDEM_EXPOSE(CylinderRadius, RegCylinder, double, radius);
GPUDEM_EXPOSE(CylinderLo, RegCylinder, double, lo);
GPUDEM_EXPOSE(CylinderHi, RegCylinder, double, hi);
GPUDEM_EXPOSE(ConeAxis, RegCone, char, axis);
GPUDEM_EXPOSE(ConeC1, RegCone, double, c1);
GPUDEM_EXPOSE(ConeC2, RegCone, double, c2);
GPUDEM_EXPOSE(ConeRadiusLo, RegCone, double, radiuslo);
GPUDEM_EXPOSE(ConeRadiusHi, RegCone, double, radiushi);
GPUDEM_EXPOSE(ConeLo, RegCone, double, lo);
GPUDEM_EXPOSE(ConeHi, RegCone, double, hi);

/// c1 and c2 are the coordinates across the axis, in the order x y z.
void setRound(GpudemCompat::RegionNumbers &n, char axis, double c1, double c2, double lo, double hi)
{
  n.axis = axis - 'x';
  n.centre[n.axis == 0 ? 1 : 0] = c1;
  n.centre[n.axis == 2 ? 1 : 2] = c2;
  n.lo[n.axis] = lo;
  n.hi[n.axis] = hi;
}

template <class... Tags, class R>
void copy(double *to, R *region, Tags... tags)
{
  ((*to++ = region->*reach(tags)), ...);
}
}  // namespace

GpudemCompat::RegionWall GpudemCompat::regionWall(FixWallGranRegion *fix)
{
  return {fix->*reach(WallRegion{}), fix->*reach(WallMost{}), fix->*reach(WallContacts{}), fix->*reach(WallFaces{})};
}

double ***&GpudemCompat::regionWallHistory(FixWallGranRegion *fix)
{
  return fix->*reach(WallHistory{});
}

GpudemCompat::RegionMotion GpudemCompat::regionMotion(Region *region)
{
  return {
      {region->*reach(RegionX{}), region->*reach(RegionY{}), region->*reach(RegionZ{}), region->*reach(RegionTheta{})},
      region->*reach(RegionPoint{}),
      region->*reach(RegionUnit{}),
      region->*reach(RegionAxis{})};
}

bool GpudemCompat::regionNumbers(Region *region, RegionNumbers &n)
{
  n = RegionNumbers{};
  if (auto *block = dynamic_cast<RegBlock *>(region)) {
    copy(n.lo, block, BlockXlo{}, BlockYlo{}, BlockZlo{});
    copy(n.hi, block, BlockXhi{}, BlockYhi{}, BlockZhi{});
  } else if (auto *prism = dynamic_cast<RegPrism *>(region)) {
    copy(n.lo, prism, PrismXlo{}, PrismYlo{}, PrismZlo{});
    copy(n.hi, prism, PrismXhi{}, PrismYhi{}, PrismZhi{});
    copy(n.tilt, prism, PrismXy{}, PrismXz{}, PrismYz{});
  } else if (auto *sphere = dynamic_cast<RegSphere *>(region)) {
    copy(n.centre, sphere, SphereX{}, SphereY{}, SphereZ{});
    n.radius = sphere->*reach(SphereRadius{});
  } else if (auto *plane = dynamic_cast<RegPlane *>(region)) {
    copy(n.centre, plane, PlaneX{}, PlaneY{}, PlaneZ{});
    std::copy_n(plane->*reach(PlaneNormal{}), 3, n.normal);
  } else if (auto *cylinder = dynamic_cast<RegCylinder *>(region)) {
    setRound(n, cylinder->*reach(CylinderAxis{}), cylinder->*reach(CylinderC1{}), cylinder->*reach(CylinderC2{}),
             cylinder->*reach(CylinderLo{}), cylinder->*reach(CylinderHi{}));
    n.radius = cylinder->*reach(CylinderRadius{});
  } else if (auto *cone = dynamic_cast<RegCone *>(region)) {
    setRound(n, cone->*reach(ConeAxis{}), cone->*reach(ConeC1{}), cone->*reach(ConeC2{}), cone->*reach(ConeLo{}),
             cone->*reach(ConeHi{}));
    n.radius = cone->*reach(ConeRadiusLo{});
    n.radiusHi = cone->*reach(ConeRadiusHi{});
  } else {
    return false;
  }
  return true;
}
