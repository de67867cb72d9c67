// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file How many slabs, along which axis: the least surface between ranks, among the grids that the tree of ranks
/// represents.
#include "gpudem/errors.h"
#include "gpudem/slice_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

namespace gpudem {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

/// \p ranks divided into \p parts nodes of the tree, the largest node being halved again and again; sizes in order of
/// rank.
std::vector<int> halve(int ranks, int parts)
{
  if (parts == ranks) return std::vector<int>(ranks, 1);
  struct Node {
    int size, first;
    bool operator<(const Node &o) const { return size != o.size ? size < o.size : first > o.first; }
  };
  std::priority_queue<Node> nodes;
  nodes.push({ranks, 0});
  while (static_cast<int>(nodes.size()) < parts) {
    const Node n = nodes.top();
    nodes.pop();
    const int low = (n.size + 1) / 2;
    nodes.push({low, n.first});
    nodes.push({n.size - low, n.first + low});
  }
  std::vector<Node> order;
  for (; !nodes.empty(); nodes.pop()) order.push_back(nodes.top());
  std::sort(order.begin(), order.end(), [](const Node &a, const Node &b) { return a.first < b.first; });
  std::vector<int> sizes;
  for (const Node &n : order) sizes.push_back(n.size);
  return sizes;
}

/// Searches the number of parts at each level for one order of axes.
class Search {
 public:
  Search(const std::vector<int> &axes, const SliceRequest &request) : axes_(axes)
  {
    for (int a = 0; a < 3; ++a) {
      const double parts = request.smallest[a] > 0.0 ? 1.0 / request.smallest[a] : 1e9;
      most_[a] = static_cast<int>(std::min(1e9, std::floor(parts * (1.0 + 1e-12))));
    }
  }

  struct Choice {
    int parts = 0;
    double surface = impossible;
  };

  /// Best division at \p level of \p ranks that share a region of the given extent.
  Choice best(std::size_t level, int ranks, const std::array<double, 3> &extent)
  {
    const int axis = axes_[level];
    const double face = extent[(axis + 1) % 3] * extent[(axis + 2) % 3];
    if (level + 1 == axes_.size()) return ranks <= most_[axis] ? Choice{ranks, (ranks - 1) * face} : Choice{};

    // the number of parts that makes sub-domains cubic; the best lies near it unless widths forbid
    double product = ranks;
    for (std::size_t k = level + 1; k < axes_.size(); ++k) product *= extent[axis] / extent[axes_[k]];
    const double ideal = std::pow(product, 1.0 / static_cast<double>(axes_.size() - level));
    const int end = std::min(ranks, most_[axis]);
    const int from = static_cast<int>(std::clamp(0.5 * ideal, 1.0, static_cast<double>(std::max(end, 1))));
    const int to = static_cast<int>(std::clamp(2.0 * ideal + 1.0, 1.0, static_cast<double>(std::max(end, 1))));
    Choice choice = scan(level, ranks, extent, face, from, std::min(to, end));
    if (choice.surface == impossible) choice = scan(level, ranks, extent, face, 1, end);
    return choice;
  }

 private:
  Choice scan(std::size_t level, int ranks, const std::array<double, 3> &extent, double face, int from, int to)
  {
    Choice choice;
    for (int parts = from; parts <= to; ++parts) {
      std::map<int, int> sizes;
      for (int s : halve(ranks, parts)) ++sizes[s];
      double surface = (parts - 1) * face;
      for (const auto &[size, times] : sizes) {
        std::array<double, 3> part = extent;
        part[axes_[level]] *= static_cast<double>(size) / ranks;
        surface += times * best(level + 1, size, part).surface;
      }
      if (surface < choice.surface) choice = {parts, surface};
    }
    return choice;
  }

  std::vector<int> axes_;
  std::array<int, 3> most_;  // parts along each axis at most
};

/// A flat region is never worth a cut through its thickness.
std::array<double, 3> notFlat(std::array<double, 3> extent)
{
  for (double &e : extent)
    if (!(e > 0.0)) e = 1e-3 * std::max({extent[0], extent[1], extent[2], 1e-30});
  return extent;
}

std::vector<std::vector<int>> candidates(const SliceRequest &request)
{
  if (request.axes != "auto") {
    std::vector<int> axes;
    for (char c : request.axes) {
      const int axis = c - 'x';
      if (axis < 0 || axis > 2)
        throw Error(fmt::format("axes {}: '{}' is no axis; give x, y and z in the order of the cuts, or auto",
                                request.axes, c));
      if (axis >= request.dimension)
        throw Error(fmt::format("axes {}: no cuts along z in two dimensions", request.axes));
      if (std::count(axes.begin(), axes.end(), axis))
        throw Error(fmt::format("axes {}: {} stands twice", request.axes, c));
      axes.push_back(axis);
    }
    if (static_cast<int>(axes.size()) != request.levels)
      throw Error(
          fmt::format("axes {} names {} axes, but the grid has {} levels", request.axes, axes.size(), request.levels));
    return {axes};
  }
  std::vector<std::vector<int>> all;
  std::vector<int> order(request.dimension);
  for (int a = 0; a < request.dimension; ++a) order[a] = a;
  do {
    std::vector<int> axes(order.begin(), order.begin() + request.levels);
    if (all.empty() || all.back() != axes) all.push_back(axes);
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

}  // namespace

SliceGrid makeSliceGrid(const SliceRequest &request)
{
  if (request.ranks < 1) throw Error(fmt::format("a slice grid of {} ranks: at least 1 is needed", request.ranks));
  if (request.levels < 1 || request.levels > request.dimension)
    throw Error(fmt::format("levels {}: must be 1 to {} in {} dimensions", request.levels, request.dimension,
                            request.dimension));
  const std::array<double, 3> extent = notFlat(request.extent);

  std::vector<int> axes;
  double least = impossible;
  for (const auto &order : candidates(request)) {
    const double surface = Search(order, request).best(0, request.ranks, extent).surface;
    // a hair's difference is round-off; the earlier order wins, so that the choice does not flicker
    if (surface < least * (1.0 - 1e-9)) {
      least = surface;
      axes = order;
    }
  }
  if (axes.empty())
    throw Error(
        fmt::format("the box is too small for {} ranks in {} levels: along x, y, z a part must be at least {:.3g}, "
                    "{:.3g}, {:.3g} of the box; use fewer ranks, more levels or a smaller least width",
                    request.ranks, request.levels, request.smallest[0], request.smallest[1], request.smallest[2]));

  SliceGrid grid;
  grid.ranks = request.ranks;
  Search search(axes, request);
  std::vector<int> groups = {request.ranks};
  std::vector<std::array<double, 3>> boxes = {extent};
  for (std::size_t l = 0; l < axes.size(); ++l) {
    SliceLevel level;
    level.axis = axes[l];
    level.groupStart.push_back(0);
    level.firstRank.push_back(0);
    std::vector<int> parts;
    std::vector<std::array<double, 3>> partBoxes;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      int below = 0;
      for (int size : halve(groups[g], search.best(l, groups[g], boxes[g]).parts)) {
        level.lower.push_back(static_cast<double>(below) / groups[g]);
        level.firstRank.push_back(level.firstRank.back() + size);
        parts.push_back(size);
        partBoxes.push_back(boxes[g]);
        partBoxes.back()[axes[l]] *= static_cast<double>(size) / groups[g];
        below += size;
      }
      level.groupStart.push_back(level.parts());
    }
    groups = parts;
    boxes = partBoxes;
    grid.levels.push_back(level);
  }
  return grid;
}

double sliceSurface(const SliceGrid &grid, const std::array<double, 3> &extent)
{
  double surface = 0.0;
  std::vector<std::array<double, 3>> boxes = {notFlat(extent)};
  for (const SliceLevel &level : grid.levels) {
    std::vector<std::array<double, 3>> parts;
    for (int g = 0; g < level.groups(); ++g) {
      const int first = level.groupStart[g], last = level.groupStart[g + 1];
      const auto &box = boxes[g];
      surface += (last - first - 1) * box[(level.axis + 1) % 3] * box[(level.axis + 2) % 3];
      for (int k = first; k < last; ++k) {
        parts.push_back(box);
        parts.back()[level.axis] *= static_cast<double>(level.firstRank[k + 1] - level.firstRank[k]) /
                                    (level.firstRank[last] - level.firstRank[first]);
      }
    }
    boxes = parts;
  }
  return surface;
}

}  // namespace gpudem
