// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The tangential spring of LIGGGHTS' model 'history', term by term:
///
///   liggghts_history          F_t = -kt a xi - eta_t v_t, kt = 8 G* if not given
///   liggghts_linear_history   F_t = -kt xi - eta_t v_t
///
/// xi grows by v_t dt and is then projected into the tangent plane, its length being that of the projection. The spring
/// alone is clipped to mu F_n0; while it is, there is no dashpot. eta_t = xgt eta_n; xgt NULL stands for 2 sqrt(G*/E*),
/// which with damping coeff_restitution makes eta_t = 2 sqrt(5/6) beta sqrt(8 G* a m*) = eta_n sqrt(S_t/S_n).
///
/// Spring: Mindlin, J. Appl. Mech. 16 (1949) 259; dashpot: Tsuji, Tanaka and Ishida, Powder Technol. 71 (1992) 239;
/// conventions: Kloss, Goniva, Hager, Amberger and Pirker, Prog. Comput. Fluid Dyn. 12 (2012) 140. LIGGGHTS also
/// shortens the arm of the slip velocity: ContactModel::slipLever.
#pragma once

#include "contact/tangential/spring.hpp"

namespace gpudem {

template <SpringScale scale>
struct LiggghtsTangential {
  static constexpr int history = 3;
  static std::vector<ParameterInfo> parameters()
  {
    const bool material = scale == SpringScale::Mindlin;
    ParameterInfo stiffness = notNegative("kt", material ? "force/distance^2" : "force/distance");
    ParameterInfo dashpot = notNegative("xgt", "-");
    stiffness.derivable = dashpot.derivable = material;
    return {stiffness, dashpot, frictionParameter()};
  }
  static std::vector<signed char> mirror() { return {-1, -1, -1}; }
  static double friction(const double *p) { return p[2]; }
  static double derived(std::size_t parameter, const ContactModuli &m)
  {
    return parameter == 0 ? 8.0 * m.shear : 2.0 * std::sqrt(m.shear / m.young);
  }
  static void derive(const double *p, const ModelContext &context, double *c)
  {
    if ((std::isnan(p[0]) || std::isnan(p[1])) && !context.moduli.known)
      throw Error("tangential NULL needs a normal sub-model that names a material (E, nu)");
    c[modulus] = std::isnan(p[0]) ? derived(0, context.moduli) : p[0];
    c[drag] = std::isnan(p[1]) ? derived(1, context.moduli) : p[1];
    c[coulomb] = p[2];
  }

  /// \param a     contact radius
  /// \param eta   coefficient of the normal dashpot
  /// \param base  normal force that the Coulomb limit counts from
  /// \param advance  false: the forces at the start of a run. The spring does not grow then, but whether it slides is
  ///                 decided as in a step: a spring kept at its limit must not let the dashpot act
  template <class Real>
  GPUDEM_HD static Vec3<Real> force(const ModelCoefficients<Real> &k, const ContactFrame<Real> &f, Real a, Real eta,
                                    Real base, Real *history, Real dt, bool advance)
  {
    const Vec3<Real> kept{history[0], history[1], history[2]}, moved = kept + f.slip * dt;
    const Vec3<Real> grown = moved - f.normal * dot(moved, f.normal);
    const TangentialStiffness<Real> t = stiffness(k, a, eta);
    const Real limit = k.tangential[coulomb] * base, length2 = dot(grown, grown);
    const bool slides = t.spring * t.spring * length2 > limit * limit;
    const Vec3<Real> sticks = advance ? grown : kept;
    const Vec3<Real> spring = slides ? grown * (divide(limit, t.spring) * inverseSquareRoot(length2)) : sticks;
    history[0] = spring.x;
    history[1] = spring.y;
    history[2] = spring.z;
    return spring * -t.spring - f.slip * (slides ? Real(0) : t.dashpot);
  }
  template <class Real>
  GPUDEM_HD static TangentialStiffness<Real> stiffness(const ModelCoefficients<Real> &k, Real a, Real eta)
  {
    return {scale == SpringScale::Mindlin ? k.tangential[modulus] * a : k.tangential[modulus],
            k.tangential[drag] * eta};
  }

 private:
  enum { modulus, drag, coulomb };
};

struct LiggghtsHistoryTangential : LiggghtsTangential<SpringScale::Mindlin> {
  static constexpr const char *name = "liggghts_history";
};
struct LiggghtsLinearHistoryTangential : LiggghtsTangential<SpringScale::Linear> {
  static constexpr const char *name = "liggghts_linear_history";
};

}  // namespace gpudem
