// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/surface_wall.h"

#include "contact/derive.hpp"
#include "step/scene_views.hpp"
#include "wall/surface_wall.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gpudem {

struct SurfaceWall::Parts {
  WallSpec spec;
  ModelCoefficients<double> model{};
  std::unique_ptr<Surface> surface;
  std::vector<double> columns;

  void reachAtLeast(double reach)
  {
    if (!surface || surface->reach() < reach)
      surface = std::make_unique<Surface>(*spec.surface, 1.01 * reach, spec.surfaceSide);
  }
  WallView<double> view() const
  {
    WallView<double> wall = wallAt<double>(spec, Roles{}, 0, 0.0);
    wall.historySize = wallKeeps(spec);
    if (!spec.model) return wall;
    wall.model = &model;
    wall.layout = layoutView(wallLayout(spec));
    wall.flag = wallFlag(spec);
    return wall;
  }
};

namespace {

Vec3<double> vectorAt(const double *a, std::size_t i)
{
  return {a[3 * i], a[3 * i + 1], a[3 * i + 2]};
}
void addAt(double *a, std::size_t i, const Vec3<double> &v)
{
  for (int d = 0; d < 3; ++d) a[3 * i + static_cast<std::size_t>(d)] += v[d];
}

void complain(SurfaceTrouble trouble, int tag)
{
  if (trouble == SurfaceTrouble::Crowded)
    throw Error(fmt::format("atom {} touches more places of a wall than one grain may: it is deep in the surface, or "
                            "the facets of a hollow surface are small against the overlap (keyword max/contacts)",
                            tag));
  if (trouble == SurfaceTrouble::Crossed)
    throw Error(fmt::format("the centre of atom {} went through a wall of triangles: it is too fast for the time step, "
                            "or the wall too soft",
                            tag));
}

}  // namespace

SurfaceWall::SurfaceWall(const WallSpec &spec) : parts_(new Parts)
{
  parts_->spec = spec;
  if (spec.model) parts_->model = coefficients<double>(*spec.model);
  // what is wrong with the mesh shall be said now; the reach follows the grains
  double most = 0.0;
  for (const auto &p : spec.surface->vertex)
    most = std::max({most, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  parts_->reachAtLeast(most > 0.0 ? 0.05 * most : 1.0);
}
SurfaceWall::~SurfaceWall() = default;

WallSums SurfaceWall::apply(const HostParticles &p, const BodyMotion &motion, double timestep, bool advance,
                            double *kept, double *columns)
{
  const WallSpec &spec = parts_->spec;
  double largest = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) largest = std::max(largest, p.radius[i]);
  if (largest > 0.0) parts_->reachAtLeast(largest + wallPullOffGap(spec, largest));
  WallView<double> wall = parts_->view();
  const SurfaceAt at{parts_->surface->view(), bodyPose(motion)};
  if (columns) {
    parts_->columns.assign(8 * p.count, 0.0);
    wall.contacts = parts_->columns.data();
  }
  WallSums sums;
  std::vector<SurfaceTouch> touch(spec.recordTouches ? static_cast<std::size_t>(spec.mostContacts) : 0);
  for (std::size_t i = 0; i < p.count; ++i) {
    SurfaceSlots<double> slots =
        slotsOf(kept + static_cast<std::size_t>(wall.historySize) * i, spec.mostContacts, wall.historySize);
    if (!(static_cast<unsigned>(p.mask[i]) & spec.groupMask)) {
      for (int k = 0; k < slots.most; ++k) slots.clear(k);
      continue;
    }
    const Vec3<double> x = vectorAt(p.position, i), v = vectorAt(p.velocity, i), w = vectorAt(p.spin, i);
    for (SurfaceTouch &t : touch) t.triangle = noTriangle;
    const GrainAtSurface<double> grain{static_cast<std::uint32_t>(i),
                                       x,
                                       at.pose.toBody(x),
                                       p.radius[i],
                                       {v.x, v.y, v.z, p.mass[i], w.x, w.y, w.z, 0, 0}};
    const SurfaceLoad<double> load =
        surfaceLoad(wall, at, slots, grain, static_cast<std::uint32_t>(p.count), timestep, advance, NearList{},
                    spec.recordTouches ? touch.data() : nullptr);
    for (SurfaceTouch &t : touch) {
      if (t.triangle == noTriangle) continue;
      t.tag = p.tag[i];
      sums.touches.push_back(t);
    }
    complain(load.trouble, p.tag[i]);
    addAt(p.force, i, load.force);
    addAt(p.torque, i, load.torque);
    const Vec3<double> torque = load.torque + cross(x - at.pose.displacement, load.force);
    for (int k = 0; k < slots.most; ++k) sums.contacts += slots.used(k);
    for (int d = 0; d < 3; ++d) {
      const auto k = static_cast<std::size_t>(d);
      sums.force[k] -= load.force[d];
      sums.torque[k] -= torque[d];
    }
  }
  for (std::size_t i = 0; columns && i < p.count; ++i)
    for (std::size_t k = 0; k < 8; ++k) columns[8 * i + k] = parts_->columns[k * p.count + i];
  return sums;
}

}  // namespace gpudem
