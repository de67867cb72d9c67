// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Three-vector of the physics code.
#pragma once

#include "base/annotate.hpp"

namespace gpudem {

template <class Real>
struct Vec3 {
  Real x, y, z;

  template <class To>
  GPUDEM_HD Vec3<To> as() const
  {
    return {static_cast<To>(x), static_cast<To>(y), static_cast<To>(z)};
  }
  GPUDEM_HD Real &operator[](int d) { return d == 0 ? x : d == 1 ? y : z; }
  GPUDEM_HD const Real &operator[](int d) const { return d == 0 ? x : d == 1 ? y : z; }
};

template <class Real>
GPUDEM_HD Vec3<Real> operator+(const Vec3<Real> &a, const Vec3<Real> &b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
GPUDEM_HD Vec3<Real> operator-(const Vec3<Real> &a, const Vec3<Real> &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
GPUDEM_HD Vec3<Real> operator*(const Vec3<Real> &a, Real s)
{
  return {a.x * s, a.y * s, a.z * s};
}
template <class Real>
GPUDEM_HD void operator+=(Vec3<Real> &a, const Vec3<Real> &b)
{
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
}
template <class Real>
GPUDEM_HD void operator-=(Vec3<Real> &a, const Vec3<Real> &b)
{
  a.x -= b.x;
  a.y -= b.y;
  a.z -= b.z;
}
template <class Real>
GPUDEM_HD Real dot(const Vec3<Real> &a, const Vec3<Real> &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
GPUDEM_HD Vec3<Real> cross(const Vec3<Real> &a, const Vec3<Real> &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace gpudem
