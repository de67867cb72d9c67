// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Level sets as walls: the zero of a .vdb file, and what is said where there is none.
#include "gpudem/surface.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#ifdef GPUDEM_HAVE_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#endif

using namespace gpudem;

namespace {

std::string whatIsWrongWith(const std::string &path)
{
  try {
    readSurface(path);
  } catch (const Error &e) {
    return e.what();
  }
  return "nothing";
}

TEST(LevelSet, FileThatIsNotThere)
{
  const std::string said = whatIsWrongWith("none.vdb");
  EXPECT_NE(said.find("none.vdb"), std::string::npos) << said;
  if (!canReadLevelSets()) {
    EXPECT_NE(said.find("OpenVDB"), std::string::npos) << said;
  }
}

#ifdef GPUDEM_HAVE_OPENVDB

/// Removed when the test ends. Tests run at the same time, each in a process.
struct Scratch {
  std::string path = fmt::format("{}gpudem-level-set-{}.vdb", ::testing::TempDir(), getpid());
  ~Scratch() { std::remove(path.c_str()); }
  void write(const openvdb::GridPtrVec &grids) const
  {
    openvdb::io::File file(path);
    file.write(grids);
    file.close();
  }
};

/// Largest distance of a vertex or a triangle's centre from the sphere, which was a level set of this voxel size.
double errorOfSphere(double radius, double voxel)
{
  openvdb::initialize();
  const Scratch scratch;
  scratch.write({openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(static_cast<float>(radius), {1, 2, 3},
                                                                          static_cast<float>(voxel))});
  SurfaceMesh mesh = readSurface(scratch.path);
  const MeshReport report = cleanSurface(mesh);
  EXPECT_TRUE(report.closed());
  EXPECT_EQ(report.bodies, 1u);
  double worst = 0.0;
  for (const auto &t : mesh.triangle) {
    double centre[3] = {-1, -2, -3};
    for (const std::uint32_t v : t)
      for (std::size_t d = 0; d < 3; ++d) centre[d] += mesh.vertex[v][d] / 3.0;
    worst = std::max(worst, std::abs(std::hypot(centre[0], centre[1], centre[2]) - radius));
  }
  return worst;
}

TEST(LevelSet, ErrorFallsWithTheSquareOfTheVoxel)
{
  const double coarse = errorOfSphere(2.0, 0.4), middle = errorOfSphere(2.0, 0.2), fine = errorOfSphere(2.0, 0.1);
  EXPECT_LT(middle, 0.4 * coarse);
  EXPECT_LT(fine, 0.4 * middle);
  std::printf("sphere of radius 2, voxels 0.4, 0.2, 0.1: %.3g %.3g %.3g\n", coarse, middle, fine);
}

TEST(LevelSet, GridsThatAreNoLevelSetsAreNamed)
{
  openvdb::initialize();
  const Scratch scratch;
  const auto fog = openvdb::FloatGrid::create();
  fog->setName("smoke");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  scratch.write({fog});
  const std::string said = whatIsWrongWith(scratch.path);
  EXPECT_NE(said.find("'smoke'"), std::string::npos) << said;
  EXPECT_NE(said.find("level set"), std::string::npos) << said;
}

#endif

}  // namespace
