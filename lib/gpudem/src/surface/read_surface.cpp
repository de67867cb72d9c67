// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Surface files through assimp, which knows the formats and their dialects.
#include "gpudem/surface.h"

#include "surface/read_level_set.hpp"

#ifdef GPUDEM_HAVE_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

namespace gpudem {

#ifdef GPUDEM_HAVE_ASSIMP

namespace {

void append(SurfaceMesh &mesh, const aiMesh &part)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
  const auto zone = static_cast<std::uint32_t>(mesh.zoneName.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D &p = part.mVertices[v];
    mesh.vertex.push_back({p.x, p.y, p.z});
  }
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace &face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines of OBJ files
    mesh.triangle.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    mesh.zone.push_back(zone);
  }
  mesh.zoneName.emplace_back(part.mName.C_Str());
}

}  // namespace

bool canReadSurfaces()
{
  return true;
}

static SurfaceMesh readTriangles(const std::string &path)
{
  Assimp::Importer importer;
  // nothing but triangulation: welding is ours, with a distance that we state
  const aiScene *scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (!scene) throw Error("reading the surface '" + path + "': " + importer.GetErrorString());
  SurfaceMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) append(mesh, *scene->mMeshes[m]);
  if (mesh.triangle.empty()) throw Error("reading the surface '" + path + "': it holds no triangle");
  return mesh;
}

#else

bool canReadSurfaces()
{
  return false;
}

static SurfaceMesh readTriangles(const std::string &path)
{
  throw Error("reading the surface '" + path + "': GPUDEM was built without assimp (Debian: libassimp-dev)");
}

#endif

SurfaceMesh readSurface(const std::string &path)
{
  const std::string end = ".vdb";
  if (path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0) return readLevelSet(path);
  return readTriangles(path);
}

}  // namespace gpudem
