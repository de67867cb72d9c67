// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Conversion between the host's arrays (host order, double) and the resident state (device order).
#pragma once

#include "base/identity.hpp"
#include "neighbor/cell_grid.hpp"
#include "step/roles.hpp"
#include "step/step_view.hpp"

namespace gpudem {

enum class VectorField { Velocity, Spin };

/// Fixed-point positions and shapes from the host's coordinates, which must lie within the frame's box.
template <class P>
struct ImportPositions {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const Vec3<double> *x;  ///< host order
  const double *radius;   ///< host order, null: keep
  const std::uint32_t *hostIndex;
  CellGrid grid;
  Frame frame;
  PositionArrays<P> out;
  std::uint32_t *cell;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const std::uint32_t h = hostIndex[i];
    FixedPosition p;
    setCoordinates(p, x[h], frame);
    p.radius = radius ? radius[h] : loadPosition(out, i).radius;
    storePosition(out, i, p, out.motion[i].word);
    cell[i] = grid.cellOf(x[h]);
  }
};

template <class P>
struct ImportRadius {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const double *radius;
  const std::uint32_t *hostIndex;
  PositionArrays<P> out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    FixedPosition p = loadPosition(out, i);
    p.radius = radius[hostIndex[i]];
    storePosition(out, i, p, out.motion[i].word);
  }
};

template <class P>
struct ExportPositions {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  PositionArrays<P> in;
  const std::uint32_t *cell, *hostIndex;
  CellGrid grid;
  Frame frame;
  Vec3<double> *x;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    x[hostIndex[i]] = absolutePosition(loadPosition(in, i), cell[i], grid, frame);
  }
};

template <class Real>
struct ImportMotion {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const Vec3<double> *in;
  const std::uint32_t *hostIndex;
  VectorField field;
  Motion<Real> *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const Vec3<Real> v = in[hostIndex[i]].template as<Real>();
    Motion<Real> &m = out[i];
    if (field == VectorField::Velocity) {
      m.vx = v.x;
      m.vy = v.y;
      m.vz = v.z;
    } else {
      m.wx = v.x;
      m.wy = v.y;
      m.wz = v.z;
    }
  }
};

template <class Real>
struct ExportMotion {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const Motion<Real> *in;
  const std::uint32_t *hostIndex;
  VectorField field;
  Vec3<double> *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    const Motion<Real> &m = in[i];
    out[hostIndex[i]] = field == VectorField::Velocity ? Vec3<Real>{m.vx, m.vy, m.vz}.template as<double>()
                                                       : Vec3<Real>{m.wx, m.wy, m.wz}.template as<double>();
  }
};

template <class Real>
struct ImportMass {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const double *in;
  const std::uint32_t *hostIndex;
  Motion<Real> *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i].mass = static_cast<Real>(in[hostIndex[i]]); }
};

/// Roles of the grains from their group bits.
template <class Real>
struct SetRoles {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  Roles roles;
  std::uint32_t keep;         ///< bits of the word that hold a position
  const std::uint32_t *mask;  ///< group bits
  Motion<Real> *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    std::uint32_t word = out[i].word & keep;
    for (int r = 0; r < roles.count; ++r)
      if (mask[i] & roles.group[r]) word |= 1u << r;
    out[i].word = word;
  }
};

template <class From, class To>
struct Convert {
  GPUDEM_HD static To value(const From &a) { return static_cast<To>(a); }
};
template <class A, class B>
struct Convert<Vec3<A>, Vec3<B>> {
  GPUDEM_HD static Vec3<B> value(const Vec3<A> &a) { return a.template as<B>(); }
};

/// out[i] = in[host index of i], converted.
template <class From, class To>
struct ImportValues {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const From *in;
  const std::uint32_t *hostIndex;
  To *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[i] = Convert<From, To>::value(in[hostIndex[i]]); }
};

/// out[host index of i] = in[i], converted.
template <class From, class To>
struct ExportValues {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  const From *in;
  const std::uint32_t *hostIndex;
  To *out;
  GPUDEM_HD void operator()(std::uint32_t i) const { out[hostIndex[i]] = Convert<From, To>::value(in[i]); }
};

/// Blocks of \p size numbers per grain from host order.
template <class Real>
struct ImportBlocks {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  int size;
  const double *in;
  const std::uint32_t *hostIndex;
  Real *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    for (int d = 0; d < size; ++d)
      out[static_cast<std::size_t>(size) * i + d] =
          static_cast<Real>(in[static_cast<std::size_t>(size) * hostIndex[i] + d]);
  }
};
/// Blocks of \p size numbers per grain to host order.
template <class Real>
struct ExportBlocks {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  int size;
  const Real *in;
  const std::uint32_t *hostIndex;
  double *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    for (int d = 0; d < size; ++d)
      out[static_cast<std::size_t>(size) * hostIndex[i] + d] =
          static_cast<double>(in[static_cast<std::size_t>(size) * i + d]);
  }
};

/// Eight columns of device order to rows of host order.
template <class Real>
struct ExportContacts {
  static constexpr int blockSize = 256;
  static constexpr int minimumBlocks = 1;
  std::uint32_t count;
  const Real *in;
  const std::uint32_t *hostIndex;
  double *out;
  GPUDEM_HD void operator()(std::uint32_t i) const
  {
    for (int k = 0; k < 8; ++k)
      out[8 * static_cast<std::size_t>(hostIndex[i]) + k] = in[static_cast<std::size_t>(k) * count + i];
  }
};

}  // namespace gpudem
