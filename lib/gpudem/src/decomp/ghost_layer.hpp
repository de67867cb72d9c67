// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The ghosts of a rank: who they are, decided when rows are built, and their motion, fetched after every drift.
///
/// One message to and from each partner: whole records when rows are built, positions, velocities and spins after that.
/// Forces never travel: both ranks evaluate a contact across their border, to the same bits.
#pragma once

#include "decomp/ghost_select.hpp"
#include "decomp/ghost_state.hpp"
#include "decomp/unit_list.hpp"
#include "gpudem/errors.h"
#include "gpudem/rank_exchange.h"
#include "neighbor/levels.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace gpudem {

template <class Exec, class P>
class GhostLayer {
 public:
  /// \param exchange null: one rank
  void join(RankExchange *exchange) { exchange_ = exchange && exchange->ranks() > 1 ? exchange : nullptr; }
  bool joined() const { return exchange_ != nullptr; }
  RankExchange &ranks() { return *exchange_; }

  /// Tell all ranks where the grains are. Chooses the partners.
  /// \param middle of the sub-domain (distance)
  /// \param period of each axis, 0 if it has none (distance)
  /// \param beyond what a row allows for beyond the radii: skin and more (distance)
  /// \return the velocities of all grains of all ranks
  VelocityRange survey(Exec &exec, const RankExtent &own, std::uint32_t count, const Vec3<double> &middle,
                       const Vec3<double> &period, double beyond);

  /// Which grains the partners need, and how many ghosts there will be.
  /// \param s without partners
  /// \param unit grains of a unit of work
  /// \return the number of ghosts
  std::uint32_t select(Exec &exec, std::uint32_t count, SelectionView<P> s, std::uint32_t unit);

  /// Fetch the records of the ghosts and sort them by cell, into their places behind the \p count grains.
  /// \param cell  where the sorted cells of the ghosts go
  /// \param spare the buffers that do not hold the state now
  void introduce(Exec &exec, std::uint32_t count, const GrainArrays<P> &grains, const PositionArrays<P> &spare,
                 const LevelGrid &levels, const CellGrid &grid, const Frame &frame, std::uint32_t *cell);

  /// Send the present motion of the grains that others see.
  void beginRefresh(Exec &exec, const PositionArrays<P> &grains)
  {
    packed_.reserveWithSlack(sizeof(GhostState<P>) * sent_);
    received_.reserveWithSlack(sizeof(GhostState<P>) * ghosts_);
    exec.forEach(sent_, PackStates<P>{grains, index_.data(), reinterpret_cast<GhostState<P> *>(packed_.data())});
    beginSwap(exec, sizeof(GhostState<P>));
  }
  /// Wait for the motion of the ghosts.
  void finishRefresh(Exec &exec, std::uint32_t count, const PositionArrays<P> &grains)
  {
    finishSwap(exec, sizeof(GhostState<P>));
    exec.forEach(ghosts_, UnpackStates<P>{reinterpret_cast<const GhostState<P> *>(received_.data()), order_.data(),
                                          count, grains});
  }

  /// Units of work with grains that other ranks see, and the others.
  UnitList border() const { return {border_.data(), borderUnits_}; }
  UnitList interior() const { return {interior_.data(), units_ - borderUnits_}; }

  std::uint32_t ghosts() const { return ghosts_; }
  std::uint32_t sent() const { return sent_; }
  int partners() const { return static_cast<int>(partners_.size()); }
  std::size_t bytes() const
  {
    return extent_.bytes() + flag_.bytes() + place_.bytes() + boundary_.bytes() + index_.bytes() + order_.bytes() +
           key_.bytes() + sorted_.bytes() + border_.bytes() + interior_.bytes() + packed_.bytes() + received_.bytes();
  }

 private:
  struct Partner {
    int rank;
    std::uint32_t sendFrom, send, receiveFrom, receive;  ///< grains
  };

  void tellCounts();
  void divideUnits(Exec &exec, std::uint32_t count, std::uint32_t unit);
  void beginSwap(Exec &exec, std::size_t size);
  void finishSwap(Exec &exec, std::size_t size);
  bool direct() const { return !Exec::onGpu || exchange_->readsDeviceMemory(); }

  template <class T>
  using Array = typename Exec::template Array<T>;

  RankExchange *exchange_ = nullptr;
  std::vector<Partner> partners_;
  std::uint32_t sent_ = 0, ghosts_ = 0, units_ = 0, borderUnits_ = 0;
  Array<PartnerExtent> extent_{"extents of other ranks"};
  Array<std::uint32_t> flag_{"flags of the boundary"}, place_{"places in messages"}, boundary_{"boundary"},
      index_{"grains in messages"}, order_{"order of the ghosts"}, key_{"cell keys of the ghosts"},
      sorted_{"cells of the ghosts"}, border_{"units at the border"}, interior_{"units in the interior"};
  Array<unsigned char> packed_{"messages to other ranks"}, received_{"messages from other ranks"};
  typename Exec::template HostArray<unsigned char> hostPacked_{"messages to other ranks on the host"},
      hostReceived_{"messages from other ranks on the host"};
};

/// Cell in which a ghost is searched.
template <class P>
struct PlaceGhosts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const GhostRecord<P> *in;
  std::uint32_t fineMask;
  LevelGrid levels;
  CellGrid grid;
  Frame frame;
  std::uint32_t *key;
  GPUDEM_HD void operator()(std::uint32_t g) const
  {
    const GhostRecord<P> r = in[g];
    const Vec3<double> x = absolutePosition(ghostPosition(r.state, fineMask), r.identity.home, grid, frame);
    key[g] = levels.cellOf(x, static_cast<float>(r.identity.radius));
  }
};

template <class Exec, class P>
VelocityRange GhostLayer<Exec, P>::survey(Exec &exec, const RankExtent &own, std::uint32_t count,
                                          const Vec3<double> &middle, const Vec3<double> &period, double beyond)
{
  struct Survey {
    double middle[3], half[3], radius, grains, lowest[3], highest[3];
  };
  constexpr int numbers = sizeof(Survey) / sizeof(double);
  Survey mine{};
  if (count) {
    mine.radius = own.radius;
    mine.grains = count;
    for (int d = 0; d < 3; ++d) {
      mine.middle[d] = middle[d] + 0.5 * (own.lo[d] + own.hi[d]);
      mine.half[d] = 0.5 * (own.hi[d] - own.lo[d]) + 1e-9 * (own.hi[d] - own.lo[d]);  // a hair for round-off
      mine.lowest[d] = static_cast<double>(own.velocity.lo[d]);
      mine.highest[d] = static_cast<double>(own.velocity.hi[d]);
    }
  }
  std::vector<Survey> all(exchange_->ranks());
  exchange_->gather(reinterpret_cast<const double *>(&mine), numbers, reinterpret_cast<double *>(all.data()));

  const float huge = std::numeric_limits<float>::max();
  VelocityRange range{{huge, huge, huge}, {-huge, -huge, -huge}};
  std::vector<PartnerExtent> extents;
  partners_.clear();
  for (int r = 0; r < exchange_->ranks(); ++r) {
    const Survey &other = all[r];
    if (other.grains == 0.0) continue;
    VelocityRange velocity;
    for (int d = 0; d < 3; ++d) {
      velocity.lo[d] = static_cast<float>(other.lowest[d]);
      velocity.hi[d] = static_cast<float>(other.highest[d]);
    }
    range = JoinRanges{}(range, velocity);
    if (r == exchange_->rank() || !count) continue;
    double apart2 = 0.0;  // the same on both sides to the last bit, so that both expect the other's message
    for (int d = 0; d < 3; ++d) {
      const double apart =
          std::abs(shorterWay(std::abs(mine.middle[d] - other.middle[d]), period[d])) - (mine.half[d] + other.half[d]);
      if (apart > 0.0) apart2 += apart * apart;
    }
    const double reach = (mine.radius + other.radius) * 1.0001 + beyond;
    if (apart2 > reach * reach) continue;
    partners_.push_back({r, 0, 0, 0, 0});
    extents.push_back({{other.middle[0], other.middle[1], other.middle[2]},
                       {other.half[0], other.half[1], other.half[2]},
                       other.radius * 1.00001 + beyond});
  }
  extent_.reserveWithSlack(std::max<std::size_t>(1, extents.size()));
  exec.copyIn(extent_.data(), extents.data(), extents.size());
  return range;
}

template <class Exec, class P>
std::uint32_t GhostLayer<Exec, P>::select(Exec &exec, std::uint32_t count, SelectionView<P> s, std::uint32_t unit)
{
  const auto partners = static_cast<std::uint32_t>(partners_.size());
  s.partner = extent_.data();
  s.partners = partners;
  sent_ = ghosts_ = 0;
  if (partners == 0) {
    divideUnits(exec, count, unit);
    return 0;
  }

  flag_.reserveWithSlack(count);
  place_.reserveWithSlack(static_cast<std::size_t>(count) + 1);
  exec.forEach(count, MarkBoundary<P>{s, flag_.data()});
  const std::uint32_t size = exec.exclusiveScan(flag_.data(), place_.data(), count);
  boundary_.reserveWithSlack(size);
  exec.forEach(count, ListMarked{flag_.data(), place_.data(), nullptr, 1, boundary_.data()});

  const std::uint64_t pairs = static_cast<std::uint64_t>(size) * partners;
  if (pairs >> 32)
    throw Error(fmt::format("{} grains at the border to {} ranks exceed the 32-bit index", size, partners));
  const auto items = static_cast<std::uint32_t>(pairs);
  flag_.reserveWithSlack(std::max(items, partners + 1));
  place_.reserveWithSlack(pairs + 1);
  exec.forEach(items, MarkSent<P>{s, boundary_.data(), size, flag_.data()});
  sent_ = exec.exclusiveScan(flag_.data(), place_.data(), items);
  index_.reserveWithSlack(sent_);
  exec.forEach(items, ListMarked{flag_.data(), place_.data(), boundary_.data(), size, index_.data()});

  std::vector<std::uint32_t> from(partners + 1, 0u);
  exec.forEach(partners + 1, PickEvery{place_.data(), size, flag_.data()});
  exec.copyOut(from.data(), flag_.data(), from.size());
  for (std::uint32_t k = 0; k < partners; ++k) {
    partners_[k].sendFrom = from[k];
    partners_[k].send = from[k + 1] - from[k];
  }
  tellCounts();
  divideUnits(exec, count, unit);
  return ghosts_;
}

template <class Exec, class P>
void GhostLayer<Exec, P>::divideUnits(Exec &exec, std::uint32_t count, std::uint32_t unit)
{
  units_ = (count + unit - 1) / unit;
  flag_.reserveWithSlack(units_);
  place_.reserveWithSlack(static_cast<std::size_t>(units_) + 1);
  border_.reserveWithSlack(units_);
  interior_.reserveWithSlack(units_);
  exec.fill(flag_.data(), units_, 0);
  exec.forEach(sent_, MarkUnits{index_.data(), unit, flag_.data()});
  borderUnits_ = exec.exclusiveScan(flag_.data(), place_.data(), units_);
  exec.forEach(units_, ListMarked{flag_.data(), place_.data(), nullptr, 1, border_.data()});
  exec.forEach(units_, InvertFlags{flag_.data()});
  exec.scan(flag_.data(), place_.data(), units_);
  exec.forEach(units_, ListMarked{flag_.data(), place_.data(), nullptr, 1, interior_.data()});
}

/// How many grains will come from each partner.
template <class Exec, class P>
void GhostLayer<Exec, P>::tellCounts()
{
  std::vector<RankMessage> send, receive;
  for (Partner &partner : partners_) {
    send.push_back({partner.rank, &partner.send, sizeof partner.send});
    receive.push_back({partner.rank, &partner.receive, sizeof partner.receive});
  }
  exchange_->beginExchange(send, receive);
  exchange_->finishExchange();
  std::uint64_t total = 0;
  for (Partner &partner : partners_) {
    partner.receiveFrom = static_cast<std::uint32_t>(total);
    total += partner.receive;
  }
  if (total >> 31) throw Error(fmt::format("{} ghosts exceed the 32-bit index", total));
  ghosts_ = static_cast<std::uint32_t>(total);
}

/// Messages of \p size bytes a grain, from packed_ to received_.
template <class Exec, class P>
void GhostLayer<Exec, P>::beginSwap(Exec &exec, std::size_t size)
{
  unsigned char *out = packed_.data(), *in = received_.data();
  if (direct()) {
    exec.synchronize();
  } else {
    hostPacked_.reserveWithSlack(size * sent_);
    hostReceived_.reserveWithSlack(size * ghosts_);
    out = hostPacked_.data();
    in = hostReceived_.data();
    exec.copyOut(out, packed_.data(), size * sent_);
  }
  std::vector<RankMessage> send, receive;
  for (const Partner &partner : partners_) {
    if (partner.send) send.push_back({partner.rank, out + size * partner.sendFrom, size * partner.send});
    if (partner.receive) receive.push_back({partner.rank, in + size * partner.receiveFrom, size * partner.receive});
  }
  exchange_->beginExchange(send, receive);
}

template <class Exec, class P>
void GhostLayer<Exec, P>::finishSwap(Exec &exec, std::size_t size)
{
  exchange_->finishExchange();
  if (!direct()) exec.copyIn(received_.data(), hostReceived_.data(), size * ghosts_);
}

template <class Exec, class P>
void GhostLayer<Exec, P>::introduce(Exec &exec, std::uint32_t count, const GrainArrays<P> &grains,
                                    const PositionArrays<P> &spare, const LevelGrid &levels, const CellGrid &grid,
                                    const Frame &frame, std::uint32_t *cell)
{
  using Record = GhostRecord<P>;
  packed_.reserveWithSlack(sizeof(Record) * sent_);
  received_.reserveWithSlack(sizeof(Record) * ghosts_);
  exec.forEach(sent_, PackRecords<P>{grains, index_.data(), reinterpret_cast<Record *>(packed_.data())});
  beginSwap(exec, sizeof(Record));
  finishSwap(exec, sizeof(Record));

  const auto *records = reinterpret_cast<const Record *>(received_.data());
  key_.reserveWithSlack(ghosts_);
  sorted_.reserveWithSlack(ghosts_);
  order_.reserveWithSlack(ghosts_);
  exec.forEach(ghosts_, PlaceGhosts<P>{records, grains.position.fineMask, levels, grid, frame, key_.data()});
  exec.sort(key_, sorted_, order_, ghosts_, levels.cells());
  exec.forEach(ghosts_, UnpackRecords<P>{records, order_.data(), count, grains, spare});
  exec.forEach(ghosts_, CopyValues<std::uint32_t>{sorted_.data(), cell + count});
}

}  // namespace gpudem
