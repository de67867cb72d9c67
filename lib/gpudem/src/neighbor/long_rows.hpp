// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Rows of many entries on the GPU: where they lie, filling them, and what they keep across a rebuild. One thread for
/// every entry, wherever there may be thousands.
#pragma once

#include "base/saturated.hpp"
#include "base/warp.hpp"
#include "gpudem/errors.h"
#include "neighbor/rows.hpp"

namespace gpudem {

/// List the long rows of each slice, and leave its own rows without them.
template <int W>
struct ListLongRows {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  std::uint32_t count;
  const std::uint32_t *first;  ///< [slices+1]
  std::uint32_t *length;       ///< [n]
  LongRow *row;
  std::uint32_t *words, *segments;  ///< [rows]
  GPUDEM_HD void operator()(std::uint32_t slice) const
  {
    std::uint32_t r = first[slice];
    if (r == first[slice + 1]) return;
    for (std::uint32_t i = slice * W; i < (slice + 1) * W && i < count; ++i) {
      if (length[i] <= longestShortRow) continue;
      row[r] = {i, length[i], 0, 0, 0};
      words[r] = (length[i] + 31) / 32;
      segments[r] = row[r].segments();
      length[i] = 0;
      ++r;
    }
  }
};

struct PlaceLongRows {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  std::uint32_t entries, words;  ///< of the slices, which come before
  const std::uint32_t *wordsBefore, *segmentsBefore;  ///< [rows]
  LongRow *row;
  std::uint32_t *rowOfSegment;
  GPUDEM_HD void operator()(std::uint32_t r) const
  {
    row[r].start = entries + 32 * wordsBefore[r];
    row[r].word = words + wordsBefore[r];
    row[r].segment = segmentsBefore[r];
    for (std::uint32_t k = 0; k < row[r].segments(); ++k) rowOfSegment[segmentsBefore[r] + k] = r;
  }
};

/// Neighbours of the same and of coarser levels, which are few where there are levels.
template <class P>
struct StartLongRows {
  static constexpr int blockSize = 32;
  static constexpr int minimumBlocks = 1;
  BuildView<P> v;
  const LongRow *row;
  std::uint32_t *neighbor;
  GPUDEM_HD void operator()(std::uint32_t r) const
  {
    const std::uint32_t i = row[r].grain;
    std::uint32_t to = row[r].start;
    forEachOwnNeighbor(v, i, [&](std::uint32_t j, bool) { neighbor[to++] = j; });
    if (!v.cross.offset) return;
    for (std::uint32_t k = v.cross.offset[i]; k < v.cross.offset[i + 1]; ++k) neighbor[to++] = v.cross.coarser[k];
  }
};

/// Entry of a long row that thread \p thread takes; there are LongRow::segmentEntries for each segment.
template <class Real>
GPUDEM_HD std::uint32_t entryInLongRow(const RowView<Real> &rows, std::uint32_t thread, LongRow &row)
{
  const std::uint32_t segment = thread / LongRow::segmentEntries;
  row = rows.longRow[rows.rowOfSegment[segment]];
  return thread - row.segment * LongRow::segmentEntries;
}

/// Neighbours of finer levels, and the carried springs of all entries.
template <class P, Keeping keeping>
struct FinishLongRows {
  using Real = typename P::Real;
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  struct Shared {};
  BuildView<P> v;
  RowView<Real> rows;
  std::uint32_t *neighbor;
  ContactStore<Real> store;
  const std::uint32_t *oldIndex;  ///< [n] row of each grain in the store

  GPUDEM_HD void operator()(std::uint32_t thread, bool, Shared &) const
  {
    LongRow row;
    const std::uint32_t k = entryInLongRow(rows, thread, row), i = row.grain;
    const bool inRow = k < row.count;
    const std::uint32_t finer = v.cross.offset ? v.cross.end[i] - v.cross.first[i] : 0u, others = row.count - finer;
    if (inRow && k >= others) neighbor[row.start + k] = v.cross.finer[v.cross.first[i] + (k - others)];
    if (keeping == Keeping::Nothing) return;
    const std::uint32_t bits = warpBallot(inRow && carry(i, row.start + k));
    if (inRow && k % 32 == 0) rows.touch[row.word + k / 32] = bits;
  }

 private:
  GPUDEM_HD bool carry(std::uint32_t i, std::uint32_t entry) const
  {
    const std::uint32_t to = store.offset[oldIndex[i] + 1];
    const std::uint32_t m = store.find(store.offset[oldIndex[i]], to, v.tag[neighbor[entry]]);
    if (m == to) return false;
    const int size = keptSize<keeping>(store.size);
    const Real *kept = store.spring + size * static_cast<std::size_t>(m);
    Real *slot = rows.spring + size * static_cast<std::size_t>(entry);
    for (int d = 0; d < size; ++d) slot[d] = kept[d];
    return true;
  }
};

/// Number of springs in each long row, and in each of its words before a word.
template <class Real>
struct CountLongSprings {
  static constexpr int blockSize = 32;
  static constexpr int minimumBlocks = 1;
  RowView<Real> rows;
  std::uint32_t firstWord;  ///< of all long rows
  std::uint32_t *before;    ///< [words of long rows]
  std::uint32_t *out;       ///< [n]
  GPUDEM_HD void operator()(std::uint32_t r) const
  {
    const LongRow row = rows.longRow[r];
    std::uint32_t n = 0;
    for (std::uint32_t w = row.word; w < row.word + (row.count + 31) / 32; ++w) {
      before[w - firstWord] = n;
      n += static_cast<std::uint32_t>(bitCount(rows.touch[w]));
    }
    out[row.grain] = n;
  }
};

template <class Real, Keeping keeping>
struct ExtractLongSprings {
  static constexpr int blockSize = 128;
  static constexpr int minimumBlocks = 1;
  RowView<Real> rows;
  int storedSize;  ///< numbers per contact
  std::uint32_t firstWord;
  const std::uint32_t *before;
  const std::int32_t *tag;
  const std::uint32_t *offset;
  std::int32_t *partner;
  Real *spring;
  GPUDEM_HD void operator()(std::uint32_t thread) const
  {
    LongRow row;
    const std::uint32_t k = entryInLongRow(rows, thread, row), w = row.word + k / 32;
    if (k >= row.count) return;
    const std::uint32_t bits = rows.touch[w], bit = 1u << (k % 32);
    if (!(bits & bit)) return;
    const std::size_t to = offset[row.grain] + before[w - firstWord] + static_cast<std::uint32_t>(bitCount(bits & (bit - 1)));
    const std::size_t entry = row.start + k;
    const int size = keptSize<keeping>(storedSize);
    partner[to] = tag[rows.neighbor[entry]];
    for (int d = 0; d < size; ++d) spring[size * to + d] = rows.spring[size * entry + d];
  }
};

/// Where the long rows lie.
template <class Exec, class Real>
class LongRowTable {
 public:
  std::uint32_t rows() const { return rows_; }
  std::uint32_t segments() const { return segments_; }
  std::uint32_t words() const { return words_; }

  /// \param first   [slices+1] long rows before each slice
  /// \param rows    how many in all
  /// \param length  [n] of the rows; 0 afterwards for the long ones
  /// \param entries, firstWord of the slices, behind which the long rows come
  template <int W>
  void build(Exec &exec, std::uint32_t count, const std::uint32_t *first, std::uint32_t rows, std::uint32_t *length,
             std::uint32_t entries, std::uint32_t firstWord)
  {
    first_ = first;
    rows_ = rows;
    segments_ = words_ = 0;
    firstWord_ = firstWord;
    if (rows == 0) return;
    row_.reserveWithSlack(rows);
    for (auto *a : {&rowWords_, &rowSegments_}) a->reserveWithSlack(rows);
    for (auto *a : {&wordsBefore_, &segmentsBefore_}) a->reserveWithSlack(static_cast<std::size_t>(rows) + 1);
    exec.forEach(chunksOf(count, W), ListLongRows<W>{count, first, length, row_.data(), rowWords_.data(), rowSegments_.data()});
    exec.scan(rowWords_.data(), wordsBefore_.data(), rows);
    exec.scan(rowSegments_.data(), segmentsBefore_.data(), rows);
    const std::array<std::uint32_t, 2> total = exec.read({wordsBefore_.data() + rows, segmentsBefore_.data() + rows});
    words_ = total[0];
    segments_ = total[1];
    if ((entries + 32ull * words_) >> 32) throw Error("the neighbour entries exceed the 32-bit index of the rows");
    rowOfSegment_.reserveWithSlack(segments_);
    exec.forEach(rows, PlaceLongRows{entries, firstWord, wordsBefore_.data(), segmentsBefore_.data(), row_.data(),
                                     rowOfSegment_.data()});
    load_.reserveWithSlack(mostLoads * static_cast<std::size_t>(segments_));
  }
  void attach(RowView<Real> &view)
  {
    if (rows_ == 0) return;
    view.longFirst = first_;
    view.longRow = row_.data();
    view.rowOfSegment = rowOfSegment_.data();
    view.segmentLoad = load_.data();
  }
  /// After the rows of the slices. \param view with the long rows
  template <Keeping keeping, class P>
  void fill(Exec &exec, const BuildView<P> &v, const RowView<Real> &view, std::uint32_t *neighbor,
            const ContactStore<Real> &store, const std::uint32_t *oldIndex)
  {
    if (rows_ == 0) return;
    exec.forEach(rows_, StartLongRows<P>{v, row_.data(), neighbor});
    exec.forEachWarp(segments_ * LongRow::segmentEntries, FinishLongRows<P, keeping>{v, view, neighbor, store, oldIndex});
  }
  void countSprings(Exec &exec, const RowView<Real> &view, std::uint32_t *out)
  {
    if (rows_ == 0) return;
    springsBefore_.reserveWithSlack(words_);
    exec.forEach(rows_, CountLongSprings<Real>{view, firstWord_, springsBefore_.data(), out});
  }
  /// After countSprings().
  template <Keeping keeping>
  void extractSprings(Exec &exec, const RowView<Real> &view, int size, const std::int32_t *tag,
                      const std::uint32_t *offset, std::int32_t *partner, Real *spring)
  {
    if (rows_ == 0) return;
    exec.forEach(segments_ * LongRow::segmentEntries,
                 ExtractLongSprings<Real, keeping>{view, size, firstWord_, springsBefore_.data(), tag, offset, partner, spring});
  }
  std::size_t bytes() const
  {
    return row_.bytes() + rowWords_.bytes() + rowSegments_.bytes() + wordsBefore_.bytes() + segmentsBefore_.bytes() +
           rowOfSegment_.bytes() + springsBefore_.bytes() + load_.bytes();
  }

 private:
  static constexpr std::size_t mostLoads = 12;  ///< force, torque, virial
  template <class T>
  using Array = typename Exec::template Array<T>;
  Array<LongRow> row_{"rows of many entries"};
  Array<std::uint32_t> rowWords_{"words of long rows"}, rowSegments_{"segments of long rows"},
      wordsBefore_{"places of long rows"}, segmentsBefore_{"places of segments"}, rowOfSegment_{"rows of segments"},
      springsBefore_{"springs of long rows"};
  Array<Real> load_{"sums over segments"};
  const std::uint32_t *first_ = nullptr;
  std::uint32_t rows_ = 0, segments_ = 0, words_ = 0, firstWord_ = 0;
};

}  // namespace gpudem
