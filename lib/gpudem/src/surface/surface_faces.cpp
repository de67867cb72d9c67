// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/surface_faces.h"

#include "wall/body_pose.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace gpudem {

namespace {

Vec3<double> vec(const std::array<double, 3> &a)
{
  return {a[0], a[1], a[2]};
}
Vec3<double> vec(const double *a)
{
  return {a[0], a[1], a[2]};
}

/// A vector of the world in the frame of the body.
Vec3<double> turnedBack(const BodyMotion &m, const Vec3<double> &v)
{
  const auto &r = m.rotation;
  return {r[0] * v.x + r[3] * v.y + r[6] * v.z, r[1] * v.x + r[4] * v.y + r[7] * v.z,
          r[2] * v.x + r[5] * v.y + r[8] * v.z};
}

/// A file that closes itself.
struct TextFile {
  explicit TextFile(const std::string &path) : handle(std::fopen(path.c_str(), "w"))
  {
    if (!handle) throw Error("writing the faces of a surface: '" + path + "' cannot be opened");
  }
  ~TextFile()
  {
    if (handle) std::fclose(handle);
  }
  TextFile(const TextFile &) = delete;
  TextFile &operator=(const TextFile &) = delete;
  template <class... Values>
  void print(const char *format, const Values &...values)
  {
    std::fputs(fmt::format(fmt::runtime(format), values...).c_str(), handle);
  }
  bool close()
  {
    const bool written = !std::ferror(handle);
    const bool closed = std::fclose(handle) == 0;
    handle = nullptr;
    return written && closed;
  }
  std::FILE *handle;
};

}  // namespace

std::vector<std::array<double, 7>> zoneSums(const SurfaceMesh &mesh, const std::vector<SurfaceTouch> &touches,
                                            const std::array<double, 3> &origin)
{
  std::vector<std::array<double, 7>> sums(mesh.zoneName.empty() ? 1 : mesh.zoneName.size(), std::array<double, 7>{});
  for (const SurfaceTouch &t : touches) {
    auto &zone = sums[mesh.zone.empty() ? 0 : mesh.zone[t.triangle]];
    const Vec3<double> force = vec(t.force), torque = vec(t.couple) + cross(vec(t.place) - vec(origin), force);
    for (int d = 0; d < 3; ++d) {
      zone[static_cast<std::size_t>(d)] += force[d];
      zone[static_cast<std::size_t>(3 + d)] += torque[d];
    }
    zone[6] += 1.0;
  }
  return sums;
}

FaceLoads::FaceLoads(std::shared_ptr<const SurfaceMesh> mesh, double wearCoefficient)
    : mesh_(std::move(mesh)), wearCoefficient_(wearCoefficient)
{
  for (const auto &t : mesh_->triangle) {
    const Vec3<double> a = vec(mesh_->vertex[t[0]]);
    const Vec3<double> n = cross(vec(mesh_->vertex[t[1]]) - a, vec(mesh_->vertex[t[2]]) - a);
    const double length = std::sqrt(dot(n, n));
    normal_.push_back({n.x / length, n.y / length, n.z / length});
    area_.push_back(0.5 * length);
  }
  sums_.assign(valuesPerFace * area_.size(), 0.0);
  wear_.assign(area_.size(), 0.0);
}

void FaceLoads::add(const std::vector<SurfaceTouch> &touches, const BodyMotion &motion, double span)
{
  ++samples_;
  for (const SurfaceTouch &t : touches) {
    double *face = sums_.data() + valuesPerFace * t.triangle;
    const Vec3<double> force = turnedBack(motion, vec(t.force));
    face[0] += t.push;
    for (int d = 0; d < 3; ++d) face[1 + d] += force[d];
    face[4] += 1.0;
    if (t.push > 0.0) wear_[t.triangle] += wearCoefficient_ * t.push * t.slip * span;
  }
}

void FaceLoads::restart()
{
  samples_ = 0;
  sums_.assign(sums_.size(), 0.0);
}

void FaceLoads::write(const std::string &path, const BodyMotion &motion, const std::vector<double> &sums,
                      const std::vector<double> &wear) const
{
  const SurfaceMesh &mesh = *mesh_;
  const std::size_t faces = mesh.triangle.size();
  const double each = samples_ > 0 ? 1.0 / static_cast<double>(samples_) : 0.0;
  TextFile file(path);
  file.print("# vtk DataFile Version 3.0\nmean loads of {} samples\nASCII\nDATASET POLYDATA\nPOINTS {} double\n", samples_,
             mesh.vertex.size());
  for (const auto &p : mesh.vertex) {
    const auto x = placeOf(motion, p);
    file.print("{:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
  }
  file.print("POLYGONS {} {}\n", faces, 4 * faces);
  for (const auto &t : mesh.triangle) file.print("3 {} {} {}\n", t[0], t[1], t[2]);
  file.print("CELL_DATA {}\nSCALARS pressure double 1\nLOOKUP_TABLE default\n", faces);
  for (std::size_t k = 0; k < faces; ++k) file.print("{:.9g}\n", sums[valuesPerFace * k] * each / area_[k]);
  file.print("SCALARS contacts double 1\nLOOKUP_TABLE default\n");
  for (std::size_t k = 0; k < faces; ++k) file.print("{:.9g}\n", sums[valuesPerFace * k + 4] * each);
  file.print("SCALARS wear double 1\nLOOKUP_TABLE default\n");
  for (std::size_t k = 0; k < faces; ++k) file.print("{:.9g}\n", wear[k] / area_[k]);
  file.print("SCALARS zone int 1\nLOOKUP_TABLE default\n");
  for (std::size_t k = 0; k < faces; ++k) file.print("{}\n", mesh.zone.empty() ? 0u : mesh.zone[k]);
  file.print("VECTORS shear_stress double\n");
  const BodyPose pose = bodyPose(motion);
  for (std::size_t k = 0; k < faces; ++k) {
    const Vec3<double> force = vec(sums.data() + valuesPerFace * k + 1), n = vec(normal_[k]);
    const Vec3<double> shear = pose.turned((force - n * dot(n, force)) * (each / area_[k]));
    file.print("{:.9g} {:.9g} {:.9g}\n", shear.x, shear.y, shear.z);
  }
  if (!file.close()) throw Error("writing the faces of a surface: '" + path + "' could not be written in full");
}

}  // namespace gpudem
