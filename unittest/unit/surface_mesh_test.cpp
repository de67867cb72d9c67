// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Reading surface files, cleaning meshes, saying what is wrong with them.
#include "testing/meshes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace gpudem::testing {

namespace {

/// A file that goes when the test ends.
class TemporaryFile {
 public:
  TemporaryFile(const std::string &suffix, const std::string &content)
      : path(::testing::TempDir() + "gpudem_surface_" +
             ::testing::UnitTest::GetInstance()->current_test_info()->name() + suffix)
  {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::remove(path.c_str()); }
  const std::string path;
};

template <class T>
void put(std::string &out, T value)
{
  out.append(reinterpret_cast<const char *>(&value), sizeof value);
}
std::string words(const Point &p)
{
  return std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]);
}

std::string asciiStl(const SurfaceMesh &m)
{
  std::string out = "solid part\n";
  for (const auto &t : m.triangle) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) out += "vertex " + words(m.vertex[v]) + "\n";
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid part\n";
}
std::string binaryStl(const SurfaceMesh &m)
{
  std::string out(80, ' ');
  put(out, static_cast<std::uint32_t>(m.triangle.size()));
  for (const auto &t : m.triangle) {
    for (int d = 0; d < 3; ++d) put(out, 0.0f);
    for (const std::uint32_t v : t)
      for (const double x : m.vertex[v]) put(out, static_cast<float>(x));
    put(out, std::uint16_t{0});
  }
  return out;
}
std::string obj(const SurfaceMesh &m)
{
  std::string out;
  for (const Point &p : m.vertex) out += "v " + words(p) + "\n";
  for (const auto &t : m.triangle)
    out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  return out;
}
std::string ply(const SurfaceMesh &m, bool binary)
{
  std::string out = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") + " 1.0\nelement vertex " +
                    std::to_string(m.vertex.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(m.triangle.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point &p : m.vertex) {
    if (!binary) out += words(p) + "\n";
    for (std::size_t d = 0; d < 3 && binary; ++d) put(out, static_cast<float>(p[d]));
  }
  for (const auto &t : m.triangle) {
    if (binary) put(out, std::uint8_t{3});
    if (!binary) out += "3";
    for (const std::uint32_t v : t) {
      if (binary) put(out, static_cast<std::int32_t>(v));
      if (!binary) out += " " + std::to_string(v);
    }
    if (!binary) out += "\n";
  }
  return out;
}

TEST(SurfaceMesh, formatsGiveTheSameBody)
{
  if (!canReadSurfaces()) GTEST_SKIP() << "built without the reader";
  const SurfaceMesh m = cube(0.75, 3);
  const std::pair<const char *, std::string> file[] = {{"_a.stl", asciiStl(m)}, {"_b.stl", binaryStl(m)},
                                                       {".obj", obj(m)},        {"_a.ply", ply(m, false)},
                                                       {"_b.ply", ply(m, true)}, {"_upper.STL", binaryStl(m)}};
  for (const auto &f : file) {
    const TemporaryFile written(f.first, f.second);
    SurfaceMesh read = readSurface(written.path);
    const MeshReport r = cleanSurface(read);
    EXPECT_EQ(read.triangle.size(), 108u) << f.first;
    EXPECT_EQ(read.vertex.size(), 56u) << f.first;
    EXPECT_TRUE(r.closed()) << f.first << r.text();
    EXPECT_TRUE(r.defects.empty()) << f.first << r.text();
    EXPECT_TRUE(near(r.volume, 0.421875, roundOff(Precision::Mixed, 1.0))) << f.first;
    EXPECT_TRUE(near(r.area, 3.375, roundOff(Precision::Mixed, 1.0))) << f.first;
  }
}

TEST(SurfaceMesh, filesThatCannotBeReadAreNamed)
{
  if (!canReadSurfaces()) GTEST_SKIP() << "built without the reader";
  const TemporaryFile rubbish(".stl", "this is not a mesh"), empty(".obj", "v 0 0 0\n");
  for (const std::string &path : {rubbish.path, empty.path, std::string("no_such_file.ply")}) try {
      readSurface(path);
      FAIL() << path;
    } catch (const Error &e) {
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
}

TEST(SurfaceMesh, polygonsAreCut)
{
  if (!canReadSurfaces()) GTEST_SKIP() << "built without the reader";
  const TemporaryFile file(".obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n");
  SurfaceMesh m = readSurface(file.path);
  const MeshReport r = cleanSurface(m);
  EXPECT_EQ(m.triangle.size(), 2u);
  EXPECT_TRUE(near(r.area, 2.0, roundOff(Precision::Mixed, 2.0)));
  EXPECT_FALSE(r.closed());
  EXPECT_EQ(r.count(MeshDefect::OpenEdge), 4u);
}

TEST(SurfaceMesh, defectsAreFoundWhereTheyAre)
{
  SurfaceMesh m = cube(1.0, 2);
  addTriangle(m, {0, 0, 0}, {0.5, 0, 0}, {1, 0, 0});             // no height
  addTriangle(m, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {1, 1, 1});   // a corner twice
  addTriangle(m, {0, 0, NAN}, {1, 0, 0}, {0, 1, 0});
  m.triangle.push_back(m.triangle[5]);                           // repeated, and repeated turned over
  m.triangle.push_back({m.triangle[7][0], m.triangle[7][2], m.triangle[7][1]});
  m.zone.resize(m.triangle.size());
  m.triangle[3] = {m.triangle[3][0], m.triangle[3][2], m.triangle[3][1]};  // wrong way round
  const MeshReport r = cleanSurface(m);
  EXPECT_EQ(m.triangle.size(), 48u);
  EXPECT_EQ(r.count(MeshDefect::Degenerate), 2u);
  EXPECT_EQ(r.count(MeshDefect::NotFinite), 1u);
  EXPECT_EQ(r.count(MeshDefect::Duplicate), 1u);
  EXPECT_EQ(r.count(MeshDefect::Opposite), 1u);
  EXPECT_EQ(r.turned, 1u);
  EXPECT_TRUE(r.closed()) << r.text();
  EXPECT_TRUE(near(r.volume, 1.0, roundOff(Precision::Double, 1.0)));
}

TEST(SurfaceMesh, holesAndFinsAreLocated)
{
  SurfaceMesh m = cube(1.0);
  m.triangle.pop_back();
  m.zone.pop_back();
  addTriangle(m, {0, 0, 0}, {1, 0, 0}, {0.5, -1, -1});  // a fin on the edge along x
  const MeshReport r = cleanSurface(m);
  EXPECT_FALSE(r.closed());
  EXPECT_EQ(r.count(MeshDefect::OpenEdge), 3u + 2u);
  ASSERT_EQ(r.count(MeshDefect::NonManifold), 1u);
  for (const DefectAt &d : r.defects)
    if (d.defect == MeshDefect::NonManifold) {
      EXPECT_EQ(d.at, (Point{0.5, 0, 0}));
    }
  EXPECT_NE(r.text().find("(0.5, 0, 0)"), std::string::npos) << r.text();
  EXPECT_THROW(Surface(m, 0.1, SurfaceSide::Outside), Error);
  EXPECT_NO_THROW(Surface(m, 0.1, SurfaceSide::Both));
}

TEST(SurfaceMesh, bandOfOneSideIsNotOrientable)
{
  // a Moebius band
  SurfaceMesh m = gridMesh(40, 2, [](double a, double b) {
    const double phi = 2 * M_PI * a, w = 0.4 * (b - 0.5);
    return Point{(1 + w * std::cos(phi / 2)) * std::cos(phi), (1 + w * std::cos(phi / 2)) * std::sin(phi),
                 w * std::sin(phi / 2)};
  });
  const MeshReport r = cleanSurface(m);
  EXPECT_GT(r.count(MeshDefect::Unorientable), 0u) << r.text();
  EXPECT_FALSE(r.closed());
}

TEST(SurfaceMesh, bodiesPointOutwardAndCavitiesInward)
{
  SurfaceMesh m = cube(3.0, 2), inner = cube(1.0), inverted = cube(1.0);
  for (Point &p : inner.vertex)
    for (double &x : p) x += 1.0;
  for (Point &p : inverted.vertex) p[0] += 10.0;
  for (auto *part : {&inner, &inverted})
    for (auto &t : part->triangle) std::swap(t[1], t[2]);
  append(m, inner);
  append(m, inverted);
  const MeshReport r = cleanSurface(m);
  EXPECT_EQ(r.bodies, 3u);
  EXPECT_TRUE(r.closed());
  EXPECT_EQ(r.turned, 12u);
  EXPECT_TRUE(near(r.volume, 27.0 - 1.0 + 1.0, roundOff(Precision::Double, 27.0, 256)));
}

TEST(SurfaceMesh, verticesThatRoundingTookApartAreWelded)
{
  SurfaceMesh m = cube(1.0, 5);
  Random random;
  for (Point &p : m.vertex)
    for (double &x : p) x += random.between(-2e-7, 2e-7);
  const MeshReport r = cleanSurface(m, 1e-6);
  EXPECT_TRUE(r.closed()) << r.text();
  EXPECT_EQ(m.vertex.size(), 152u);
  EXPECT_TRUE(r.defects.empty());
}

TEST(SurfaceMesh, siloOfThinSheetMetal)
{
  const char *path = std::getenv("GPUDEM_SILO_WALLS");
  std::ifstream in(path ? path : "");
  if (!in) GTEST_SKIP() << "GPUDEM_SILO_WALLS names no file (a table of triangles, 9 numbers a line)";
  std::string header;
  std::getline(in, header);
  SurfaceMesh m;
  for (Point a, b, c; in >> a[0] >> a[1] >> a[2] >> b[0] >> b[1] >> b[2] >> c[0] >> c[1] >> c[2];) addTriangle(m, a, b, c);
  const std::size_t read = m.triangle.size();
  const MeshReport r = cleanSurface(m);
  std::printf("%zu triangles read; %s\n", read, r.text().c_str());
  EXPECT_GT(m.triangle.size(), read / 2);
  EXPECT_NO_THROW(Surface(m, 0.003, r.closed() ? SurfaceSide::Outside : SurfaceSide::Both));
}

}  // namespace

}  // namespace gpudem::testing
