// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: fields between host and device.
#pragma once

#include "engine/engine_impl.hpp"

namespace gpudem {

template <class Exec, class P>
MemoryReport EngineImpl<Exec, P>::memory() const
{
  std::size_t b = 0;
  const auto add = [&](const auto &a) { b += a.bytes(); };
  for (int k = 0; k < 2; ++k) {
    add(coarse_[k]);
    add(fine_[k]);
    add(motion_[k]);
  }
  for (const auto *a : {&type_, &image_, &intScratch_, &tag_, &storePartner_}) add(*a);
  for (const auto *a :
       {&mask_, &hostIndex_, &cell_, &key_, &order_, &anchor_, &uintScratch_, &searchCell_, &storeOffset_})
    add(*a);
  for (const auto *a : {&force_, &torque_, &vecScratch_}) add(*a);
  for (const auto *a : {&origin_, &originScratch_}) add(*a);
  for (const auto *a : {&storeSpring_, &virial_}) add(*a);
  for (const auto &a : wallHistory_) add(a);
  for (const auto &a : regionLoad_) add(a);
  for (const SurfaceWall &s : surfaces_) {
    add(s.copy);
    for (const auto *a : {&s.near, &s.nearGrain, &s.nearList, &s.nearSlots, &s.touches.at}) add(*a);
    add(s.nearGap);
    add(s.nearFrom);
    add(s.touches.room);
  }
  add(models_);
  add(cells_);
  add(ghostCells_);
  add(layer_);
  add(cross_);
  add(storeSorter_);
  add(blockScratch_);
  for (const auto &a : termBefore_) add(a);
  for (const auto &a : wallContacts_) add(a);
  add(staging_);
  add(table_);
  return {b, exec_.capacity()};
}

/// What a grain of this scene takes on the device, for messages: measured rows if there are any, ten entries if not.
template <class Exec, class P>
std::size_t EngineImpl<Exec, P>::bytesPerGrain() const
{
  const double entries = report_.entriesPerGrain > 0.0 ? report_.entriesPerGrain : 10.0;
  std::size_t b = 2 * (sizeof(CoarsePosition) + sizeof(Motion<Real>) + (P::fine ? sizeof(FinePosition) : 0));
  b += 15 * sizeof(std::uint32_t) + 3 * sizeof(Vec3<Real>);  // indices, flags, keys; forces, torques, scratch
  b += static_cast<std::size_t>(entries * sizeof(std::uint32_t));
  if (keepsContacts_) {  // in the rows and, for some six contacts, in the store
    const std::size_t numbers = static_cast<std::size_t>(layout_.size) * sizeof(Real);
    b += static_cast<std::size_t>(entries * static_cast<double>(numbers)) + 6 * (numbers + sizeof(std::int32_t));
  }
  for (const int size : wallSize_) b += static_cast<std::size_t>(size) * sizeof(Real);
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) b += isApart(scene_.walls[w]) ? 2 * sizeof(Vec3<Real>) : 0;
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) b += isSurface(w) ? sizeof(std::uint32_t) : 0;  // near or not
  return b;
}

/// Run \p work; if memory runs out, say how many grains would have fitted.
template <class Exec, class P>
template <class Work>
void EngineImpl<Exec, P>::explainMemory(const Work &work)
{
  const auto fitting = [&] {
    const std::size_t capacity = exec_.capacity();
    if (!capacity) return std::string();
    return fmt::format("; about {} atoms of this scene fit into the device's {} bytes ({} bytes each)",
                       capacity / bytesPerGrain(), capacity, bytesPerGrain());
  };
  try {
    work();
  } catch (const OutOfMemory &e) {
    throw OutOfMemory(fmt::format("{}, with {} atoms{}", e.what(), count_, fitting()));
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::reserveParticles()
{
  const std::size_t n = std::max<std::size_t>(1, count_);
  for (int k = 0; k < 2; ++k) {
    coarse_[k].reserve(n);
    if (P::fine) fine_[k].reserve(n);
    motion_[k].reserve(n);
  }
  type_.reserve(n);
  image_.reserve(n);
  tag_.reserve(n);
  hostIndex_.reserve(n);
  mask_.reserve(n);
  cell_.reserve(n);
  anchor_.reserve(n);
  force_.reserve(n);
  torque_.reserve(n);
  for (std::size_t w = 0; w < wallSize_.size(); ++w) {
    if (isApart(scene_.walls[w])) regionLoad_[w].reserve(2 * n);
    if (isSurface(w)) {
      surfaces_[w].near.reserve(n);
      exec_.fill(surfaces_[w].near.data(), n, 0);
    }
    if (!wallSize_[w]) continue;
    wallHistory_[w].reserve(n * static_cast<std::size_t>(wallSize_[w]));
    exec_.fill(wallHistory_[w].data(), n * static_cast<std::size_t>(wallSize_[w]), 0);
  }
}

template <class Exec, class P>
template <class T>
const T *EngineImpl<Exec, P>::stageIn(const T *host, std::size_t count)
{
  T *p = stageOut<T>(count);
  exec_.copyIn(p, host, count);
  return p;
}

template <class Exec, class P>
template <class T>
T *EngineImpl<Exec, P>::stageOut(std::size_t count)
{
  staging_.reserve(count * sizeof(T));
  return reinterpret_cast<T *>(staging_.data());
}

/// Levels and reach that fit the radii, which may have grown since the scene was set.
template <class Exec, class P>
SizeRange EngineImpl<Exec, P>::adoptSizes(const HostParticles &host)
{
  const SizeRange sizes = sizeRange(host, scene_.largestRadius);
  if (layer_.joined() && sizes.largest > scene_.largestRadius)  // other ranks would know nothing of it
    throw Error(fmt::format("a radius grew to {:g}, beyond {:g}, the largest that was known when the run began: run on one "
                            "rank, or begin with a grain of the final size",
                            sizes.largest, scene_.largestRadius));
  scene_.largestRadius = sizes.largest;
  pullOffGap_ = largestPullOffGap(scene_);
  requireRoom(box_);
  const double ratio = scene_.levelRatio > 0.0 ? scene_.levelRatio : Exec::onGpu ? levelRatioOnGpu : levelRatioOnCpu;
  levelRadii_ = chooseLevels(host.radius, host.count, sizes.largest, scene_.levels, ratio);
  return sizes;
}

template <class Exec, class P>
void EngineImpl<Exec, P>::importShape(const HostParticles &host)
{
  exec_.forEach(count_, ImportRadius<P>{stageIn(host.radius, count_), hostIndex_.data(), positions()});
  exec_.forEach(count_, ImportMass<Real>{stageIn(host.mass, count_), hostIndex_.data(), motion_[motNow_].data()});
}

/// Two grains may meet through one face of a periodic box only.
template <class Exec, class P>
void EngineImpl<Exec, P>::requireRoom(const Box &box) const
{
  const double reach = reachOf(scene_, pullOffGap_, skin_);
  for (int d = 0; d < box.dimension; ++d)
    if (box.periodic[d] && box.hi[d] - box.lo[d] < 2.0 * reach)
      throw Error(fmt::format("the periodic box is {:g} long in {}, shorter than twice the interaction range {:g}",
                              box.hi[d] - box.lo[d], "xyz"[d], reach));
}

template <class Exec, class P>
void EngineImpl<Exec, P>::upload(const HostParticles &host, const Box &box, const ContactHistory *history)
{
  if (host.count >= noParticle) throw Error(fmt::format("{} grains exceed the 32-bit index", host.count));
  count_ = 0;  // until all that may be refused is checked
  ghosts_ = 0;
  box_ = box;
  rowsValid_ = false;
  queued_ = 0;
  resetStatus();
  const SizeRange sizes = adoptSizes(host);
  grid_ = chooseGrid(box, reachOf(scene_, pullOffGap_, skin_), mostCells);
  frame_ = chooseFrame(box, grid_);
  anchorRule_ = chooseAnchors(frame_, skin_);
  requireResolved(sizes, frame_, coordinateBits(scene_, precision_));
  count_ = static_cast<std::uint32_t>(host.count);
  explainMemory([&] { reserveParticles(); });
  if (count_) {
    exec_.forEach(count_, IdentityValues{hostIndex_.data()});
    exec_.copyIn(tag_.data(), host.tag, count_);
    exec_.copyIn(image_.data(), host.image, count_);
    importShape(host);
    uploadFields(host, fieldMask | fieldKinetic | fieldForce | fieldTorque);
  }
  forceValid_ = host.force != nullptr;
  storeFresh_ = keepsContacts_;
  if (storeFresh_) {
    const std::size_t contacts = history ? history->partner.size() : 0;
    storeOffset_.reserve(count_ + 1);
    storePartner_.reserveWithSlack(contacts);
    storeSpring_.reserveWithSlack(static_cast<std::size_t>(layout_.size) * contacts);
    if (history) {
      if (history->size != layout_.size)
        throw Error(
            fmt::format("contacts came with {} numbers each; the contact laws keep {}", history->size, layout_.size));
      const std::vector<Real> spring(history->spring.begin(), history->spring.end());
      exec_.copyIn(storeOffset_.data(), history->offset.data(), history->offset.size());
      exec_.copyIn(storePartner_.data(), history->partner.data(), contacts);
      exec_.copyIn(storeSpring_.data(), spring.data(), spring.size());
      sortStore();
    } else {
      exec_.fill(storeOffset_.data(), count_ + 1, 0);
    }
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::uploadFields(const HostParticles &host, unsigned fields)
{
  if (host.count != count_)
    throw Error(
        fmt::format("{} grains on the host, {} resident: the whole state must be uploaded", host.count, count_));
  if (fields & (fieldShape | fieldPosition | fieldMask)) rowsValid_ = false;
  if (count_) importFields(host, fields);
  // the next force may be that of this very position
  if (layer_.joined() && rowsValid_ && (fields & (fieldVelocity | fieldSpin)))
    followGhosts(positions());
}

template <class Exec, class P>
void EngineImpl<Exec, P>::importFields(const HostParticles &host, unsigned fields)
{
  const std::uint32_t *index = hostIndex_.data();
  Motion<Real> *motion = motion_[motNow_].data();
  const auto vectors = [&](const double *p) { return stageIn(reinterpret_cast<const Vec3<double> *>(p), count_); };
  if ((fields & fieldShape) && host.radius) {
    const SizeRange sizes = adoptSizes(host);
    requireResolved(sizes, chooseFrame(box_, chooseGrid(box_, reachOf(scene_, pullOffGap_, skin_), mostCells)),
                    coordinateBits(scene_, precision_));
    importShape(host);
    rowsValid_ = false;
  }
  if ((fields & fieldPosition) && host.position)
    exec_.forEach(count_,
                  ImportPositions<P>{vectors(host.position), nullptr, index, grid_, frame_, positions(), cell_.data()});
  if ((fields & fieldVelocity) && host.velocity)
    exec_.forEach(count_, ImportMotion<Real>{vectors(host.velocity), index, VectorField::Velocity, motion});
  if ((fields & fieldSpin) && host.spin)
    exec_.forEach(count_, ImportMotion<Real>{vectors(host.spin), index, VectorField::Spin, motion});
  if ((fields & fieldForce) && host.force)
    exec_.forEach(count_, ImportValues<Vec3<double>, Vec3<Real>>{vectors(host.force), index, force_.data()});
  if ((fields & fieldTorque) && host.torque)
    exec_.forEach(count_, ImportValues<Vec3<double>, Vec3<Real>>{vectors(host.torque), index, torque_.data()});
  if ((fields & fieldMask) && host.mask) {
    exec_.forEach(count_, ImportValues<int, std::uint32_t>{stageIn(host.mask, count_), index, mask_.data()});
    setRoles();
    exec_.forEach(count_, ImportValues<int, int>{stageIn(host.type, count_), index, type_.data()});
  }
  if ((fields & fieldImage) && host.image)
    exec_.forEach(count_, ImportValues<int, int>{stageIn(host.image, count_), index, image_.data()});
}

template <class Exec, class P>
void EngineImpl<Exec, P>::downloadFields(const HostParticles &host, unsigned fields)
{
  if (host.count != count_)
    throw Error(fmt::format("{} grains on the host, {} resident: fields cannot be copied back", host.count, count_));
  if (!count_) return;
  const std::uint32_t *index = hostIndex_.data();
  const Motion<Real> *motion = motion_[motNow_].data();
  Vec3<double> *out = stageOut<Vec3<double>>(count_);
  const auto deliver = [&](double *host) { exec_.copyOut(reinterpret_cast<Vec3<double> *>(host), out, count_); };
  if ((fields & fieldPosition) && host.position) {
    exec_.forEach(count_, ExportPositions<P>{positions(), cell_.data(), index, grid_, frame_, out});
    deliver(host.position);
  }
  if ((fields & fieldVelocity) && host.velocity) {
    exec_.forEach(count_, ExportMotion<Real>{motion, index, VectorField::Velocity, out});
    deliver(host.velocity);
  }
  if ((fields & fieldSpin) && host.spin) {
    exec_.forEach(count_, ExportMotion<Real>{motion, index, VectorField::Spin, out});
    deliver(host.spin);
  }
  if ((fields & fieldForce) && host.force) {
    exec_.forEach(count_, ExportValues<Vec3<Real>, Vec3<double>>{force_.data(), index, out});
    deliver(host.force);
  }
  if ((fields & fieldTorque) && host.torque) {
    exec_.forEach(count_, ExportValues<Vec3<Real>, Vec3<double>>{torque_.data(), index, out});
    deliver(host.torque);
  }
  if ((fields & fieldImage) && host.image) {
    int *flags = reinterpret_cast<int *>(out);
    exec_.forEach(count_, ExportValues<int, int>{image_.data(), index, flags});
    exec_.copyOut(host.image, flags, count_);
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::downloadHalfStepVelocities(const HostParticles &host)
{
  const int now = motNow_;
  motNow_ = 1 - motNow_;
  try {
    downloadFields(host, fieldVelocity | fieldSpin);
  } catch (...) {
    motNow_ = now;
    throw;
  }
  motNow_ = now;
}

template <class Exec, class P>
void EngineImpl<Exec, P>::downloadHistory(ContactHistory &history)
{
  const auto size = static_cast<std::size_t>(layout_.size);
  history.size = layout_.size;
  history.offset.assign(count_ + 1, 0);
  history.partner.clear();
  history.spring.clear();
  if (!count_ || !keepsContacts_) return;
  if (!storeFresh_) extractSprings();

  std::vector<std::uint32_t> offset(count_ + 1), host(count_);
  exec_.copyOut(offset.data(), storeOffset_.data(), offset.size());
  exec_.copyOut(host.data(), hostIndex_.data(), count_);
  const std::size_t contacts = offset[count_];
  std::vector<std::int32_t> partner(contacts);
  std::vector<Real> spring(size * contacts);
  exec_.copyOut(partner.data(), storePartner_.data(), contacts);
  exec_.copyOut(spring.data(), storeSpring_.data(), size * contacts);

  for (std::uint32_t i = 0; i < count_; ++i) history.offset[host[i] + 1] = offset[i + 1] - offset[i];
  for (std::uint32_t h = 0; h < count_; ++h) history.offset[h + 1] += history.offset[h];
  history.partner.resize(contacts);
  history.spring.resize(size * contacts);
  for (std::uint32_t i = 0; i < count_; ++i) {
    std::size_t to = history.offset[host[i]];
    for (std::size_t m = offset[i]; m < offset[i + 1]; ++m, ++to) {
      history.partner[to] = partner[m];
      for (std::size_t d = 0; d < size; ++d) history.spring[size * to + d] = static_cast<double>(spring[size * m + d]);
    }
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::uploadWallHistory(int wall, const double *spring)
{
  const int size = wallSize_[wall];
  if (!count_ || !size) return;
  const double *in = stageIn(spring, static_cast<std::size_t>(size) * count_);
  exec_.forEach(count_, ImportBlocks<Real>{size, in, hostIndex_.data(), wallHistory_[wall].data()});
  SurfaceWall &surface = surfaces_[static_cast<std::size_t>(wall)];
  surface.marked = false;  // with the slots that grains use
  if (isSurface(static_cast<std::size_t>(wall))) exec_.forEach(count_, FillOnes{surface.near.data()});
}

template <class Exec, class P>
void EngineImpl<Exec, P>::downloadWallHistory(int wall, double *spring)
{
  const int size = wallSize_[wall];
  if (!count_ || !size) return;
  double *out = stageOut<double>(static_cast<std::size_t>(size) * count_);
  exec_.forEach(count_, ExportBlocks<Real>{size, wallHistory_[wall].data(), hostIndex_.data(), out});
  exec_.copyOut(spring, out, static_cast<std::size_t>(size) * count_);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::downloadWallContacts(int wall, double *columns)
{
  if (!count_ || !wallContacts_[wall].capacity()) return;
  double *out = stageOut<double>(8 * static_cast<std::size_t>(count_));
  exec_.forEach(count_, ExportContacts<Real>{count_, wallContacts_[wall].data(), hostIndex_.data(), out});
  exec_.copyOut(columns, out, 8 * static_cast<std::size_t>(count_));
}

template <class Exec, class P>
void EngineImpl<Exec, P>::uploadOrigins(const double *position)
{
  if (!count_) return;
  origin_.reserve(count_);
  exec_.forEach(count_, ImportValues<Vec3<double>, Vec3<double>>{
                            stageIn(reinterpret_cast<const Vec3<double> *>(position), count_), hostIndex_.data(),
                            origin_.data()});
}

}  // namespace gpudem
