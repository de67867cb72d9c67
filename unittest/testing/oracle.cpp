// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "testing/oracle.h"

#include <cmath>

namespace gpudem::testing {

void Grains::add(const Array3 &position, const Array3 &velocity, const Array3 &spin, double r, double m, int bits,
                 int kind)
{
  for (int d = 0; d < 3; ++d) {
    x.push_back(position[d]);
    v.push_back(velocity[d]);
    w.push_back(spin[d]);
    f.push_back(0.0);
    t.push_back(0.0);
  }
  radius.push_back(r);
  mass.push_back(m);
  mask.push_back(bits);
  type.push_back(kind);
  tag.push_back(static_cast<int>(radius.size()));
  image.push_back(512 | 512 << 10 | 512 << 20);
}

HostParticles Grains::view()
{
  HostParticles h;
  h.count = size();
  h.position = x.data();
  h.velocity = v.data();
  h.spin = w.data();
  h.force = f.data();
  h.torque = t.data();
  h.radius = radius.data();
  h.mass = mass.data();
  h.mask = mask.data();
  h.type = type.data();
  h.tag = tag.data();
  h.image = image.data();
  return h;
}

Grains randomCloud(std::size_t count, const Box &box, double smallest, double largest, unsigned seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  Grains g;
  int failures = 0;
  while (g.size() < count && failures < 2000000) {
    const double r = uniform(smallest, largest);
    Array3 x{}, v{}, w{};
    for (int d = 0; d < 3; ++d) {
      const double margin = box.periodic[d] || (d == 2 && box.dimension == 2) ? 0.0 : 0.9 * r;
      x[d] = d == 2 && box.dimension == 2 ? 0.0 : uniform(box.lo[d] + margin, box.hi[d] - margin);
      v[d] = d == 2 && box.dimension == 2 ? 0.0 : uniform(-1.0, 1.0);
      w[d] = box.dimension == 2 && d < 2 ? 0.0 : uniform(-2.0, 2.0);
    }
    bool free = true;
    for (std::size_t j = 0; j < g.size() && free; ++j) {
      double d2 = 0.0;
      for (int d = 0; d < 3; ++d) {
        double s = x[d] - g.x[3 * j + d];
        const double length = box.hi[d] - box.lo[d];
        if (box.periodic[d] && !(d == 2 && box.dimension == 2)) s -= length * std::nearbyint(s / length);
        d2 += s * s;
      }
      free = d2 > 0.96 * 0.96 * (r + g.radius[j]) * (r + g.radius[j]);
    }
    if (!free) {
      ++failures;
      continue;
    }
    const int kind = 1 + static_cast<int>(g.size() % 2);
    g.add(x, v, w, r, 4.0 / 3.0 * std::acos(-1.0) * r * r * r * uniform(0.8, 1.2), 1 | (kind == 2 ? 2 : 0), kind);
  }
  return g;
}

Oracle::Oracle(const SceneSpec &scene, const Box &box, Grains g) : grains(std::move(g)), scene_(scene), box_(box)
{
  layout_ = pairLayout(scene);
  for (const WallSpec &wall : scene.walls) {
    wallKept_.emplace_back(grains.size() * static_cast<std::size_t>(wallHistorySize(wall)), 0.0);
    wallModel_.push_back(wall.model ? coefficients<double>(*wall.model) : ModelCoefficients<double>{});
  }
}

void Oracle::pairForce(std::size_t i, std::size_t j, bool advance)
{
  Grains &g = grains;
  Vec3<double> branch{};
  for (int d = 0; d < 3; ++d) {
    double s = g.x[3 * i + d] - g.x[3 * j + d];
    const double length = box_.hi[d] - box_.lo[d];
    if (box_.periodic[d] && !(d == 2 && box_.dimension == 2)) s -= length * std::nearbyint(s / length);
    branch[d] = s;
  }
  const double reach = g.radius[i] + g.radius[j];
  const std::pair<int, int> key(g.tag[i], g.tag[j]);
  const double r2 = dot(branch, branch);
  const bool held = kept.count(key) > 0;
  const ContactModel *model = nullptr;
  if (!scene_.pairModels.empty())
    model = &scene_.pairModels[static_cast<std::size_t>((g.type[i] - 1) * scene_.types + g.type[j] - 1)];
  double limit = reach;
  if (model && (held || actsBeforeTouch(*model))) limit += pullOffGap(*model, g.radius[i] * g.radius[j] / reach);
  if (r2 >= limit * limit) {
    kept.erase(key);
    return;
  }
  for (const auto &[a, b] : scene_.exclusions.groups)
    if ((g.mask[i] & a && g.mask[j] & b) || (g.mask[i] & b && g.mask[j] & a)) return;
  for (const auto &[a, b] : scene_.exclusions.types)
    if ((g.type[i] == a && g.type[j] == b) || (g.type[i] == b && g.type[j] == a)) return;
  ++contacts;
  Contact<double> c{};
  c.branch = branch;
  c.distance = std::sqrt(r2);
  c.inverseDistance = 1.0 / c.distance;
  c.overlap = reach - c.distance;
  c.effectiveRadius = g.radius[i] * g.radius[j] / reach;
  c.effectiveMass = g.mass[i] * g.mass[j] / (g.mass[i] + g.mass[j]);
  if (g.mask[i] & scene_.frozenMask) c.effectiveMass = g.mass[j];
  if (g.mask[j] & scene_.frozenMask) c.effectiveMass = g.mass[i];
  for (int d = 0; d < 3; ++d) {
    c.relativeVelocity[d] = g.v[3 * i + d] - g.v[3 * j + d];
    c.surfaceSpin[d] = g.radius[i] * g.w[3 * i + d] + g.radius[j] * g.w[3 * j + d];
  }
  std::vector<double> nothing;  // a law that keeps nothing leaves no trace
  std::vector<double> &numbers = keepsContacts(scene_) ? kept[key] : nothing;
  numbers.resize(static_cast<std::size_t>(layout_.size), 0.0);
  if (model) return addModelForce(i, j, *model, c, numbers.data(), advance);
  Vec3<double> spring{0, 0, 0};
  if (layout_.size) spring = {numbers[0], numbers[1], numbers[2]};
  const LawCoefficients<double> k = coefficients<double>(scene_.pair);
  ContactForce<double> f;
  if (scene_.pair.tangential == TangentialModel::None)
    f = springDashpot<NormalModel::Hooke, TangentialModel::None>(k, c, spring, scene_.timestep, advance);
  else f = springDashpot(scene_.pair.normal, scene_.pair.tangential, k, c, spring, scene_.timestep, advance);
  if (layout_.size) numbers = {spring.x, spring.y, spring.z};
  for (int d = 0; d < 3; ++d) {
    g.t[3 * i + d] -= g.radius[i] * f.couple[d];
    g.t[3 * j + d] -= g.radius[j] * f.couple[d];
  }
  addForce(i, j, branch, f.force);
}

void Oracle::addForce(std::size_t i, std::size_t j, const Vec3<double> &branch, const Vec3<double> &force)
{
  for (int d = 0; d < 3; ++d) {
    grains.f[3 * i + d] += force[d];
    grains.f[3 * j + d] -= force[d];
  }
  virial[0] += branch.x * force.x;
  virial[1] += branch.y * force.y;
  virial[2] += branch.z * force.z;
  virial[3] += branch.x * force.y;
  virial[4] += branch.x * force.z;
  virial[5] += branch.y * force.z;
}

void Oracle::addModelForce(std::size_t i, std::size_t j, const ContactModel &model, const Contact<double> &c,
                           double *numbers, bool advance)
{
  Grains &g = grains;
  ContactState state{};
  for (int d = 0; d < 3; ++d) {
    state.branch[d] = c.branch[d];
    state.relativeVelocity[d] = c.relativeVelocity[d];
    state.surfaceSpin[d] = c.surfaceSpin[d];
    state.spinDifference[d] = g.w[3 * i + d] - g.w[3 * j + d];
  }
  state.overlap = c.overlap;
  state.effectiveRadius = c.effectiveRadius;
  state.effectiveMass = c.effectiveMass;
  state.radius = g.radius[i];
  state.partnerRadius = g.radius[j];
  const double mine = g.mass[i] * g.radius[i] * g.radius[i], other = g.mass[j] * g.radius[j] * g.radius[j];
  state.inertia = mine * other / (mine + other);
  if (g.mask[i] & scene_.frozenMask) state.inertia = other;
  if (g.mask[j] & scene_.frozenMask) state.inertia = mine;
  const auto evaluate = advance ? evaluateContact : evaluateContactAtStart;
  const ContactResult r = evaluate(model, layout_, state, numbers, scene_.timestep);
  const Vec3<double> n{r.normal[0], r.normal[1], r.normal[2]}, friction{r.friction[0], r.friction[1], r.friction[2]};
  const Vec3<double> couple = cross(n, friction);
  const double shorter = model.lever * c.overlap;
  for (int d = 0; d < 3; ++d) {
    const double moment = r.rolling[d] + r.twisting * n[d];
    g.t[3 * i + d] += moment - (g.radius[i] - shorter) * couple[d];
    g.t[3 * j + d] -= moment + (g.radius[j] - shorter) * couple[d];
  }
  addForce(i, j, c.branch, Vec3<double>{r.force[0], r.force[1], r.force[2]});
}

void Oracle::evaluate(std::int64_t step, bool advance)
{
  Grains &g = grains;
  g.f.assign(g.f.size(), 0.0);
  g.t.assign(g.t.size(), 0.0);
  virial.fill(0.0);
  contacts = 0;
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = i + 1; j < g.size(); ++j) pairForce(i, j, advance);
  for (const ForceTerm &term : scene_.terms)
    for (std::size_t i = 0; i < g.size(); ++i) {
      if (!(static_cast<std::uint32_t>(g.mask[i]) & term.groupMask)) continue;
      double *f = &g.f[3 * i], *t = &g.t[3 * i];
      if (term.kind == ForceTermKind::Gravity)
        for (int d = 0; d < 3; ++d) f[d] += g.mass[i] * term.value[d];
      if (term.kind == ForceTermKind::Viscous)
        for (int d = 0; d < 3; ++d) f[d] -= term.dragPerType[g.type[i]] * g.v[3 * i + d];
      if (term.kind == ForceTermKind::SetForce)
        for (int d = 0; d < 3; ++d)
          if (term.prescribed[d]) f[d] = term.value[d];
      if (term.kind == ForceTermKind::Freeze)
        for (int d = 0; d < 3; ++d) f[d] = t[d] = 0.0;
      if (term.kind == ForceTermKind::Enforce2d)
        f[2] = t[0] = t[1] = g.v[3 * i + 2] = g.w[3 * i] = g.w[3 * i + 1] = 0.0;
      if (term.kind == ForceTermKind::Wall) {
        const WallSpec &spec = scene_.walls[term.wall];
        WallView<double> wall = wallAt<double>(spec, Roles{}, step, scene_.timestep);
        if (spec.model) {
          wall.model = &wallModel_[term.wall];
          wall.layout = layoutView(wallLayout(spec));
          wall.flag = wallFlag(spec);
        }
        wall.historySize = wallHistorySize(spec);
        wall.history = wall.historySize ? wallKept_[term.wall].data() : nullptr;
        Motion<double> m{};
        m.vx = g.v[3 * i], m.vy = g.v[3 * i + 1], m.vz = g.v[3 * i + 2];
        m.wx = g.w[3 * i], m.wy = g.w[3 * i + 1], m.wz = g.w[3 * i + 2];
        m.mass = g.mass[i];
        const ContactForce<double> c = wallForce<WallUse::Any>(
            wall, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(g.size()),
            Vec3<double>{g.x[3 * i], g.x[3 * i + 1], g.x[3 * i + 2]}, g.radius[i], m, scene_.timestep, advance);
        for (int d = 0; d < 3; ++d) {
          f[d] += c.force[d];
          t[d] += c.moment[d] - (g.radius[i] - c.shorter) * c.couple[d];
        }
      }
    }
}

void Oracle::step(std::int64_t next)
{
  Grains &g = grains;
  const auto kick = [&](bool drift) {
    for (const IntegratorSpec &it : scene_.integrators)
      for (std::size_t i = 0; i < g.size(); ++i) {
        if (!(static_cast<std::uint32_t>(g.mask[i]) & it.groupMask)) continue;
        const double inertia = it.inertia * g.radius[i] * g.radius[i] * g.mass[i];
        for (int d = 0; d < 3; ++d) {
          const std::size_t k = 3 * i + d;
          g.v[k] += scene_.halfKick / g.mass[i] * g.f[k];
          g.w[k] += scene_.halfKick / inertia * g.t[k];
          if (drift) g.x[k] += scene_.timestep * g.v[k];
        }
      }
  };
  kick(true);
  evaluate(next, true);
  kick(false);
}

}  // namespace gpudem::testing
