// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Tangential springs with memory. With xi the tangential displacement and eta_t = xgt eta:
///
///   linear_history        F_t = -kt xi - eta_t v_t
///   mindlin               F_t = -kt a xi - eta_t v_t, kt = 8 G* if not given
///   mindlin_rescale       the same; xi shrinks with the contact radius on unloading
///   mindlin/force, mindlin_rescale/force   the elastic force itself is kept and grows by -kt a v_t dt
///
/// clipped to mu F_n0, what is kept then being what carries the clipped force. What is kept is first turned into the
/// tangent plane at unchanged length.
///
/// Mindlin, J. Appl. Mech. 16 (1949) 259; Luding, Granul. Matter 10 (2008) 235 (turning); Thornton, Cummins and
/// Cleary, Powder Technol. 233 (2013) 30 (force form, unloading); conventions of LAMMPS' pair_style granular.
#pragma once

#include "contact/coefficients.hpp"
#include "contact/parameters.hpp"
#include "gpudem/errors.h"

namespace gpudem {

/// Turn \p v into the plane normal to \p n, keeping its length, unless its normal part is below \p threshold.
template <class Real>
GPUDEM_HD void turnIntoPlane(Vec3<Real> &v, const Vec3<Real> &n, Real threshold)
{
  const Real along = dot(v, n);
  const Vec3<Real> flat = v - n * along;
  const Real flat2 = dot(flat, flat);
  const Real factor = flat2 > Real(0) ? squareRoot(dot(v, v)) * inverseSquareRoot(flat2) : Real(0);
  const bool turn = absolute(along) > threshold;
  v = {turn ? flat.x * factor : v.x, turn ? flat.y * factor : v.y, turn ? flat.z * factor : v.z};
}

constexpr double turnThreshold = 1.0e-10;  ///< of the limit; LAMMPS' value

/// Spring and dashpot -k xi - eta v with the sum clipped to \p limit.
/// \param spring what is kept: displacement, or the elastic force if \p keepsForce
template <class Real>
GPUDEM_HD Vec3<Real> clippedSpring(Vec3<Real> &spring, const Vec3<Real> &n, const Vec3<Real> &rate, Real k, Real eta,
                                   Real limit, Real dt, bool advance, bool keepsForce)
{
  if (advance) {
    turnIntoPlane(spring, n,
                  keepsForce || !(k > Real(0)) ? Real(turnThreshold) * limit : divide(Real(turnThreshold) * limit, k));
    spring += rate * (keepsForce ? -k * dt : dt);
  }
  const Vec3<Real> dashpot = rate * eta;
  Vec3<Real> force = spring * (keepsForce ? Real(1) : -k) - dashpot;
  const Real magnitude2 = dot(force, force);
  if (magnitude2 > limit * limit) {
    if (dot(spring, spring) > Real(0)) {
      force = force * (limit * inverseSquareRoot(magnitude2));
      const Real perForce = keepsForce ? Real(1) : k > Real(0) ? -divide(Real(1), k) : Real(0);
      spring = (force + dashpot) * perForce;
    } else {
      force = {Real(0), Real(0), Real(0)};
    }
  }
  return force;
}

enum class SpringScale { Linear, Mindlin };
enum class OnUnloading { Keep, Rescale };
enum class SpringKeeps { Displacement, Force };

template <SpringScale scale, OnUnloading unloading, SpringKeeps keeps>
struct SpringTangential {
  static constexpr bool rescales = unloading == OnUnloading::Rescale;
  static constexpr int history = rescales ? 4 : 3;
  static std::vector<ParameterInfo> parameters()
  {
    ParameterInfo stiffness = notNegative("kt", scale == SpringScale::Linear ? "force/distance" : "force/distance^2");
    stiffness.derivable = scale == SpringScale::Mindlin;
    return {stiffness, notNegative("xgt", "-"), frictionParameter()};
  }
  static std::vector<signed char> mirror()
  {
    std::vector<signed char> m{-1, -1, -1};
    if (rescales) m.push_back(1);
    return m;
  }
  static double friction(const double *p) { return p[2]; }
  /// What NULL stands for in place of a parameter.
  static double derived(std::size_t, const ContactModuli &m) { return 8.0 * m.shear; }
  static void derive(const double *p, const ModelContext &context, double *c)
  {
    if (std::isnan(p[0]) && !context.moduli.known)
      throw Error("tangential stiffness NULL needs a normal sub-model that names a material (E, nu)");
    c[modulus] = std::isnan(p[0]) ? derived(0, context.moduli) : p[0];
    c[drag] = p[1];
    c[coulomb] = p[2];
  }

  /// \param a     contact radius
  /// \param eta   coefficient of the normal dashpot
  /// \param base  normal force that the Coulomb limit counts from
  template <class Real>
  GPUDEM_HD static Vec3<Real> force(const ModelCoefficients<Real> &k, const ContactFrame<Real> &f, Real a, Real eta,
                                    Real base, Real *history, Real dt, bool advance)
  {
    Vec3<Real> spring{history[0], history[1], history[2]};
    if (rescales) {
      const Real before = history[3];
      const Real factor = a < before ? divide(a, before) : Real(1);
      spring = spring * factor;
      if (advance) history[3] = a;
    }
    const TangentialStiffness<Real> t = stiffness(k, a, eta);
    const Vec3<Real> out = clippedSpring(spring, f.normal, f.slip, t.spring, t.dashpot, k.tangential[coulomb] * base,
                                         dt, advance, keeps == SpringKeeps::Force);
    history[0] = spring.x;
    history[1] = spring.y;
    history[2] = spring.z;
    return out;
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

struct LinearHistoryTangential : SpringTangential<SpringScale::Linear, OnUnloading::Keep, SpringKeeps::Displacement> {
  static constexpr const char *name = "linear_history";
};
struct MindlinTangential : SpringTangential<SpringScale::Mindlin, OnUnloading::Keep, SpringKeeps::Displacement> {
  static constexpr const char *name = "mindlin";
};
struct MindlinRescaleTangential
    : SpringTangential<SpringScale::Mindlin, OnUnloading::Rescale, SpringKeeps::Displacement> {
  static constexpr const char *name = "mindlin_rescale";
};
struct MindlinForceTangential : SpringTangential<SpringScale::Mindlin, OnUnloading::Keep, SpringKeeps::Force> {
  static constexpr const char *name = "mindlin/force";
};
struct MindlinRescaleForceTangential
    : SpringTangential<SpringScale::Mindlin, OnUnloading::Rescale, SpringKeeps::Force> {
  static constexpr const char *name = "mindlin_rescale/force";
};

}  // namespace gpudem
