// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "gpudem/body_motion.h"

#include "wall/body_pose.hpp"

namespace gpudem {

namespace {

using A3 = std::array<double, 3>;

Vec3<double> vec(const A3 &a)
{
  return {a[0], a[1], a[2]};
}
A3 array(const Vec3<double> &v)
{
  return {v.x, v.y, v.z};
}

/// Column \p k of the rotation in \p pose.
Vec3<double> column(const BodyPose &pose, int k)
{
  return {pose.row[0][k], pose.row[1][k], pose.row[2][k]};
}

void setColumn(BodyMotion &m, int k, const Vec3<double> &v)
{
  for (int d = 0; d < 3; ++d) m.rotation[static_cast<std::size_t>(3 * d + k)] = v[d];
}

Vec3<double> unitVector(int k)
{
  Vec3<double> v{0.0, 0.0, 0.0};
  v[k] = 1.0;
  return v;
}

/// v turned about the unit vector n (Rodrigues).
Vec3<double> turnedVector(const Vec3<double> &v, const Vec3<double> &n, double angle)
{
  // 1 - cos without cancellation
  const double s = std::sin(angle), h = std::sin(0.5 * angle);
  const Vec3<double> t = cross(n, v);
  return v + t * s + cross(n, t) * (2.0 * h * h);
}

/// Let the body turn about \p point, with the rotation and the angular velocity that it has.
void fixPoint(BodyMotion &m, const A3 &point)
{
  const BodyPose pose = bodyPose(m);
  const Vec3<double> p = vec(point);
  m.displacement = array(p - pose.turned(p));
  m.velocity = array(cross(pose.spin, vec(m.displacement) - p));
}

}  // namespace

BodyMotion displaced(const A3 &displacement, const A3 &velocity)
{
  BodyMotion m;
  m.displacement = displacement;
  m.velocity = velocity;
  return m;
}

BodyMotion turned(const A3 &point, const A3 &axis, double angle, double rate)
{
  BodyMotion m;
  for (int k = 0; k < 3; ++k) setColumn(m, k, turnedVector(unitVector(k), vec(axis), angle));
  m.angularVelocity = array(vec(axis) * rate);
  fixPoint(m, point);
  return m;
}

BodyMotion nutating(const A3 &point, const A3 &axis, double tilt, double angle, double rate)
{
  const Vec3<double> a = vec(axis);
  Vec3<double> across = cross(a, unitVector(std::abs(a.x) < 0.5 ? 0 : 1));
  across = across * (1.0 / std::sqrt(dot(across, across)));
  BodyMotion m;
  for (int k = 0; k < 3; ++k)
    setColumn(m, k, turnedVector(turnedVector(turnedVector(unitVector(k), a, -angle), across, tilt), a, angle));
  // the axis a turns the body one way, the body's own axis turns it back
  m.angularVelocity = array((a - bodyPose(m).turned(a)) * rate);
  fixPoint(m, point);
  return m;
}

BodyMotion composed(const BodyMotion &second, const BodyMotion &first)
{
  const BodyPose s = bodyPose(second), f = bodyPose(first);
  BodyMotion m;
  for (int k = 0; k < 3; ++k) setColumn(m, k, s.turned(column(f, k)));
  m.displacement = placeOf(second, first.displacement);
  m.velocity = array(vec(velocityOf(second, first.displacement)) + s.turned(f.velocity));
  m.angularVelocity = array(s.spin + s.turned(f.spin));
  return m;
}

A3 placeOf(const BodyMotion &motion, const A3 &x)
{
  const BodyPose p = bodyPose(motion);
  return array(p.turned(vec(x)) + p.displacement);
}

A3 velocityOf(const BodyMotion &motion, const A3 &x)
{
  return array(bodyPose(motion).velocityAt(vec(placeOf(motion, x))));
}

}  // namespace gpudem
