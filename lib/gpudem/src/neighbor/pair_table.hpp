// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour table of the CPU. Same interface as row_table.hpp.
#pragma once

#include "neighbor/pair_chunk.hpp"

namespace gpudem {

template <class Exec, class P>
class PairTable {
 public:
  using Real = typename P::Real;
  using View = PairChunk<Real> *;

  View view() { return chunks_.data(); }
  /// Pairs listed.
  /// Can any row have more than \p contacts? The chunks do not know.
  static bool mayHoldMore(std::uint32_t) { return true; }
  std::uint64_t entries() const
  {
    std::uint64_t n = 0;
    for (const auto &c : chunks_) n += c.size();
    return n;
  }
  std::size_t bytes() const
  {
    std::size_t b = 0;
    for (const auto &c : chunks_) b += c.bytes();
    return b;
  }

  /// \param contacts the table remembers which pairs are in contact, with store.size numbers each
  void build(Exec &exec, const BuildView<P> &v, bool contacts, const ContactStore<Real> &store,
             const std::uint32_t *oldIndex)
  {
    size_ = store.size;
    const std::uint32_t chunks = chunksOf(v.count, grainsPerChunk);
    chunks_.resize(chunks);
    if (contacts) exec.forEachChunk(chunks, BuildPairs<P, true>{v, store, oldIndex, chunks_.data()});
    else exec.forEachChunk(chunks, BuildPairs<P, false>{v, store, oldIndex, chunks_.data()});
  }

  void countSprings(Exec &exec, std::uint32_t count, std::uint32_t *out) const
  {
    exec.forEachChunk(chunksOf(count, grainsPerChunk), CountPairSprings<Real>{chunks_.data(), count, out});
  }
  void extractSprings(Exec &exec, std::uint32_t count, const std::int32_t *tag, const std::uint32_t *offset,
                      const std::vector<signed char> &mirror, std::int32_t *partner, Real *spring) const
  {
    exec.forEachChunk(chunksOf(count, grainsPerChunk),
                      ExtractPairSprings<Real>{chunks_.data(), static_cast<std::size_t>(size_), mirror.data(), count,
                                               tag, offset, partner, spring});
  }

 private:
  std::vector<PairChunk<Real>> chunks_;
  int size_ = 0;  ///< numbers per contact
};

}  // namespace gpudem
