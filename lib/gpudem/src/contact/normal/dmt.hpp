// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Adhesion of stiff spheres: the force of Hertz less the pull-off force 4 pi gamma R*, gamma being half of the
/// work of adhesion.  Derjaguin, Muller and Toporov, J. Colloid Interface Sci. 53 (1975) 314.
#pragma once

#include "contact/normal/hertz.hpp"

namespace gpudem {

struct DmtNormal {
  static constexpr const char *name = "dmt";
  static constexpr bool linear = false, adhesive = true, beyondTouch = false;
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters()
  {
    return {youngParameter(), dampingParameter(), poissonParameter(), notNegative("gamma", "energy/distance^2")};
  }
  static ContactModuli moduli(const double *p) { return selfContact(p[0], p[2]); }
  static void derive(const double *p, double *c)
  {
    HertzMaterialNormal::derive(p, c);
    c[adhesion] = 4.0 * 3.14159265358979323846 * p[3];
  }

  template <class Real>
  GPUDEM_HD static NormalForce<Real> force(const ModelCoefficients<Real> &k, const Contact<Real> &c, Real *history)
  {
    NormalForce<Real> f = HertzNormal::force(k, c, history);
    f.pullOff = k.normal[adhesion] * c.effectiveRadius;
    f.elastic -= f.pullOff;
    f.adhesive = true;
    return f;
  }
  template <class Real>
  GPUDEM_HD static Real gap(const ModelCoefficients<Real> &, Real)
  {
    return Real(0);
  }

 private:
  enum { stiffness, adhesion };
};

}  // namespace gpudem
