// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gpudem {

namespace {

struct Box {
  double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
  void include(const double *p)
  {
    for (int d = 0; d < 3; ++d) {
      lo[d] = std::min(lo[d], p[d]);
      hi[d] = std::max(hi[d], p[d]);
    }
  }
};

class Builder {
 public:
  Builder(const SurfaceMesh &mesh, double margin) : mesh_(mesh), margin_(margin)
  {
    const std::size_t n = mesh.triangle.size();
    centre_.resize(n);
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t d = 0; d < 3; ++d) {
        double sum = 0.0;
        for (const std::uint32_t v : mesh.triangle[t]) sum += mesh.vertex[v][d];
        centre_[t][d] = sum / 3.0;
      }
    tree_.order.resize(n);
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
    tree_.node.reserve(n);
    split(0, static_cast<std::uint32_t>(n));
  }
  SurfaceTree tree_;

 private:
  void split(std::uint32_t first, std::uint32_t last)
  {
    const std::size_t at = tree_.node.size();
    tree_.node.push_back({});
    if (last - first <= leafTriangles) {
      tree_.node[at].leaf = first << 3 | (last - first);
    } else {
      Box centres;
      for (std::uint32_t k = first; k < last; ++k) centres.include(centre_[tree_.order[k]].data());
      std::size_t axis = 0;
      for (std::size_t d = 1; d < 3; ++d)
        if (centres.hi[d] - centres.lo[d] > centres.hi[axis] - centres.lo[axis]) axis = d;
      const std::uint32_t middle = first + (last - first) / 2;
      std::nth_element(tree_.order.begin() + first, tree_.order.begin() + middle, tree_.order.begin() + last,
                       [&](std::uint32_t a, std::uint32_t b) {
                         return centre_[a][axis] < centre_[b][axis] || (centre_[a][axis] == centre_[b][axis] && a < b);
                       });
      split(first, middle);
      split(middle, last);
    }
    setBox(tree_.node[at], first, last);
    tree_.node[at].skip = static_cast<std::uint32_t>(tree_.node.size());
  }
  void setBox(TreeNode &node, std::uint32_t first, std::uint32_t last) const
  {
    Box box;
    if (node.leaf != 0) {
      for (std::uint32_t k = first; k < last; ++k)
        for (const std::uint32_t v : mesh_.triangle[tree_.order[k]]) box.include(mesh_.vertex[v].data());
      for (int d = 0; d < 3; ++d) {
        node.lo[d] = std::nextafter(static_cast<float>(box.lo[d] - margin_), -INFINITY);
        node.hi[d] = std::nextafter(static_cast<float>(box.hi[d] + margin_), INFINITY);
      }
      return;
    }
    // the children: the next node and the one behind its subtree
    const std::size_t at = static_cast<std::size_t>(&node - tree_.node.data());
    const TreeNode &a = tree_.node[at + 1], &b = tree_.node[a.skip];
    for (int d = 0; d < 3; ++d) {
      node.lo[d] = std::min(a.lo[d], b.lo[d]);
      node.hi[d] = std::max(a.hi[d], b.hi[d]);
    }
  }

  const SurfaceMesh &mesh_;
  double margin_;
  std::vector<std::array<double, 3>> centre_;
};

}  // namespace

SurfaceTree buildTree(const SurfaceMesh &mesh, double margin)
{
  if (mesh.triangle.size() >= std::size_t{1} << 29)
    throw Error("building a surface: " + std::to_string(mesh.triangle.size()) + " triangles are more than 2^29");
  return std::move(Builder(mesh, margin).tree_);
}

namespace {

/// A node, the places begin to end of its triangles, and which of the wanted ones these are.
struct Holder {
  std::uint32_t node, begin, end;
  const std::uint32_t *first, *last;
  bool splits(const SurfaceTree &tree) const { return tree.node[node].leaf == 0 && unwanted() > 0; }
  std::ptrdiff_t unwanted() const { return static_cast<std::ptrdiff_t>(end - begin) - (last - first); }
};

}  // namespace

std::vector<std::uint32_t> nodesHolding(const SurfaceTree &tree, const std::vector<std::uint32_t> &wanted,
                                        std::size_t most)
{
  std::vector<Holder> holders{{0, 0, static_cast<std::uint32_t>(tree.order.size()), wanted.data(),
                               wanted.data() + wanted.size()}};
  for (;;) {
    // the node with the most to leave out
    auto worst = holders.end();
    for (auto h = holders.begin(); h != holders.end(); ++h)
      if (h->splits(tree) && (worst == holders.end() || h->unwanted() > worst->unwanted())) worst = h;
    if (worst == holders.end()) break;
    const Holder h = *worst;
    const std::uint32_t middle = h.begin + (h.end - h.begin) / 2;  // the same halves as in split()
    const std::uint32_t *cut = std::lower_bound(h.first, h.last, middle);
    const Holder low{h.node + 1, h.begin, middle, h.first, cut}, high{tree.node[h.node + 1].skip, middle, h.end, cut, h.last};
    const bool both = low.first != low.last && high.first != high.last;
    if (both && holders.size() == most) break;
    *worst = low.first != low.last ? low : high;
    if (both) holders.push_back(high);
  }
  std::vector<std::uint32_t> nodes;
  for (const Holder &h : holders) nodes.push_back(h.node);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace gpudem
