// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour table of the GPU: rows in slices of 32 grains. Same interface as pair_table.hpp.
#pragma once

#include "neighbor/long_rows.hpp"

namespace gpudem {

template <class Exec, class P>
class RowTable {
 public:
  using Real = typename P::Real;
  using View = RowView<Real>;
  static constexpr int W = 32;

  View view()
  {
    View v{};
    v.start = start_.data();
    v.maskStart = maskStart_.data();
    v.count = count_.data();
    v.near = near_.data();
    v.neighbor = neighbor_.data();
    v.touch = touch_.data();
    v.spring = spring_.data();
    long_.attach(v);
    return v;
  }
  /// Entries of all rows, padding included.
  std::uint64_t entries() const { return entries_; }
  /// Teams that the long rows take.
  std::uint32_t segments() const { return long_.segments(); }
  /// Can any row have more than \p contacts?
  bool mayHoldMore(std::uint32_t contacts) const { return moreThanAWord_ || contacts < 32; }
  std::size_t bytes() const
  {
    return count_.bytes() + sliceEntries_.bytes() + sliceWords_.bytes() + start_.bytes() + maskStart_.bytes() +
           near_.bytes() + neighbor_.bytes() + touch_.bytes() + spring_.bytes() + sliceLong_.bytes() + longFirst_.bytes() +
           long_.bytes();
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
    sliceLong_.reserve(slices);
    for (auto *a : {&start_, &maskStart_, &longFirst_}) a->reserve(slices + 1);
    exec.forEach(v.count, CountNeighbors<P>{v, count_.data()});
    exec.forEach(slices, SliceWidths<W>{v.count, count_.data(), sliceEntries_.data(), sliceWords_.data(), sliceLong_.data()});
    exec.scan(sliceEntries_.data(), start_.data(), slices);
    exec.scan(sliceWords_.data(), maskStart_.data(), slices);
    exec.scan(sliceLong_.data(), longFirst_.data(), slices);
    const std::array<std::uint32_t, 3> total =
        exec.read({start_.data() + slices, maskStart_.data() + slices, longFirst_.data() + slices});
    exec.forEach(slices + 1, AddToAll{v.count, maskStart_.data()});  // the first words of the rows come before
    if (total[0] == saturated) throw Error("the neighbour entries exceed the 32-bit index of the rows");
    long_.template build<W>(exec, v.count, longFirst_.data(), total[2], count_.data(), total[0], v.count + total[1]);
    entries_ = total[0] + 32ull * long_.words();
    moreThanAWord_ = total[1] != 0 || total[2] != 0;
    const std::uint64_t words = static_cast<std::uint64_t>(v.count) + total[1] + long_.words();
    neighbor_.reserveWithSlack(entries_);
    near_.reserveWithSlack(words);
    if (contacts) {
      touch_.reserveWithSlack(words);
      spring_.reserveWithSlack(size_ * entries_);
    }
    switch (keepingOf(contacts, size_)) {
      case Keeping::Nothing:
        return fill<Keeping::Nothing>(exec, v, store, oldIndex);
      case Keeping::Springs:
        return fill<Keeping::Springs>(exec, v, store, oldIndex);
      case Keeping::Blocks:
        return fill<Keeping::Blocks>(exec, v, store, oldIndex);
    }
  }

  void countSprings(Exec &exec, std::uint32_t count, std::uint32_t *out)
  {
    exec.forEach(count, CountSprings<Real, W>{view(), out});
    long_.countSprings(exec, view(), out);
  }
  void extractSprings(Exec &exec, std::uint32_t count, const std::int32_t *tag, const std::uint32_t *offset,
                      const std::vector<signed char> &, std::int32_t *partner, Real *spring)
  {
    if (size_ == 3) extract<Keeping::Springs>(exec, count, tag, offset, partner, spring);
    else extract<Keeping::Blocks>(exec, count, tag, offset, partner, spring);
  }

 private:
  template <Keeping keeping>
  void fill(Exec &exec, const BuildView<P> &v, const ContactStore<Real> &store, const std::uint32_t *oldIndex)
  {
    exec.forEach(v.count, FillRows<P, keeping, W>{v, view(), neighbor_.data(), store, oldIndex});
    long_.template fill<keeping>(exec, v, view(), neighbor_.data(), store, oldIndex);
  }
  template <Keeping keeping>
  void extract(Exec &exec, std::uint32_t count, const std::int32_t *tag, const std::uint32_t *offset,
               std::int32_t *partner, Real *spring)
  {
    exec.forEach(count, ExtractSprings<Real, keeping, W>{view(), size_, tag, offset, partner, spring});
    long_.template extractSprings<keeping>(exec, view(), size_, tag, offset, partner, spring);
  }

  template <class T>
  using Array = typename Exec::template Array<T>;
  Array<std::uint32_t> count_{"row lengths"}, sliceEntries_{"slice widths"}, sliceWords_{"slice words"},
      start_{"row starts"}, maskStart_{"touch starts"}, sliceLong_{"long rows of slices"}, longFirst_{"long rows before"}, near_{"inner list"}, neighbor_{"neighbour rows"},
      touch_{"touch bits"};
  Array<Real> spring_{"tangential springs"};
  LongRowTable<Exec, Real> long_;
  std::uint64_t entries_ = 0;
  bool moreThanAWord_ = true;  ///< a row has more than 32 entries
  int size_ = 0;  ///< numbers per contact
};

}  // namespace gpudem
