// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file What a style must offer to take part in the resident loop.
#ifndef LMP_GPUDEM_RESIDENT_H
#define LMP_GPUDEM_RESIDENT_H

#include "gpudem/scene.h"

#include "fix.h"
#include "utils.h"

#include <string>

namespace LAMMPS_NS {

/// Answer of a style that was asked whether the device can do its work.
struct ResidentVerdict {
  bool possible = true;
  std::string reason;  ///< why not, for the log
  static ResidentVerdict no(const std::string &why) { return {false, why}; }
};

/// A fix whose per-step work the device can do. While onDevice is set its stock methods do nothing.
class ResidentFix {
 public:
  virtual ~ResidentFix() = default;
  bool onDevice = false;

  virtual ResidentVerdict resident() = 0;
  /// Append walls, force terms and integrators. Called only if resident() said yes.
  virtual void describe(gpudem::SceneSpec &scene) = 0;
  /// Entry of the scene's term list that belongs to this fix, or -1.
  int term = -1;
  /// Does the term's value change from step to step?
  virtual bool varies() const { return false; }
  /// Value of a varying term at update->ntimestep.
  virtual gpudem::Array3 value() { return {}; }
  /// Total force that stood on the group before the term acted, at an event.
  virtual void setForceBefore(const gpudem::Array3 &) {}
  bool actsOnForce() const { return forceTerm; }

 protected:
  bool forceTerm = false;  ///< the fix acts at post_force
};

/// A pair style the device can evaluate.
class ResidentPair {
 public:
  virtual ~ResidentPair() = default;
  /// Set the contact laws of the scene.
  virtual void describeLaws(gpudem::SceneSpec &scene) const = 0;
  /// Why the device cannot evaluate this style as it is set, empty if it can.
  virtual std::string obstacle() const { return ""; }
  virtual unsigned frozenMask() const = 0;
  /// Largest radius present or announced by an insertion fix (distance).
  virtual double largestRadius() const = 0;
  /// Global virial of the last event, into LAMMPS' accumulators.
  virtual void setVirial(const std::array<double, 6> &virial) = 0;
};

/// A compute that reads the device instead of the host's arrays.
class ResidentCompute {
 public:
  virtual ~ResidentCompute() = default;
};

/// Give a fix that was created through the suffix its stock style name back, so that restart files
/// match in both directions and other styles find it by name.
inline void keepStockName(Fix *fix, const char *scriptWord)
{
  if (utils::strmatch(scriptWord, "/gpudem$")) return;
  delete[] fix->style;
  fix->style = utils::strdup(scriptWord);
}

}  // namespace LAMMPS_NS
#endif
