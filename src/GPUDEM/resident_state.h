// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The resident particles seen from LAMMPS: who holds the valid copy of which field, and the copies.
#ifndef LMP_GPUDEM_RESIDENT_STATE_H
#define LMP_GPUDEM_RESIDENT_STATE_H

#include "fix_neigh_history_gpudem.h"
#include "gpudem/engine.h"
#include "mpi_rank_exchange.h"
#include "pointers.h"
#include "resident_plan.h"

#include <array>
#include <memory>

namespace LAMMPS_NS {

class ResidentState : protected Pointers {
 public:
  explicit ResidentState(class LAMMPS *lmp) : Pointers(lmp) {}

  /// Make or keep the engine that the settings ask for.
  void prepareEngine();
  gpudem::Engine &engine() { return *engine_; }
  /// Who shares the box, null on one rank.
  MpiRankExchange *ranks() { return ranks_.get(); }
  const MpiRankExchange *ranks() const { return ranks_.get(); }
  bool onGpu() const { return onGpu_; }

  /// Everything from the host: particles, springs, walls, origins. Rows are not built.
  /// \param source of the springs
  void uploadAll(const ResidentPlan &plan, FixNeighHistoryGpudem::Source source);
  /// Rows from the present positions, in the present box and sub-domain.
  void rebuild();
  /// To be called whenever sub-domains have changed. Collective.
  /// \return the width of the thinnest of any rank (distance), 0 on one rank
  double noteSubDomains();
  /// How far a grain may be outside its sub-domain before LAMMPS must hand it on (distance). A hand-over takes all
  /// particles through the host; a grain outside takes ghosts, as if the sub-domain were larger.
  double strayLimit(const ResidentPlan &plan) const;
  /// Everything to the host that is out of date there.
  void downloadAll(const ResidentPlan &plan);
  void downloadContacts(const ResidentPlan &plan);
  /// What grains keep of contacts with walls: asked for by restart files and by whoever takes grains over.
  void downloadWallSprings(const ResidentPlan &plan);
  /// The columns of the 'contacts' output.
  void downloadWallContacts(const ResidentPlan &plan);

  /// Bring \p fields up to date on the host.
  void toHost(unsigned fields);
  /// Send what the host changed to the device. \return true if rows must be rebuilt
  bool toDevice();
  /// The device advanced: its fields are newer than the host's.
  void deviceMoved(unsigned fields = gpudem::fieldDynamic);
  void contactsMoved() { contactsStale_ = true; }
  void hostChanged(unsigned fields) { deviceStale_ |= fields; }
  /// Run \p work on the host with every field valid; what it changed goes back with the next toDevice().
  template <class Work>
  void hostSection(const Work &work)
  {
    toHost(gpudem::fieldDynamic);
    const Fingerprints before = fingerprints();
    work();
    noteChanges(before);
  }

  gpudem::HostParticles host() const;
  gpudem::Box box() const;
  gpudem::Home home() const;

 private:
  using Fingerprints = std::array<std::uint64_t, 8>;
  Fingerprints fingerprints() const;
  /// Stop with the atom's ID if a radius is not above 0.
  void checkRadii();
  /// Stop with the atom's ID if a value about to be sent is not finite; the device would only name a victim.
  void checkFinite(unsigned fields) const;
  void noteChanges(const Fingerprints &before);

  std::unique_ptr<MpiRankExchange> ranks_;  ///< null on one rank; outlives the engine
  std::unique_ptr<gpudem::Engine> engine_;
  double thinnest_ = 0.0;  ///< width of the thinnest sub-domain (distance)
  int settingsVersion_ = -1;
  bool onGpu_ = false;
  unsigned hostStale_ = 0, deviceStale_ = 0;
  bool contactsStale_ = false;
};

}  // namespace LAMMPS_NS
#endif
