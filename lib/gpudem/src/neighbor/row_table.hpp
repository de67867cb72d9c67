// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour table of the GPU: rows in slices of 32 grains. Same interface as pair_table.hpp.
#pragma once

#include "base/saturated.hpp"
#include "gpudem/errors.h"
#include "neighbor/rows.hpp"

namespace gpudem {

template <class Exec, class P>
class RowTable {
 public:
  using Real = typename P::Real;
  using View = RowView<Real>;
  static constexpr int W = 32;

  View view()
  {
    return {start_.data(), maskStart_.data(), count_.data(), near_.data(), neighbor_.data(), touch_.data(),
            spring_.data()};
  }
  /// Entries of all rows, padding included.
  std::uint64_t entries() const { return entries_; }
  /// Can any row have more than \p contacts?
  bool mayHoldMore(std::uint32_t contacts) const { return moreThanAWord_ || contacts < 32; }
  std::size_t bytes() const
  {
    return count_.bytes() + sliceEntries_.bytes() + sliceWords_.bytes() + start_.bytes() + maskStart_.bytes() +
           near_.bytes() + neighbor_.bytes() + touch_.bytes() + spring_.bytes();
  }

  /// \param contacts the table remembers which pairs are in contact, with store.size numbers each
  void build(Exec &exec, const BuildView<P> &v, bool contacts, const ContactStore<Real> &store,
             const std::uint32_t *oldIndex)
  {
    size_ = store.size;
    const std::uint32_t slices = chunksOf(v.count, W);
    count_.reserve(v.count);
    sliceEntries_.reserve(slices);
    sliceWords_.reserve(slices);
    start_.reserve(slices + 1);
    maskStart_.reserve(slices + 1);
    exec.forEach(v.count, CountNeighbors<P>{v, count_.data()});
    exec.forEach(slices, SliceWidths<W>{v.count, count_.data(), sliceEntries_.data(), sliceWords_.data()});
    exec.scan(sliceEntries_.data(), start_.data(), slices);
    exec.scan(sliceWords_.data(), maskStart_.data(), slices);
    const std::array<std::uint32_t, 2> total = exec.read({start_.data() + slices, maskStart_.data() + slices});
    exec.forEach(slices + 1, AddToAll{v.count, maskStart_.data()});  // the first words of the rows come before
    if (total[0] == saturated) throw Error("the neighbour entries exceed the 32-bit index of the rows");
    entries_ = total[0];
    moreThanAWord_ = total[1] != 0;
    const std::uint64_t words = static_cast<std::uint64_t>(v.count) + total[1];
    neighbor_.reserveWithSlack(entries_);
    near_.reserveWithSlack(words);
    if (contacts) {
      touch_.reserveWithSlack(words);
      spring_.reserveWithSlack(size_ * entries_);
    }
    switch (keepingOf(contacts, size_)) {
      case Keeping::Nothing:
        return exec.forEach(v.count, fill<Keeping::Nothing>(v, store, oldIndex));
      case Keeping::Springs:
        return exec.forEach(v.count, fill<Keeping::Springs>(v, store, oldIndex));
      case Keeping::Blocks:
        return exec.forEach(v.count, fill<Keeping::Blocks>(v, store, oldIndex));
    }
  }

  void countSprings(Exec &exec, std::uint32_t count, std::uint32_t *out)
  {
    exec.forEach(count, CountSprings<Real, W>{view(), out});
  }
  void extractSprings(Exec &exec, std::uint32_t count, const std::int32_t *tag, const std::uint32_t *offset,
                      const std::vector<signed char> &, std::int32_t *partner, Real *spring)
  {
    using K = Keeping;
    if (size_ == 3) exec.forEach(count, ExtractSprings<Real, K::Springs, W>{view(), 3, tag, offset, partner, spring});
    else exec.forEach(count, ExtractSprings<Real, K::Blocks, W>{view(), size_, tag, offset, partner, spring});
  }

 private:
  template <Keeping keeping>
  FillRows<P, keeping, W> fill(const BuildView<P> &v, const ContactStore<Real> &store, const std::uint32_t *oldIndex)
  {
    return {v, view(), neighbor_.data(), store, oldIndex};
  }

  template <class T>
  using Array = typename Exec::template Array<T>;
  Array<std::uint32_t> count_{"row lengths"}, sliceEntries_{"slice widths"}, sliceWords_{"slice words"},
      start_{"row starts"}, maskStart_{"touch starts"}, near_{"inner list"}, neighbor_{"neighbour rows"},
      touch_{"touch bits"};
  Array<Real> spring_{"tangential springs"};
  std::uint64_t entries_ = 0;
  bool moreThanAWord_ = true;  ///< a row has more than 32 entries
  int size_ = 0;  ///< numbers per contact
};

}  // namespace gpudem
