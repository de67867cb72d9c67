// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#ifndef LMP_VERLET_GPUDEM_H
#define LMP_VERLET_GPUDEM_H

#include "resident_plan.h"
#include "resident_state.h"
#include "timer.h"
#include "verlet.h"

#include <map>
#include <memory>
#include <string>

namespace LAMMPS_NS {

/// run_style verlet/gpudem: particles stay on the device between events.
///
/// An event is a step at which something outside the device must act: output, a fix that inserts or deletes,
/// a fix or compute without a device version. Between two events the device advances on its own. Whatever
/// cannot be resident still runs, at its LAMMPS call point, with the fields it may read brought up to date.
class VerletGpudem : public Verlet {
 public:
  VerletGpudem(class LAMMPS *lmp, int narg, char **arg);
  ~VerletGpudem() override;

  void init() override;
  void setup(int flag) override;
  void setup_minimal(int flag) override;
  void run(int n) override;
  void cleanup() override;

  /// The resident loop of \p lmp if the device holds the particles now, else null.
  static VerletGpudem *active(class LAMMPS *lmp);
  /// Sums over a group at the current step, from the device; evaluated once per step and group.
  const gpudem::KineticSums &kineticSums(unsigned groupMask, const gpudem::Array3 &gravity = {});
  /// Bring the contact springs to the per-atom lists of the history fix.
  void downloadContacts() { state.downloadContacts(plan); }

 private:
  void enterResident();
  void leaveResident();
  void printPlan();
  void printLevels();
  void printSurfaces();
  std::string describeRanks() const;
  void printGhosts();
  void printMemory();

  void setupResident(int flag);
  void runResident(int n);
  bigint nextEvent(bigint last) const;
  void advanceTo(bigint event);
  void stamp(Timer::ttype what);
  void eventStep(bigint step);
  void completeOnDevice(const gpudem::StepInputs &in, const gpudem::Recording &record);
  void completeWithHost(const gpudem::StepInputs &in, const gpudem::Recording &record);
  void publish(const gpudem::Recording &record);
  bool endOfStepDue(bigint step) const;
  void endOfStep(bigint step);
  void writeOutput(bigint step);

  bool reneighborAsked(bigint step) const;
  void rebuildRows();
  void rebuildThroughHost();
  void shrinkWrap(const gpudem::Extent &extent);
  bool mustHandOn(const gpudem::Extent &extent) const;
  void handOnFarGrains();
  bool readsLists(bigint step) const;
  void fail(const gpudem::Error &e) const;
  void renewGhosts();
  void buildHostLists();
  void evaluatePairOnHost();
  gpudem::StepInputs inputs(bigint step);
  gpudem::KineticSums sumOverRanks(gpudem::KineticSums own) const;

  ResidentPlan plan;
  ResidentState state;
  bool onDevice = false;        ///< the device holds the particles
  bool rowsDue = false;         ///< rows must be rebuilt before the next force
  bool hostListsBuilt = false;  ///< this run built neighbour lists on the host
  std::unique_ptr<class Irregular> irregular;  ///< of grains that skip ranks
  int handOvers = 0;                           ///< rebuilds of this run at which LAMMPS handed grains on
  bigint lastRebuild = 0;
  int rebuildInterval = 16;  ///< steps between the last two rebuilds
  std::string printedLevels; ///< the line on neighbour levels printed last
  std::string printed;       ///< the block printed last
  std::string printedMemory; ///< the line on memory printed last
  bigint sumsStep = -1;
  std::map<std::pair<unsigned, gpudem::Array3>, gpudem::KineticSums> sums;
};

}  // namespace LAMMPS_NS
#endif
