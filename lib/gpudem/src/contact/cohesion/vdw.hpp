// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Attraction of van der Waals between spheres at separation s,
///
///   F = -A R*/(6 s^2) for s0 < s < s_c,   -A R*/(6 s0^2) closer and in touch,   0 farther.
///
/// Hamaker, Physica 4 (1937) 1058, for s << R. s0, of the order of atoms, stands for the roughness that keeps surfaces
/// apart. It acts before touch: within s_c two grains are in contact although they never touched (beforeTouch), so
/// the rows and the coarse tests reach that far. The force is not shifted at s_c.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"
#include "gpudem/errors.h"

namespace gpudem {

struct VdwCohesion {
  static constexpr const char *name = "vdw";
  static constexpr bool beyondTouch = true, beforeTouch = true;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters()
  {
    return {notNegative("A", "energy"), positive("s0", "distance"), positive("s_c", "distance")};
  }
  static void derive(const double *p, double *c)
  {
    if (p[2] < p[1]) throw Error("cohesion vdw: the cut-off s_c must not be below the least separation s0");
    c[strength] = p[0] / 6.0;
    c[least] = p[1];
    c[cutoff] = p[2];
  }

  template <class Real>
  GPUDEM_HD static Real force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *)
  {
    const Real apart = -c.overlap, s = apart > k.cohesion[least] ? apart : k.cohesion[least];
    return -divide(divide(k.cohesion[strength] * c.effectiveRadius, s), s);  // s^2 may be below what a float holds
  }
  /// The cut-off (distance).
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &k, Real)
  {
    return k.cohesion[cutoff];
  }

 private:
  enum { strength, least, cutoff };
};

}  // namespace gpudem
