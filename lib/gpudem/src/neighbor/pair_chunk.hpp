// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Neighbours on the CPU: each pair once within a chunk of consecutive grains.
///
/// A chunk is the same whatever the number of threads, and one thread works on it at a time: the force of a pair
/// can be added to both of its grains without atomics, and the same bits come out in every run. A pair across two
/// chunks is listed by both.
#pragma once

#include "neighbor/cell_search.hpp"

#include <vector>

namespace gpudem {

constexpr std::uint32_t grainsPerChunk = 512;

/// The pairs of one chunk, one array per quantity; pairs that touched when the list was built come first.
template <class Real>
struct PairChunk {
  std::uint32_t front = 0;             ///< pairs that touched when the list was built
  std::vector<std::uint32_t> partner;  ///< device index
  std::vector<std::uint16_t> owner;    ///< grain within the chunk
  std::vector<std::uint16_t> mirror;   ///< the partner within the chunk, grainsPerChunk if it lies outside
  std::vector<std::uint8_t> touching;  ///< 1: the pair is in contact (laws that keep something only)
  std::vector<Real> spring;            ///< [pairs][size] what the contact keeps, as the owner sees it

  std::size_t size() const { return partner.size(); }
  std::size_t bytes() const
  {
    return partner.capacity() * sizeof(std::uint32_t) + (owner.capacity() + mirror.capacity()) * sizeof(std::uint16_t) +
           touching.capacity() + spring.capacity() * sizeof(Real);
  }
  void clear()
  {
    partner.clear();
    owner.clear();
    mirror.clear();
    touching.clear();
    spring.clear();
  }
};

/// List the pairs of each chunk and put each carried spring into its pair.
template <class P, bool history>
struct BuildPairs {
  using Real = typename P::Real;
  BuildView<P> v;
  ContactStore<Real> store;
  const std::uint32_t *oldIndex;  ///< [n] row of each grain in the store
  PairChunk<Real> *chunks;

  void operator()(std::uint32_t c) const
  {
    const std::uint32_t begin = c * grainsPerChunk, end = std::min(v.count, begin + grainsPerChunk);
    PairChunk<Real> &pairs = chunks[c];
    pairs.clear();
    struct Apart {
      std::uint32_t i, j;
    };
    static thread_local CandidateList candidates;
    static thread_local std::vector<Apart> apart;
    apart.clear();
    const auto list = [&](std::uint32_t i, std::uint32_t j) {
      const bool inside = j >= begin && j < end;
      pairs.partner.push_back(j);
      pairs.owner.push_back(static_cast<std::uint16_t>(i - begin));
      pairs.mirror.push_back(static_cast<std::uint16_t>(inside ? j - begin : grainsPerChunk));
    };
    const Vec3<float> unit = v.frame.unit32.template as<float>();
    forEachPair(v, begin, end, candidates, [&](std::uint32_t i, std::uint32_t j) {
      if (mayTouch(v.position.coarse[i], v.position.coarse[j], unit, v.reachSlack)) {
        list(i, j);
        if (history) carry(i, v.tag[j], pairs);
      } else {
        apart.push_back({i, j});
      }
    });
    pairs.front = static_cast<std::uint32_t>(pairs.size());
    for (const Apart &a : apart) list(a.i, a.j);
    if (history) {
      pairs.touching.resize(pairs.size(), 0);
      pairs.spring.resize(store.size * pairs.size(), Real(0));
    }
  }

 private:
  /// Append the spring that grain i holds to the grain \p tag, or none.
  void carry(std::uint32_t i, std::int32_t tag, PairChunk<Real> &pairs) const
  {
    const std::uint32_t end = store.offset[oldIndex[i] + 1];
    const std::uint32_t m = store.find(store.offset[oldIndex[i]], end, tag);
    pairs.touching.push_back(m < end ? 1 : 0);
    const auto size = static_cast<std::size_t>(store.size);
    for (std::size_t d = 0; d < size; ++d) pairs.spring.push_back(m < end ? store.spring[size * m + d] : Real(0));
  }
};

/// Number of springs each grain holds, on either side of a pair.
template <class Real>
struct CountPairSprings {
  const PairChunk<Real> *chunks;
  std::uint32_t count;
  std::uint32_t *out;  ///< [n]
  void operator()(std::uint32_t c) const
  {
    const PairChunk<Real> &pairs = chunks[c];
    const std::uint32_t begin = c * grainsPerChunk, grains = std::min(grainsPerChunk, count - begin);
    std::uint32_t held[grainsPerChunk + 1] = {};
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      held[pairs.owner[k]] += pairs.touching[k];
      held[pairs.mirror[k]] += pairs.touching[k];
    }
    for (std::uint32_t g = 0; g < grains; ++g) out[begin + g] = held[g];
  }
};

/// Copy the springs out, to both grains of each pair.
template <class Real>
struct ExtractPairSprings {
  const PairChunk<Real> *chunks;
  std::size_t size;           ///< numbers per contact
  const signed char *mirror;  ///< [size] sign of each number seen from the partner
  std::uint32_t count;
  const std::int32_t *tag;
  const std::uint32_t *offset;  ///< [n+1]
  std::int32_t *partner;
  Real *spring;
  void operator()(std::uint32_t c) const
  {
    const PairChunk<Real> &pairs = chunks[c];
    const std::uint32_t begin = c * grainsPerChunk, grains = std::min(grainsPerChunk, count - begin);
    std::uint32_t next[grainsPerChunk];
    for (std::uint32_t g = 0; g < grains; ++g) next[g] = offset[begin + g];
    const auto put = [&](std::uint32_t g, std::int32_t other, const Real *s, bool mirrored) {
      const std::size_t to = next[g]++;
      partner[to] = other;
      for (std::size_t d = 0; d < size; ++d)
        spring[size * to + d] = mirrored ? static_cast<Real>(mirror[d]) * s[d] : s[d];
    };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (!pairs.touching[k]) continue;
      const std::uint32_t g = pairs.owner[k], h = pairs.mirror[k];
      const Real *kept = pairs.spring.data() + size * k;
      put(g, tag[pairs.partner[k]], kept, false);
      if (h < grainsPerChunk) put(h, tag[begin + g], kept, true);
    }
  }
};

}  // namespace gpudem
