// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Dashpots of the normal force, F = -eta v_n, that differ in what the coefficient eta is proportional to.
/// Names and definitions of LAMMPS' pair_style granular.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"

namespace gpudem {

/// eta as given.
struct VelocityDamping {
  static constexpr const char *name = "velocity";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("eta", "force time/distance")}; }
  static double derive(double eta, const ModelContext &) { return eta; }
  template <class Real>
  GPUDEM_HD static Real coefficient(const ModelCoefficients<Real> &k, Real, const NormalForce<Real> &)
  {
    return k.damping;
  }
};

/// eta m*.
struct MassVelocityDamping {
  static constexpr const char *name = "mass_velocity";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("eta", "1/time")}; }
  static double derive(double eta, const ModelContext &) { return eta; }
  template <class Real>
  GPUDEM_HD static Real coefficient(const ModelCoefficients<Real> &k, Real mass, const NormalForce<Real> &)
  {
    return k.damping * mass;
  }
};

/// eta a m*.  Brilliantov, Spahn, Hertzsch and Poeschel, Phys. Rev. E 53 (1996) 5382.
struct ViscoelasticDamping {
  static constexpr const char *name = "viscoelastic";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {notNegative("eta", "1/(time distance)")}; }
  static double derive(double eta, const ModelContext &) { return eta; }
  template <class Real>
  GPUDEM_HD static Real coefficient(const ModelCoefficients<Real> &k, Real mass, const NormalForce<Real> &f)
  {
    return k.damping * (f.contactRadius * mass);
  }
};

/// The coefficient of restitution is given: alpha sqrt(m* k_nd) with alpha = 2 beta (linear) or sqrt(5) beta (Hertz),
/// beta = -ln e/sqrt(pi^2 + ln^2 e).  Tsuji, Tanaka and Ishida, Powder Technol. 71 (1992) 239, chose the form;
/// sqrt(5) beta is exact for Hertz: Antypov and Elliott, Europhys. Lett. 94 (2011) 50004.
struct RestitutionDamping {
  static constexpr const char *name = "coeff_restitution";
  static constexpr int history = 0;
  static std::vector<ParameterInfo> parameters() { return {{"e", "-", aboveZero, 1.0, false}}; }
  static double derive(double e, const ModelContext &context)
  {
    const double logarithm = std::log(e);
    const double beta = -logarithm / std::sqrt(9.86960440108935799 + logarithm * logarithm);
    return (context.linear ? 2.0 : std::sqrt(5.0)) * beta;
  }
  template <class Real>
  GPUDEM_HD static Real coefficient(const ModelCoefficients<Real> &k, Real mass, const NormalForce<Real> &f)
  {
    return k.damping * squareRoot(mass * f.stiffness);
  }
};

/// The name LAMMPS gave to damping by restitution; returns the restitution that was asked for.
struct TsujiDamping : RestitutionDamping {
  static constexpr const char *name = "tsuji";
};

/// LAMMPS' fit of alpha, which returns another restitution than was asked for (0.616 for 0.5).
struct TsujiFitDamping : RestitutionDamping {
  static constexpr const char *name = "tsuji/lammps";
  static double derive(double e, const ModelContext &)
  {
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  }
};

}  // namespace gpudem
