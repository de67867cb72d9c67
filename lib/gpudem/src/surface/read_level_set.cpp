// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Level sets of .vdb files, as the triangles of their zero.
#include "surface/read_level_set.hpp"

#ifdef GPUDEM_HAVE_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>
#endif

namespace gpudem {

#ifdef GPUDEM_HAVE_OPENVDB

namespace {

/// The zero of one grid is one zone.
void append(SurfaceMesh &mesh, const openvdb::FloatGrid &grid)
{
  std::vector<openvdb::Vec3s> point;
  std::vector<openvdb::Vec3I> triangle;
  std::vector<openvdb::Vec4I> quad;
  openvdb::tools::volumeToMesh(grid, point, triangle, quad, 0.0, 0.0);
  const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
  const auto zone = static_cast<std::uint32_t>(mesh.zoneName.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangle.push_back({first + a, first + b, first + c});
    mesh.zone.push_back(zone);
  };
  for (const openvdb::Vec3s &p : point) mesh.vertex.push_back({p.x(), p.y(), p.z()});
  for (const openvdb::Vec3I &t : triangle) add(t[0], t[1], t[2]);
  for (const openvdb::Vec4I &q : quad) {
    add(q[0], q[1], q[2]);
    add(q[0], q[2], q[3]);
  }
  mesh.zoneName.push_back(grid.getName());
}

}  // namespace

bool canReadLevelSets()
{
  return true;
}

SurfaceMesh readLevelSet(const std::string &path)
{
  SurfaceMesh mesh;
  std::string others;
  try {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open();
    const openvdb::GridPtrVecPtr grids = file.getGrids();
    for (const openvdb::GridBase::Ptr &grid : *grids) {
      const auto distances = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
      if (distances && grid->getGridClass() == openvdb::GRID_LEVEL_SET) append(mesh, *distances);
      else others += " '" + grid->getName() + "' (" + grid->gridClassToString(grid->getGridClass()) + " of " +
                     grid->valueType() + ")";
    }
  } catch (const openvdb::Exception &e) {
    throw Error("reading the level set '" + path + "': " + e.what());
  }
  if (mesh.triangle.empty())
    throw Error("reading the level set '" + path + "': it holds no grid of class level set and type float with a zero" +
                (others.empty() ? "" : "; passed over:" + others));
  return mesh;
}

#else

bool canReadLevelSets()
{
  return false;
}

SurfaceMesh readLevelSet(const std::string &path)
{
  throw Error("reading the level set '" + path + "': GPUDEM was built without OpenVDB (Debian: libopenvdb-dev)");
}

#endif

}  // namespace gpudem
