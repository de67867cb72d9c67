// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Walls made of triangles: reading, cleaning, what is wrong with a mesh, and the contacts of a sphere with it.
///
/// Lengths are in the caller's unit, in the frame of the body. A moving wall transforms the grain, not the mesh.
#pragma once

#include "gpudem/errors.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gpudem {

/// Triangles with shared vertices, counter-clockwise seen from where the normal points.
struct SurfaceMesh {
  std::vector<std::array<double, 3>> vertex;           ///< [vertices] (distance)
  std::vector<std::array<std::uint32_t, 3>> triangle;  ///< [triangles] indices of vertices
  std::vector<std::uint32_t> zone;                     ///< [triangles] which solid or object of the file, from 0
  std::vector<std::string> zoneName;                   ///< [zones], as in the file
};

/// Triangles of an STL (ASCII or binary), OBJ or PLY (ASCII or binary) file, told apart by content and file name.
/// Level sets of a .vdb file (OpenVDB): the triangles of their zero, one zone for each grid.
/// Polygons are cut into triangles. The reader keeps coordinates in single precision: six to seven digits.
/// \throws Error if the file cannot be read or holds no triangle, or if the library was built without the reader
SurfaceMesh readSurface(const std::string &path);
/// Was the library built with the reader of triangles, of level sets?
bool canReadSurfaces();
bool canReadLevelSets();

/// Has \p word the form of a shape, name(...)?
bool isShape(const std::string &word);
/// Is \p word an operation between shapes, union, intersection or difference?
bool isOperation(const std::string &word);
/// A body of simple shape, closed but for the plane: box(xlo,xhi,ylo,yhi,zlo,zhi), sphere(x,y,z,r),
/// cylinder(axis,c1,c2,r,lo,hi), cone(axis,c1,c2,rlo,rhi,lo,hi), torus(axis,x,y,z,R,r), plane(x,y,z,nx,ny,nz,half).
/// Combined closed shapes: union(A,B,...), intersection(A,B,...), difference(A,B,...) = A without B and all that follow,
/// where each may be a combination itself. Their triangles are found in cells as long as the spacing, which they need.
/// Corners of triangles lie on the exact surface; cleanSurface() joins them.
/// \param spacing length of no facet's side is above it, but for diagonals (distance); 0: straight sides are not cut, and
///                curved ones as often as \p chord asks for
/// \param chord   largest distance of facets from the exact surface (distance), read where spacing is 0: a facet of length h
///                on a radius R is h^2/(8 R) away
/// \throws Error that names the shape and what would be right
SurfaceMesh shapeSurface(const std::string &shape, double spacing, double chord);

enum class MeshDefect {
  NotFinite,     ///< a coordinate that is not a number; the triangle was removed
  Degenerate,    ///< a triangle whose height is below the welding distance; removed
  Duplicate,     ///< a triangle that was there before, in the same orientation; removed
  Opposite,      ///< a triangle that was there before, in the other orientation: a sheet of two sides; removed
  OpenEdge,      ///< an edge of one triangle only
  NonManifold,   ///< an edge of more than two triangles
  Unorientable,  ///< an edge whose two triangles disagree about the side, however they are turned
};
/// "open edge", ...
const char *defectName(MeshDefect defect);

/// One defect, and where it is.
struct DefectAt {
  MeshDefect defect;
  std::array<double, 3> at;  ///< centre of the edge or triangle (distance)
  std::uint32_t triangle;    ///< of the mesh before cleaning if it was removed, else after
};

/// What cleanSurface() found and did.
struct MeshReport {
  std::vector<DefectAt> defects;    ///< in the order of the mesh
  std::size_t welded = 0;           ///< vertices that were merged with an equal one
  std::size_t turned = 0;           ///< triangles turned over, so that neighbours agree and closed bodies point outward
  std::uint32_t bodies = 0;         ///< parts that share no vertex
  std::uint32_t closedBodies = 0;   ///< of these, closed ones
  std::vector<std::uint32_t> body;  ///< [triangles] of the cleaned mesh
  std::vector<bool> bodyClosed;     ///< [bodies] every edge has two triangles that agree
  double weldDistance = 0.0;        ///< (distance)
  double area = 0.0;                ///< (distance^2)
  double volume = 0.0;              ///< of the closed bodies (distance^3)

  std::size_t count(MeshDefect defect) const;
  /// Closed, so that inside and outside are known.
  bool closed() const { return bodies > 0 && closedBodies == bodies; }
  /// One line of numbers, then a line for each of the first \p most defects of each kind, with its place.
  std::string text(std::size_t most = 3) const;
};

/// Vertices closer than weld times the diagonal of the mesh become one; degenerate and repeated triangles go;
/// neighbours are turned to agree, and closed bodies to point outward.
/// \param weld relative distance; 1e-6 suits files in single precision
/// \throws Error if nothing is left
MeshReport cleanSurface(SurfaceMesh &mesh, double weld = 1e-6);

struct SurfaceView;

/// Which side of the surface grains are on.
enum class SurfaceSide {
  Both,    ///< a sheet: a grain is pushed to the side where its centre is
  Outside,  ///< closed bodies: a grain whose centre is inside is pushed out through the nearest point
  Inside    ///< closed containers: the same with the sides exchanged
};

/// The arrays that contact queries read, made once for a mesh, in one piece of memory.
class Surface {
 public:
  /// \param mesh after cleanSurface()
  /// \param reach largest distance at which contacts will be asked for (distance)
  /// \throws Error if \p side is not Both and the mesh is not closed, or if \p reach is not positive
  Surface(const SurfaceMesh &mesh, double reach, SurfaceSide side);
  ~Surface();
  Surface(Surface &&) noexcept;
  Surface &operator=(Surface &&) noexcept;

  SurfaceView view() const;
  /// The view into a copy of data(), on a device for example, aligned to 16 bytes.
  SurfaceView viewAt(const void *copy) const;
  const void *data() const;
  std::size_t bytes() const;
  double reach() const;  ///< (distance)

 private:
  struct Arrays;
  struct Packed;
  std::unique_ptr<Packed> packed_;
};

}  // namespace gpudem
