// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/solid_tree.hpp"

#include <algorithm>
#include <cmath>

namespace gpudem {

namespace {

Vec3<double> unit(int axis)
{
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

double length(const Vec3<double> &v)
{
  return std::sqrt(dot(v, v));
}

Vec3<double> direction(const Vec3<double> &v)
{
  const double l = length(v);
  return l > 0.0 ? v * (1.0 / l) : Vec3<double>{1.0, 0.0, 0.0};
}

}  // namespace

SmoothSurface::Value SmoothSurface::at(const Vec3<double> &x) const
{
  const Vec3<double> d = x - origin;
  if (kind == Plane) return {dot(d, axis), axis};
  if (kind == Sphere) return {length(d) - a, direction(d)};
  const double along = dot(d, axis);
  const Vec3<double> across = d - axis * along, outward = direction(across);
  const double rho = length(across);
  if (kind == Cone) {
    const double c = 1.0 / std::hypot(1.0, b);
    return {(rho - a - b * along) * c, (outward - axis * b) * c};
  }
  const Vec3<double> fromRing = outward * (rho - a) + axis * along;
  return {length(fromRing) - b, direction(fromRing)};
}

SolidTree::SolidTree(const ParsedShape &shape)
{
  add(shape);
}

int SolidTree::add(const ParsedShape &p)
{
  const auto k = node_.size();
  node_.emplace_back();
  Node n;
  if (!p.combined()) {
    n.kind = Node::Simple;
    addSimple(n, p);
  } else {
    n.kind = p.name == "union" ? Node::Union : p.name == "intersection" ? Node::Intersection : Node::Difference;
    for (const ParsedShape &o : p.operand) n.member.push_back(add(o));
    n.lo = node_[static_cast<std::size_t>(n.member.front())].lo;
    n.hi = node_[static_cast<std::size_t>(n.member.front())].hi;
    for (const int m : n.member) {
      const Node &o = node_[static_cast<std::size_t>(m)];
      for (int d = 0; d < 3; ++d) {
        if (n.kind == Node::Union) {
          n.lo[d] = std::min(n.lo[d], o.lo[d]);
          n.hi[d] = std::max(n.hi[d], o.hi[d]);
        } else if (n.kind == Node::Intersection) {
          n.lo[d] = std::max(n.lo[d], o.lo[d]);
          n.hi[d] = std::min(n.hi[d], o.hi[d]);
        }
      }
    }
  }
  node_[k] = n;
  return static_cast<int>(k);
}

void SolidTree::addSurface(Node &n, const SmoothSurface &s)
{
  n.member.push_back(static_cast<int>(surface_.size()));
  surface_.push_back(s);
}

void SolidTree::addSimple(Node &n, const ParsedShape &p)
{
  const std::vector<double> &v = p.value;
  if (p.name == "box") {
    n.lo = {v[0], v[2], v[4]};
    n.hi = {v[1], v[3], v[5]};
    for (int d = 0; d < 3; ++d) {
      addSurface(n, {SmoothSurface::Plane, n.lo, unit(d) * -1.0});
      addSurface(n, {SmoothSurface::Plane, n.hi, unit(d)});
    }
  } else if (p.name == "sphere") {
    const Vec3<double> centre{v[0], v[1], v[2]}, all{v[3], v[3], v[3]};
    n.lo = centre - all;
    n.hi = centre + all;
    addSurface(n, {SmoothSurface::Sphere, centre, unit(2), v[3]});
  } else if (p.name == "torus") {
    const int axis = static_cast<int>(v[0]);
    const Vec3<double> centre{v[1], v[2], v[3]};
    const double outer = v[4] + v[5];
    const Vec3<double> all = Vec3<double>{outer, outer, outer} + unit(axis) * (v[5] - outer);
    n.lo = centre - all;
    n.hi = centre + all;
    addSurface(n, {SmoothSurface::Torus, centre, unit(axis), v[4], v[5]});
  } else {  // cylinder and cone
    const int axis = static_cast<int>(v[0]);
    const bool cone = p.name == "cone";
    const double low = v[3], high = cone ? v[4] : v[3], from = cone ? v[5] : v[4], to = cone ? v[6] : v[5];
    // c1 and c2 as LAMMPS orders them, (y,z), (x,z) or (x,y)
    Vec3<double> base = unit(axis) * from;
    base[axis == 0 ? 1 : 0] = v[1];
    base[axis == 2 ? 1 : 2] = v[2];
    const Vec3<double> top = base + unit(axis) * (to - from);
    const double widest = std::max(low, high);
    const Vec3<double> around = (Vec3<double>{1.0, 1.0, 1.0} - unit(axis)) * widest;
    n.lo = base - around;
    n.hi = top + around;
    addSurface(n, {SmoothSurface::Plane, base, unit(axis) * -1.0});
    addSurface(n, {SmoothSurface::Plane, top, unit(axis)});
    addSurface(n, {SmoothSurface::Cone, base, unit(axis), low, (high - low) / (to - from)});
    if (low == 0.0) tip_.push_back(base);
    if (high == 0.0) tip_.push_back(top);
  }
}

SolidTree::Value SolidTree::node(int k, const Vec3<double> &x) const
{
  const Node &n = node_[static_cast<std::size_t>(k)];
  Value best{0.0, -1, 1.0};
  for (std::size_t m = 0; m < n.member.size(); ++m) {
    Value v =
        n.kind == Node::Simple ? Value{surface(n.member[m]).at(x).distance, n.member[m], 1.0} : node(n.member[m], x);
    if (n.kind == Node::Difference && m > 0) v = {-v.distance, v.surface, -v.sign};
    if (best.surface < 0 || (n.kind == Node::Union ? v.distance < best.distance : v.distance > best.distance)) best = v;
  }
  return best;
}

}  // namespace gpudem
