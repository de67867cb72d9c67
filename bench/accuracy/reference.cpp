// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Spheres in extended precision: the reference of bench/accuracy.
///
/// accuracy-reference STEPS DT < scene > state. All numbers are long double (64-bit mantissa on x86). The law is pair granular with
/// hertz/material, damping coeff_restitution, tangential mindlin (xgt, mu), written out here without a line of the library; the floor is
/// a plane z = 0 of the same material, as fix wall/gran granular has it. Velocity Verlet; pairs are found by going over all of them.
///
/// Scene: E nu e xgt mu gravity floor(0/1) Lx Ly Lz (0: not periodic) count, then per sphere x y z vx vy vz wx wy wz radius mass.
/// State: x (unwrapped) v w of each sphere, a line each.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <vector>

namespace {

using Real = long double;
struct Vector {
  Real x = 0, y = 0, z = 0;
};
Vector operator+(const Vector &a, const Vector &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector &a, const Vector &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(const Vector &a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
Real dot(const Vector &a, const Vector &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector &a, const Vector &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Law {
  Real young, poisson, restitution, xgt, friction;
};
struct Sphere {
  Vector x, v, w, force, torque;
  Real radius, mass;
};
struct Touch {  ///< what one contact gives the first sphere
  Vector force, couple;
};

/// Force of a contact; \p spring is turned into the tangent plane, advanced by \p dt and shortened where it slides.
Touch contact(const Law &law, const Vector &n, Real overlap, Real radius, Real mass, const Vector &velocity,
              const Vector &surfaceSpin, Vector &spring, Real dt)
{
  const Real effective = law.young / (2 * (1 - law.poisson * law.poisson));
  const Real shear = law.young / (4 * (1 + law.poisson) * (2 - law.poisson));
  const Real logarithm = std::log(law.restitution), pi = std::acos(Real(-1));
  const Real beta = -logarithm / std::sqrt(pi * pi + logarithm * logarithm);
  const Real a = std::sqrt(radius * overlap);
  const Real elastic = Real(4) / 3 * effective * a * overlap;
  const Real damping = std::sqrt(Real(5)) * beta * std::sqrt(mass * Real(4) / 3 * effective * a);
  const Real normalRate = dot(velocity, n);
  const Real push = elastic - damping * normalRate;
  const Vector slip = velocity - n * normalRate - cross(surfaceSpin, n);

  const Real length = std::sqrt(dot(spring, spring));
  spring = spring - n * dot(spring, n);
  const Real turned = std::sqrt(dot(spring, spring));
  if (turned > 0) spring = spring * (length / turned);
  spring = spring + slip * dt;
  const Real kt = 8 * shear * a, dashpot = law.xgt * damping;
  Vector friction = (spring * kt + slip * dashpot) * Real(-1);
  const Real size = std::sqrt(dot(friction, friction)), limit = law.friction * std::abs(push);
  if (size > limit) {
    friction = friction * (limit / size);
    spring = (friction + slip * dashpot) * (-1 / kt);
  }
  return {n * push + friction, cross(n, friction)};
}

class System {
 public:
  explicit System(std::istream &in)
  {
    std::size_t count = 0;
    in >> law_.young >> law_.poisson >> law_.restitution >> law_.xgt >> law_.friction >> gravity_ >> floor_ >> box_.x >>
        box_.y >> box_.z >> count;
    spheres_.resize(count);
    for (Sphere &s : spheres_)
      in >> s.x.x >> s.x.y >> s.x.z >> s.v.x >> s.v.y >> s.v.z >> s.w.x >> s.w.y >> s.w.z >> s.radius >> s.mass;
    if (!in) {
      std::cerr << "accuracy-reference: the scene is incomplete\n";
      std::exit(1);
    }
    wallSpring_.resize(count);
    findNear();
  }

  void run(long steps, Real dt)
  {
    forces(0);
    for (long k = 0; k < steps; ++k) {
      for (Sphere &s : spheres_) {
        kick(s, dt / 2);
        s.x = s.x + s.v * dt;
      }
      forces(dt);
      for (Sphere &s : spheres_) kick(s, dt / 2);
    }
  }

  void write(std::ostream &out) const
  {
    out << std::setprecision(21);
    for (const Sphere &s : spheres_)
      out << s.x.x << ' ' << s.x.y << ' ' << s.x.z << ' ' << s.v.x << ' ' << s.v.y << ' ' << s.v.z << ' ' << s.w.x << ' '
          << s.w.y << ' ' << s.w.z << '\n';
  }

 private:
  static void kick(Sphere &s, Real t)
  {
    s.v = s.v + s.force * (t / s.mass);
    s.w = s.w + s.torque * (t / (Real(2) / 5 * s.mass * s.radius * s.radius));
  }
  static Real nearest(Real d, Real length) { return length > 0 ? d - length * std::nearbyint(d / length) : d; }
  Vector branch(std::size_t i, std::size_t j) const
  {
    const Vector d = spheres_[i].x - spheres_[j].x;
    return {nearest(d.x, box_.x), nearest(d.y, box_.y), nearest(d.z, box_.z)};
  }

  /// Every pair that may touch before a sphere has moved by half of the margin.
  void findNear()
  {
    near_.clear();
    at_.clear();
    Real largest = 0;
    for (const Sphere &s : spheres_) {
      largest = std::max(largest, s.radius);
      at_.push_back(s.x);
    }
    margin_ = largest / 5;
    for (std::size_t i = 0; i < spheres_.size(); ++i)
      for (std::size_t j = i + 1; j < spheres_.size(); ++j) {
        const Vector d = branch(i, j);
        const Real reach = spheres_[i].radius + spheres_[j].radius + margin_;
        if (dot(d, d) < reach * reach) near_.emplace_back(i, j);
      }
  }

  void forces(Real dt)
  {
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const Vector moved = spheres_[i].x - at_[i];
      if (4 * dot(moved, moved) > margin_ * margin_) {
        findNear();
        break;
      }
    }
    for (Sphere &s : spheres_) {
      s.force = {0, 0, -s.mass * gravity_};
      s.torque = {};
    }
    for (const auto &[i, j] : near_) pair(i, j, dt);
    if (floor_)
      for (std::size_t i = 0; i < spheres_.size(); ++i) wall(i, dt);
  }

  void pair(std::size_t i, std::size_t j, Real dt)
  {
    Sphere &a = spheres_[i], &b = spheres_[j];
    const Vector d = branch(i, j);
    const Real distance = std::sqrt(dot(d, d)), overlap = a.radius + b.radius - distance;
    if (overlap <= 0) {
      spring_.erase({i, j});
      return;
    }
    const Touch t = contact(law_, d * (1 / distance), overlap, a.radius * b.radius / (a.radius + b.radius),
                            a.mass * b.mass / (a.mass + b.mass), a.v - b.v, a.w * a.radius + b.w * b.radius,
                            spring_[{i, j}], dt);
    a.force = a.force + t.force;
    b.force = b.force - t.force;
    a.torque = a.torque - t.couple * (a.radius - overlap / 2);
    b.torque = b.torque - t.couple * (b.radius - overlap / 2);
  }

  void wall(std::size_t i, Real dt)
  {
    Sphere &s = spheres_[i];
    const Real overlap = s.radius - s.x.z;
    if (overlap <= 0) {
      wallSpring_[i] = {};
      return;
    }
    const Touch t = contact(law_, {0, 0, 1}, overlap, s.radius, s.mass, s.v, s.w * s.radius, wallSpring_[i], dt);
    s.force = s.force + t.force;
    s.torque = s.torque - t.couple * s.radius;
  }

  Law law_{};
  Real gravity_ = 0, margin_ = 0;
  int floor_ = 0;
  Vector box_;  ///< lengths, 0 where not periodic
  std::vector<Sphere> spheres_;
  std::vector<Vector> wallSpring_, at_;  ///< at_: positions at the last search
  std::vector<std::pair<std::size_t, std::size_t>> near_;
  std::map<std::pair<std::size_t, std::size_t>, Vector> spring_;
};

}  // namespace

int main(int count, char **words)
{
  if (count != 3) {
    std::cerr << "usage: accuracy-reference STEPS DT < scene > state\n";
    return 1;
  }
  System system(std::cin);
  system.run(std::strtol(words[1], nullptr, 10), std::strtold(words[2], nullptr));
  system.write(std::cout);
  return 0;
}
