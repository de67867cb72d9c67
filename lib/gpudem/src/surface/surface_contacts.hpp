// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The contacts of a sphere with a surface of triangles.
#pragma once

#include "surface/contact_weights.hpp"
#include "surface/surface_view.hpp"
#include "surface/triangle_point.hpp"

namespace gpudem {

struct SurfaceContacts {
  SurfaceContact contact[maxSurfaceContacts];  ///< deepest first
  int count;
  bool overflow;  ///< there were more minima than room; the deepest are kept
};

/// Key of a cell; 21 bits for each direction.
GPUDEM_HD std::uint64_t cellKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  return static_cast<std::uint64_t>(x) << 42 | static_cast<std::uint64_t>(y) << 21 | z;
}
GPUDEM_HD std::uint32_t cellHash(std::uint64_t key)
{
  key *= 0x9e3779b97f4a7c15ull;
  return static_cast<std::uint32_t>(key >> 32);
}
constexpr std::uint64_t emptyCell = ~std::uint64_t{0};
constexpr std::uint32_t noNode = ~std::uint32_t{0};
constexpr double maxCells = 2097151.0;  // per direction

/// Place in cellNodes of the nodes that hold all triangles within the surface's reach of \p x, or noNode.
GPUDEM_HD std::uint32_t entryNodes(const SurfaceView &s, const Vec3<double> &x)
{
  const Vec3<double> at = (x - s.origin) * s.inverseCell;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < maxCells && at.y < maxCells && at.z < maxCells))
    return noNode;
  const std::uint64_t key = cellKey(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y),
                                    static_cast<std::uint32_t>(at.z));
  for (std::uint32_t k = cellHash(key) & s.cellMask;; k = (k + 1) & s.cellMask) {
    if (s.cellKey[k] == key) return s.cellEntry[k];
    if (s.cellKey[k] == emptyCell) return noNode;
  }
}

/// Squared distance of \p x from the box.
GPUDEM_HD float boxDistance2(const TreeNode &n, const Vec3<float> &x)
{
  float sum = 0.0f;
  const float at[3] = {x.x, x.y, x.z};
  GPUDEM_UNROLL
  for (int d = 0; d < 3; ++d) {
    const float below = n.lo[d] - at[d], above = at[d] - n.hi[d];
    const float out = below > above ? below : above;
    if (out > 0.0f) sum += out * out;
  }
  return sum;
}

/// May a node within reach hold a minimum of the distance from a point within \p room of \p x?
GPUDEM_HD bool mayHoldMinimum(const NormalCone &cone, const TreeNode &n, const Vec3<float> &x, float room = 0.0f)
{
  if (cone.cosine == allNormals) return true;
  const Vec3<float> branch{x.x - 0.5f * (n.lo[0] + n.hi[0]), x.y - 0.5f * (n.lo[1] + n.hi[1]),
                           x.z - 0.5f * (n.lo[2] + n.hi[2])};
  const Vec3<float> size{n.hi[0] - n.lo[0], n.hi[1] - n.lo[1], n.hi[2] - n.lo[2]};
  const float half = 0.5f * squareRoot(dot(size, size)) + room, away2 = dot(branch, branch) - half * half;
  if (away2 <= 0.0f) return true;
  // angle of branch and axis <= half angle of the cone + that of the box seen from x, times |branch|
  const float along = branch.x * cone.axis[0] + branch.y * cone.axis[1] + branch.z * cone.axis[2];
  const float needed = cone.cosine * squareRoot(away2) - cone.sine * half;
  return absolute(along) >= needed * 0.9999f - 1e-5f * squareRoot(away2);
}

/// Does the neighbour's corner \p v lie farther than the point at \p branch from the centre, that is, does the distance
/// not fall on the way there? The tolerance finds the foot on a flat edge, which rounding may put beyond both faces.
GPUDEM_HD bool risesTowards(const Vec3<double> &v, const Vec3<double> &branch)
{
  const Vec3<double> way = v + branch;  // v is relative to the centre
  const double along = dot(branch, way);
  return along <= 0.0 || along * along <= 1e-18 * dot(branch, branch) * dot(way, way);
}

/// Is the nearest point of triangle \p t a minimum of the distance among all points of the surface nearby?
GPUDEM_HD bool isMinimum(const SurfaceView &s, const SurfaceTriangle &t, const TrianglePoint &p, const Vec3<double> &x)
{
  if (p.feature == Feature::Face) return true;
  if (p.feature >= Feature::Corner0) {
    const std::uint32_t v = t.corner[static_cast<int>(p.feature) - static_cast<int>(Feature::Corner0)];
    for (std::uint32_t k = s.spokeStart[v]; k < s.spokeStart[v + 1]; ++k)
      if (!risesTowards(s.vertex[s.spoke[k]] - x, p.branch)) return false;
    return true;
  }
  const std::uint32_t across = t.across[static_cast<int>(p.feature) - static_cast<int>(Feature::Edge0)];
  if (across == ownFace) return true;
  if (!(across & manyFaces)) return risesTowards(s.vertex[across] - x, p.branch);
  const std::uint32_t *fan = s.fan + (across & ~manyFaces);
  for (std::uint32_t k = 1; k <= fan[0]; ++k)
    if (!risesTowards(s.vertex[fan[k]] - x, p.branch)) return false;
  return true;
}

/// Normal of the face, not of unit length.
GPUDEM_HD Vec3<double> faceNormal(const SurfaceView &s, const SurfaceTriangle &t)
{
  const Vec3<double> a = s.vertex[t.corner[0]];
  return cross(s.vertex[t.corner[1]] - a, s.vertex[t.corner[2]] - a);
}

/// Pseudonormal of a feature of triangle \p k.
GPUDEM_HD Vec3<double> pseudonormal(const SurfaceView &s, std::uint32_t k, Feature feature)
{
  const SurfaceTriangle &t = s.triangle[k];
  if (feature == Feature::Face) return faceNormal(s, t);
  if (feature >= Feature::Corner0)
    return s.vertexNormal[t.corner[static_cast<int>(feature) - static_cast<int>(Feature::Corner0)]].as<double>();
  return s.edgeNormal[3 * k + static_cast<std::uint32_t>(feature) - static_cast<std::uint32_t>(Feature::Edge0)]
      .as<double>();
}

/// Squared chord between directions that are the same up to rounding.
constexpr double sameDirection2 = 1e-14;

/// Minima found so far, deepest first.
class MinimumList {
 public:
  GPUDEM_HD explicit MinimumList(SurfaceContacts &out) : out_(out)
  {
    out.count = 0;
    out.overflow = false;
  }
  /// A minimum in the direction of one in the list is the same point, or hidden: the nearer stays.
  GPUDEM_HD void add(const SurfaceContact &c)
  {
    for (int i = 0; i < out_.count; ++i) {
      const Vec3<double> chord = out_.contact[i].normal - c.normal;
      if (dot(chord, chord) > sameDirection2) continue;
      const SurfaceContact &old = out_.contact[i];
      if (c.distance > old.distance || (c.distance == old.distance && c.triangle >= old.triangle)) return;
      for (int k = i; k + 1 < out_.count; ++k) out_.contact[k] = out_.contact[k + 1];
      --out_.count;
      break;
    }
    int at = out_.count;
    while (at > 0 && before(c, out_.contact[at - 1])) --at;
    if (out_.count == maxSurfaceContacts) {
      out_.overflow = true;
      if (at == maxSurfaceContacts) return;
      --out_.count;
    }
    for (int k = out_.count; k > at; --k) out_.contact[k] = out_.contact[k - 1];
    out_.contact[at] = c;
    ++out_.count;
  }

 private:
  GPUDEM_HD static bool before(const SurfaceContact &a, const SurfaceContact &b)
  {
    return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
  }
  SurfaceContacts &out_;
};

enum class Wanted { All, Minima };

/// Squared \p reach for the boxes of single precision, which are rounded outward by as much as the coordinate.
GPUDEM_HD float coarseReach2(double reach)
{
  return static_cast<float>(reach * reach) * 1.00001f;
}

/// Calls visit(node number) for nodes that hold triangles and may be within \p reach of \p x, until it returns false; for
/// Minima it may leave out nodes that hold no minimum of the distance from any point within \p room of \p x.
template <Wanted wanted, class Visit>
GPUDEM_HD void visitNodes(const SurfaceView &s, const Vec3<double> &x, double reach, float room, const Visit &visit)
{
  const std::uint32_t entry = entryNodes(s, x);
  if (entry == noNode) return;
  const Vec3<float> coarse = x.as<float>();
  const float reach2 = coarseReach2(reach);
  const std::uint32_t *roots = s.cellNodes + entry;
  for (std::uint32_t r = 1; r <= roots[0]; ++r) {
    const std::uint32_t end = s.node[roots[r]].skip;
    for (std::uint32_t n = roots[r]; n < end;) {
      const TreeNode &node = s.node[n];
      if (boxDistance2(node, coarse) > reach2 ||
          (wanted == Wanted::Minima && !mayHoldMinimum(s.cone[n], node, coarse, room))) {
        n = node.skip;
        continue;
      }
      if (node.leaf != 0 && !visit(n)) return;
      ++n;
    }
  }
}

/// Calls visit(triangle number, nearest point, squared distance) if triangle \p k is within \p reach of \p x.
/// \return false once visit does
template <class Visit>
GPUDEM_HD bool visitTriangle(const SurfaceView &s, std::uint32_t k, const Vec3<double> &x, double reach, const Visit &visit)
{
  const SurfaceTriangle &t = s.triangle[k];
  const TrianglePoint p = nearestPoint(s.vertex[t.corner[0]] - x, s.vertex[t.corner[1]] - x, s.vertex[t.corner[2]] - x);
  const double distance2 = dot(p.branch, p.branch);
  return !(distance2 < reach * reach) || visit(k, p, distance2);
}

/// The same for the triangles of node \p n.
template <class Visit>
GPUDEM_HD bool visitTriangles(const SurfaceView &s, std::uint32_t n, const Vec3<double> &x, double reach,
                              const Visit &visit)
{
  const std::uint32_t leaf = s.node[n].leaf;
  for (std::uint32_t k = leaf >> 3, last = k + (leaf & 7u); k < last; ++k)
    if (!visitTriangle(s, k, x, reach, visit)) return false;
  return true;
}

/// Calls visit(triangle number, nearest point, squared distance) for triangles within \p reach of \p x, until it
/// returns false; for Minima it may leave out triangles that hold no minimum of the distance.
template <Wanted wanted = Wanted::All, class Visit>
GPUDEM_HD void visitNear(const SurfaceView &s, const Vec3<double> &x, double reach, const Visit &visit)
{
  visitNodes<wanted>(s, x, reach, 0.0f, [&](std::uint32_t n) { return visitTriangles(s, n, x, reach, visit); });
}

/// Where a centre finds the surface, wherever it has gone since this was listed: all triangles within reach, or if they
/// are many the nodes that may hold a minimum of the distance. The nearest come first, each with its distance at that
/// time, so that a centre that has gone a little looks at those alone that may be within its radius now.
struct NearList {
  const std::uint32_t *first;  ///< null: not listed
  const float *gap;            ///< distances, not too large; noEntry behind the last entry, unless the list is full
  std::uint32_t stride;
  float moved;  ///< how far the centre has gone since, not too small (distance)

  static constexpr std::uint32_t most = 32;
  static constexpr float noEntry = 3.0e38f;
  static constexpr float tooMany = -1.0f;             ///< in the first place: cells and tree have them
  static constexpr std::uint32_t ofNode = 1u << 31;  ///< in the number of a node
  GPUDEM_HD std::uint32_t entry(std::uint32_t k) const { return first[static_cast<std::size_t>(stride) * k]; }
  GPUDEM_HD float gapOf(std::uint32_t k) const { return gap[static_cast<std::size_t>(stride) * k]; }
  GPUDEM_HD bool holdsMinima() const { return first && *gap != tooMany; }
  GPUDEM_HD bool holdsTriangles() const { return holdsMinima() && (*gap == noEntry || !(*first & ofNode)); }
};

/// What listNear() finds, the nearest first.
class NearEntries {
 public:
  /// \return is there room?
  GPUDEM_HD bool add(std::uint32_t entry, float gap)
  {
    if (found_++ >= NearList::most) return false;
    std::uint32_t k = found_ - 1;
    for (; k > 0 && gap_[k - 1] > gap; --k) {
      entry_[k] = entry_[k - 1];
      gap_[k] = gap_[k - 1];
    }
    entry_[k] = entry;
    gap_[k] = gap;
    return true;
  }
  GPUDEM_HD void forget() { found_ = 0; }
  GPUDEM_HD bool some() const { return found_ > 0; }
  GPUDEM_HD bool tooMany() const { return found_ > NearList::most; }
  GPUDEM_HD void write(std::uint32_t *entry, float *gap, std::uint32_t stride) const
  {
    if (tooMany()) {
      *gap = NearList::tooMany;
      return;
    }
    for (std::uint32_t k = 0; k < found_; ++k) {
      entry[static_cast<std::size_t>(stride) * k] = entry_[k];
      gap[static_cast<std::size_t>(stride) * k] = gap_[k];
    }
    if (found_ < NearList::most) gap[static_cast<std::size_t>(stride) * found_] = NearList::noEntry;
  }

 private:
  std::uint32_t entry_[NearList::most], found_ = 0;
  float gap_[NearList::most];
};

/// List what lies within \p reach of \p x, for centres within \p room of \p x and \p reach - \p room of the surface.
/// \param first, gap, stride as of NearList
/// \return is there anything?
GPUDEM_HD bool listNear(const SurfaceView &s, const Vec3<double> &x, double reach, double room, std::uint32_t *first,
                        float *gap, std::uint32_t stride)
{
  constexpr float down = 0.999999f;  // rounding must not hide what is there
  NearEntries found;
  visitNear(s, x, reach, [&](std::uint32_t k, const TrianglePoint &, double distance2) {
    return found.add(k, static_cast<float>(squareRoot(distance2)) * down);
  });
  const bool some = found.some();
  if (found.tooMany()) {
    found.forget();
    visitNodes<Wanted::Minima>(s, x, reach, static_cast<float>(room) * 1.00001f, [&](std::uint32_t n) {
      return found.add(n | NearList::ofNode, squareRoot(boxDistance2(s.node[n], x.as<float>())) * down);
    });
  }
  found.write(first, gap, stride);
  return some;
}

/// As visitNear(), where possible among what is listed.
template <Wanted wanted = Wanted::All, class Visit>
GPUDEM_HD void visitListed(const SurfaceView &s, const NearList &list, const Vec3<double> &x, double reach,
                           const Visit &visit)
{
  if (wanted == Wanted::All ? !list.holdsTriangles() : !list.holdsMinima()) return visitNear<wanted>(s, x, reach, visit);
  const float limit = (static_cast<float>(reach) + list.moved) * 1.000001f;
  for (std::uint32_t k = 0; k < NearList::most; ++k) {
    if (list.gapOf(k) > limit) return;
    const std::uint32_t entry = list.entry(k), n = entry & ~NearList::ofNode;
    if (entry == n) {
      if (!visitTriangle(s, n, x, reach, visit)) return;
      continue;
    }
    const Vec3<float> coarse = x.as<float>();
    if (boxDistance2(s.node[n], coarse) <= coarseReach2(reach) && mayHoldMinimum(s.cone[n], s.node[n], coarse))
      if (!visitTriangles(s, n, x, reach, visit)) return;
  }
}

/// Is the centre behind the contact's feature?
GPUDEM_HD bool onWrongSide(const SurfaceView &s, const SurfaceContact &c)
{
  return dot(pseudonormal(s, c.triangle, c.feature), c.normal) * s.side < 0.0;
}

/// Sides of closed bodies. A centre inside is pushed out through the nearest point, the way it came in; seen from
/// outside, faces that look away belong to the far side of a thin part.
GPUDEM_HD void chooseSides(const SurfaceView &s, SurfaceContacts &out)
{
  if (out.count == 0) return;
  if (onWrongSide(s, out.contact[0])) {
    out.count = 1;
    out.contact[0].normal = out.contact[0].normal * -1.0;
    out.contact[0].distance = -out.contact[0].distance;
    return;
  }
  int left = 1;
  for (int i = 1; i < out.count; ++i)
    if (!onWrongSide(s, out.contact[i])) out.contact[left++] = out.contact[i];
  out.count = left;
}

/// How far each contact stands out from the tangent planes of the nearest points of all triangles that are nearer.
GPUDEM_HD void findProminence(const SurfaceView &s, const NearList &list, const Vec3<double> &x, double reach,
                              const SurfaceContacts &c, Prominence *prominence)
{
  for (int j = 0; j < c.count; ++j) prominence[j] = {1.0, 0.0};
  const auto compare = [&](std::uint32_t k, const TrianglePoint &p, double distance2) {
    if (distance2 == 0.0) return true;
    SurfaceContact nearer;
    nearer.triangle = k;
    nearer.distance = squareRoot(distance2);
    nearer.normal = p.branch * (1.0 / nearer.distance);
    for (int j = c.count - 1; j > 0 && c.contact[j].distance > nearer.distance; --j) {
      const Vec3<double> chord = c.contact[j].normal - nearer.normal;
      if (dot(chord, chord) > sameDirection2) compareWith(nearer, c.contact[j], reach, prominence[j]);
    }
    return true;
  };
  visitListed(s, list, x, c.contact[c.count - 1].distance, compare);
}

/// Contacts of a sphere of radius \p reach around \p x with the surface, with their weights.
/// \param list from listNear() with this reach and as much more as the centre has moved since
/// \pre reach <= s.reach
GPUDEM_HD void surfaceContacts(const SurfaceView &s, const Vec3<double> &x, double reach, SurfaceContacts &out,
                               const NearList &list = {})
{
  MinimumList minima(out);
  visitListed<Wanted::Minima>(s, list, x, reach, [&](std::uint32_t k, const TrianglePoint &p, double distance2) {
    const SurfaceTriangle &t = s.triangle[k];
    if (!isMinimum(s, t, p, x)) return true;
    SurfaceContact c;
    c.weight = 1.0;
    c.triangle = k;
    c.feature = p.feature;
    c.distance = squareRoot(distance2);
    if (c.distance > 0.0) {
      c.normal = p.branch * (1.0 / c.distance);
    } else {  // the centre is on the surface
      const Vec3<double> n = faceNormal(s, t);
      c.normal = n * ((s.side < 0 ? -1.0 : 1.0) / squareRoot(dot(n, n)));
    }
    minima.add(c);
    return true;
  });
  if (s.side != 0) chooseSides(s, out);
  if (out.count < 2) return;
  Prominence prominence[maxSurfaceContacts];
  findProminence(s, list, x, reach, out, prominence);
  out.count = weighContacts(out.contact, out.count, reach, prominence);
}

}  // namespace gpudem
