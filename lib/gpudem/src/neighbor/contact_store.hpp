// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What the contacts keep across a rebuild, and finding the contact with a given partner.
///
/// A row of some contacts is searched from end to end. The row of a body that touches thousands is sorted by the
/// partners once, so that carrying n contacts costs n log n operations and not n^2.
#pragma once

#include "base/annotate.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gpudem {

/// Contacts of a row above which it is sorted by its partners.
constexpr std::uint32_t longestUnsortedRow = 64;

/// What all contacts keep, as compressed rows in the order of the grains before a rebuild.
template <class Real>
struct ContactStore {
  int size;                     ///< numbers per contact
  const std::uint32_t *offset;  ///< [n+1]
  const std::int32_t *partner;  ///< tag of the partner; ascending in rows longer than longestUnsortedRow
  const Real *spring;           ///< [contacts][size]

  /// The contact with \p tag in the row [from, to), \p to if there is none.
  GPUDEM_HD std::uint32_t find(std::uint32_t from, std::uint32_t to, std::int32_t tag) const
  {
    const std::uint32_t end = to;
    if (to - from > longestUnsortedRow) {
      while (from < to) {
        const std::uint32_t middle = from + (to - from) / 2;
        if (partner[middle] < tag) from = middle + 1;
        else to = middle;
      }
      return from < end && partner[from] == tag ? from : end;
    }
    while (from < end && partner[from] != tag) ++from;
    return from;
  }
};

struct RowLength {
  const std::uint32_t *offset;
  GPUDEM_HD std::uint32_t operator()(std::uint32_t i) const { return offset[i + 1] - offset[i]; }
};
struct LongerRow {
  GPUDEM_HD std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const { return a > b ? a : b; }
};
/// Lengths of the rows to sort, 0 for the others.
struct LongRows {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const std::uint32_t *offset;
  std::uint32_t *length;  ///< [n]
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const std::uint32_t n = offset[i + 1] - offset[i];
    length[i] = n > longestUnsortedRow ? n : 0u;
  }
};

/// The contacts of long rows, numbered from 0 one row after the other.
struct LongRowContacts {
  std::uint32_t count;          ///< rows, long or not
  const std::uint32_t *offset;  ///< [n+1] in the store
  const std::uint32_t *first;   ///< [n+1] number of the first contact of each row
  GPUDEM_HD std::uint32_t rowOf(std::uint32_t k) const
  {
    std::uint32_t low = 0, high = count;  // first[low] <= k < first[high]
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (first[middle] <= k) low = middle;
      else high = middle;
    }
    return low;
  }
  GPUDEM_HD std::uint32_t inStore(std::uint32_t k) const
  {
    const std::uint32_t row = rowOf(k);
    return offset[row] + (k - first[row]);
  }
};
struct PartnersOfLongRows {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  LongRowContacts contacts;
  const std::int32_t *partner;
  std::uint32_t *key;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    key[k] = static_cast<std::uint32_t>(partner[contacts.inStore(k)]);
  }
};
struct RowsOfContacts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  LongRowContacts contacts;
  const std::uint32_t *order;
  std::uint32_t *key;
  GPUDEM_HD void operator()(std::uint32_t k) const { key[k] = contacts.rowOf(order[k]); }
};
/// Copy the k-th contact of the sorted order out of the store.
template <class Real>
struct TakeContacts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  LongRowContacts contacts;
  const std::uint32_t *byPartner, *byRow;  ///< sorted by partner, and that order by row
  int size;
  const std::int32_t *partner;
  const Real *spring;
  std::int32_t *partnerOut;
  Real *springOut;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const std::size_t from = contacts.inStore(byPartner[byRow[k]]);
    partnerOut[k] = partner[from];
    for (int d = 0; d < size; ++d) springOut[static_cast<std::size_t>(size) * k + d] = spring[size * from + d];
  }
};
template <class Real>
struct PutContacts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  LongRowContacts contacts;
  int size;
  const std::int32_t *partner;
  const Real *spring;
  std::int32_t *partnerOut;
  Real *springOut;
  GPUDEM_HD void operator()(std::uint32_t k) const
  {
    const std::size_t to = contacts.inStore(k);
    partnerOut[to] = partner[k];
    for (int d = 0; d < size; ++d) springOut[size * to + d] = spring[static_cast<std::size_t>(size) * k + d];
  }
};

/// Sorts the long rows of a store by their partners. Without any it costs one look at the lengths.
template <class Exec, class Real>
class StoreSorter {
 public:
  /// \param partner, spring of the store, sorted in place
  void sort(Exec &exec, std::uint32_t count, int size, const std::uint32_t *offset, std::int32_t *partner, Real *spring)
  {
    if (exec.reduce(count, RowLength{offset}, LongerRow{}, 0u) <= longestUnsortedRow) return;
    length_.reserve(count);
    first_.reserve(static_cast<std::size_t>(count) + 1);
    exec.forEach(count, LongRows{offset, length_.data()});
    const std::uint32_t m = exec.exclusiveScan(length_.data(), first_.data(), count);
    const LongRowContacts contacts{count, offset, first_.data()};
    for (auto *a : {&key_, &sorted_, &byPartner_, &byRow_}) a->reserveWithSlack(m);
    partner_.reserveWithSlack(m);
    spring_.reserveWithSlack(static_cast<std::size_t>(size) * m);
    exec.forEach(m, PartnersOfLongRows{contacts, partner, key_.data()});
    exec.sort(key_, sorted_, byPartner_, m, 0xffffffffu);
    exec.forEach(m, RowsOfContacts{contacts, byPartner_.data(), key_.data()});
    exec.sort(key_, sorted_, byRow_, m, count);  // stable: partners stay in order within a row
    exec.forEach(m, TakeContacts<Real>{contacts, byPartner_.data(), byRow_.data(), size, partner, spring, partner_.data(),
                                       spring_.data()});
    exec.forEach(m, PutContacts<Real>{contacts, size, partner_.data(), spring_.data(), partner, spring});
  }
  std::size_t bytes() const
  {
    return length_.bytes() + first_.bytes() + key_.bytes() + sorted_.bytes() + byPartner_.bytes() + byRow_.bytes() +
           partner_.bytes() + spring_.bytes();
  }

 private:
  template <class T>
  using Array = typename Exec::template Array<T>;
  Array<std::uint32_t> length_{"long rows"}, first_{"long rows (2)"}, key_{"contacts of long rows"},
      sorted_{"contacts of long rows (2)"}, byPartner_{"contacts of long rows (3)"}, byRow_{"contacts of long rows (4)"};
  Array<std::int32_t> partner_{"partners of long rows"};
  Array<Real> spring_{"springs of long rows"};
};

}  // namespace gpudem
