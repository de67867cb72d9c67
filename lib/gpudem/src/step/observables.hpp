// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Sums over grains for thermodynamic output, reduced in double and in a fixed order.
#pragma once

#include "step/step_view.hpp"

namespace gpudem {

template <int N>
struct Sums {
  double value[N];
};
struct AddSums {
  template <int N>
  GPUDEM_HD Sums<N> operator()(const Sums<N> &a, const Sums<N> &b) const
  {
    Sums<N> r;
    for (int k = 0; k < N; ++k) r.value[k] = a.value[k] + b.value[k];
    return r;
  }
};

/// m v_a v_b (xx yy zz xy xz yz), R^2 m omega^2, m g.x, 1.
template <class P>
struct KineticTerms {
  PositionArrays<P> position;
  const Motion<typename P::Real> *motion;
  const std::uint32_t *mask;  ///< group bits
  const std::uint32_t *cell;
  CellGrid grid;
  Frame frame;
  std::uint32_t groupMask;
  Vec3<double> gravity;
  GPUDEM_HD Sums<9> operator()(std::uint32_t i) const
  {
    Sums<9> r{};
    if (!(mask[i] & groupMask)) return r;
    const Motion<typename P::Real> m = motion[i];
    const double mass = m.mass, vx = m.vx, vy = m.vy, vz = m.vz, wx = m.wx, wy = m.wy, wz = m.wz;
    const FixedPosition p = loadPosition(position, i, m.word);
    r.value[0] = mass * vx * vx;
    r.value[1] = mass * vy * vy;
    r.value[2] = mass * vz * vz;
    r.value[3] = mass * vx * vy;
    r.value[4] = mass * vx * vz;
    r.value[5] = mass * vy * vz;
    r.value[6] = (wx * wx + wy * wy + wz * wz) * p.radius * p.radius * mass;
    if (gravity.x != 0.0 || gravity.y != 0.0 || gravity.z != 0.0)
      r.value[7] = mass * dot(gravity, absolutePosition(p, cell[i], grid, frame));
    r.value[8] = 1.0;
    return r;
  }
};

template <class Real>
struct VirialTerms {
  std::uint32_t count;
  const Real *virial;
  GPUDEM_HD Sums<6> operator()(std::uint32_t i) const
  {
    Sums<6> r;
    for (int k = 0; k < 6; ++k) r.value[k] = virial[static_cast<std::size_t>(k) * count + i];
    return r;
  }
};

template <class Real>
struct ForceTerms {
  const Vec3<Real> *force;
  GPUDEM_HD Sums<3> operator()(std::uint32_t i) const
  {
    return {{static_cast<double>(force[i].x), static_cast<double>(force[i].y), static_cast<double>(force[i].z)}};
  }
};

}  // namespace gpudem
