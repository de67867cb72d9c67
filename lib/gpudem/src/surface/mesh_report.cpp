// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/surface.h"

#include <fmt/format.h>

#include <algorithm>

namespace gpudem {

namespace {

constexpr MeshDefect allDefects[] = {MeshDefect::NotFinite, MeshDefect::Degenerate,  MeshDefect::Duplicate,
                                     MeshDefect::Opposite,  MeshDefect::OpenEdge,    MeshDefect::NonManifold,
                                     MeshDefect::Unorientable};

}  // namespace

const char *defectName(MeshDefect defect)
{
  switch (defect) {
    case MeshDefect::NotFinite:
      return "triangle with a coordinate that is not a number (removed)";
    case MeshDefect::Degenerate:
      return "degenerate triangle (removed)";
    case MeshDefect::Duplicate:
      return "repeated triangle (removed)";
    case MeshDefect::Opposite:
      return "triangle repeated with opposite sides (removed)";
    case MeshDefect::OpenEdge:
      return "open edge";
    case MeshDefect::NonManifold:
      return "edge of more than two triangles";
    case MeshDefect::Unorientable:
      return "edge whose triangles disagree about the side";
  }
  return "";
}

std::size_t MeshReport::count(MeshDefect defect) const
{
  return static_cast<std::size_t>(
      std::count_if(defects.begin(), defects.end(), [&](const DefectAt &d) { return d.defect == defect; }));
}

std::string MeshReport::text(std::size_t most) const
{
  std::string out = fmt::format("{} triangles in {} bodies, {} closed; area {:.6g}, volume of the closed {:.6g}; {} vertices welded "
                                "within {:.3g}, {} triangles turned",
                                body.size(), bodies, closedBodies, area, volume, welded, weldDistance, turned);
  for (const MeshDefect kind : allDefects) {
    const std::size_t all = count(kind);
    if (all == 0) continue;
    out += fmt::format("\n  {} x {}, at", all, defectName(kind));
    std::size_t shown = 0;
    for (const DefectAt &d : defects)
      if (d.defect == kind && shown++ < most) out += fmt::format(" ({:.6g}, {:.6g}, {:.6g})", d.at[0], d.at[1], d.at[2]);
    if (all > most) out += " ...";
  }
  return out;
}

}  // namespace gpudem
