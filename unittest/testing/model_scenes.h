// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Scenes whose contacts are products of sub-models.
#pragma once

#include "gpudem/scene.h"
#include "testing/oracle.h"

namespace gpudem::testing {

struct ModelScene {
  const char *name;
  std::vector<ContactModel> pairs;   ///< of types 1-1, 1-2, 2-2; empty: a law of the gran/ styles
  std::optional<ContactModel> wall;  ///< absent: a law of the gran/ styles
  std::array<bool, 3> periodic;
  bool cylinder = false;  ///< around the grains, instead of walls at the faces in x and y
};

/// Grains of about half a unit, stiff enough for time steps of 2e-4.
inline ContactModel stiffMaterial(double young = 5e5, double poisson = 0.3, double restitution = 0.6)
{
  ContactModel m;
  m.normal = {"hertz/material", {young, restitution, poisson}};
  m.damping.name = "coeff_restitution";
  m.tangential = {"mindlin", {std::nan(""), 0.5, 0.4}};
  m.rolling = {"sds", {1000.0, 2.0, 0.3}};
  m.twisting.name = "marshall";
  return m;
}
inline ContactModel stickyMaterial(double gamma)
{
  ContactModel m = stiffMaterial();
  m.normal = {"jkr", {5e5, 0.6, 0.3, gamma}};
  return m;
}
inline ContactModel springModel()
{
  ContactModel m;
  m.normal = {"hooke", {2e4, 5.0}};
  m.damping.name = "velocity";
  m.tangential = {"linear_history", {6e3, 0.5, 0.4}};
  return m;
}
/// The law of walls: the arm is the whole radius.
inline ContactModel asWall(ContactModel m)
{
  m.lever = 0.0;
  return m;
}

/// Plastic and wet: liquid bridges outlive touch, conventions of LIGGGHTS.
inline ContactModel wetModel()
{
  ContactModel m;
  m.normal = {"luding", {1.5e4, 0.6, 3e4, 3e3, 0.05}};
  m.damping.name = "coeff_restitution";
  m.tangential = {"liggghts_linear_history", {6e3, 0.5, 0.4}};
  m.rolling = {"epsd", {0.2, 0.3}};
  m.twisting = {"sds", {50.0, 0.2, 0.05}};
  m.cohesion = {"capillary", {8.0, 30.0, 3e-4}};
  m.slipLever = 0.5;
  m.coulombBase = CoulombBase::Net;
  return m;
}
/// Yields, and attracts before touch.
inline ContactModel dustModel()
{
  ContactModel m = stiffMaterial();
  m.normal = {"thornton_ning", {5e5, 0.6, 0.3, 5e4}};
  m.tangential = {"liggghts_history", {std::nan(""), std::nan(""), 0.4}};
  m.rolling = {"cdt", {0.1}};
  m.cohesion = {"vdw", {0.05, 0.02, 0.08}};
  return m;
}
inline ContactModel clayModel()
{
  ContactModel m = springModel();
  m.normal = {"eepa", {5e4, 5.0, 1.5e5, 2e4, 2.0}};
  m.rolling = {"epsd2", {0.2}};
  m.cohesion = {"sjkr", {50.0}};
  return m;
}

inline std::vector<ModelScene> modelScenes()
{
  const ContactModel a = stiffMaterial(), b = stiffMaterial(1e6, 0.2, 0.8);
  ContactModel forces = a, damped = springModel(), plain = springModel();
  forces.tangential.name = "mindlin_rescale/force";
  forces.twisting = {"sds", {50.0, 0.2, 0.05}};
  forces.damping.name = "tsuji";
  damped.tangential = {"linear_nohistory", {0.5, 0.4}};
  damped.damping.name = "mass_velocity";
  damped.limitDamping = true;
  ContactModel mixed = a;
  mixed.tangential.name = "mindlin_rescale";
  const ContactModel sticky = stickyMaterial(100.0);
  ContactModel dry = sticky;  // nothing kept but the fact that there is a contact
  dry.tangential = {"linear_nohistory", {0.5, 0.4}};
  dry.rolling = {"none", {}};
  dry.twisting = {"none", {}};
  ContactModel stiff = a;
  stiff.normal = {"dmt", {5e5, 10.0, 0.3, 5.0}};
  stiff.damping.name = "viscoelastic";
  const ContactModel wet = wetModel(), dust = dustModel(), clay = clayModel();
  ContactModel mud = a;
  mud.normal = {"eepa/linear", {1.5e4, 0.6, 4e4, 5e3, 1.0}};
  mud.tangential = {"mindlin", {6e4, 0.5, 0.4}};
  mud.rolling = {"epsd3", {0.2, 0.3, 1.0}};
  mud.cohesion = {"sjkr2", {50.0}};
  return {
      {"material, rolling, twisting", {a, a, a}, asWall(a), {true, true, true}},
      {"two materials, walls in z", {a, mixModels(a, b), b}, asWall(b), {true, true, false}},
      {"jkr beside hooke, adhesive walls", {sticky, mixed, plain}, asWall(sticky), {true, false, false}},
      {"strong adhesion, closed box", {sticky, sticky, sticky}, asWall(sticky), {false, false, false}},
      {"adhesion without history", {dry, dry, dry}, asWall(dry), {true, true, false}},
      {"kept forces, cylinder", {forces, forces, forces}, asWall(forces), {false, false, false}, true},
      {"dmt, closed box", {stiff, stiff, stiff}, asWall(stiff), {false, false, false}},
      {"no history at all", {damped, damped, damped}, asWall(damped), {true, true, false}},
      {"adhesive cylinder", {a, a, a}, asWall(sticky), {false, false, true}, true},
      {"gran/ pairs, adhesive walls", {}, asWall(sticky), {false, true, false}},
      {"adhesive pairs, gran/ walls", {sticky, sticky, sticky}, {}, {false, true, false}},
      {"bridges and plastic loading", {wet, wet, wet}, wet, {true, false, false}},
      {"attraction before touch, cylinder", {dust, dust, dust}, dust, {false, false, false}, true},
      {"clay, dust and bridges", {clay, dust, wet}, clay, {true, true, false}},
      {"linear eepa beside jkr", {mud, mud, dry}, asWall(mud), {true, true, false}},
  };
}

/// Box for two hundred grains or so.
inline Box boxOf(const ModelScene &m)
{
  Box box;
  box.lo = {-3.0, -3.0, 1.0};
  box.hi = {3.0, 3.0, 7.5};
  box.periodic = m.periodic;
  return box;
}

/// Radius of the cylinder of a box around the z axis.
inline double cylinderRadius(const Box &box)
{
  return 0.5 * (box.hi[0] - box.lo[0]);
}

inline void addModelWall(SceneSpec &s, const WallSpec &wall)
{
  ForceTerm t;
  t.kind = ForceTermKind::Wall;
  t.wall = static_cast<int>(s.walls.size());
  s.walls.push_back(wall);
  s.terms.push_back(t);
}

inline SceneSpec specOf(const ModelScene &m, const Box &box)
{
  SceneSpec s;
  s.types = 2;
  s.pair = {NormalModel::Hooke, TangentialModel::Spring, 2e4, 6e3, 20.0, 10.0, 0.4, false};
  if (!m.pairs.empty()) s.pairModels = {m.pairs[0], m.pairs[1], m.pairs[1], m.pairs[2]};
  s.timestep = 2e-4;
  s.halfKick = 0.5 * s.timestep;
  s.skin = 0.1;
  s.largestRadius = 0.5;
  for (int d = 0; d < 3; ++d) {
    if (box.periodic[d] || (m.cylinder && d < 2)) continue;
    WallSpec w;
    w.model = m.wall;
    w.law = s.pair;
    w.axis = d;
    w.lo = box.lo[d];
    w.hi = box.hi[d];
    addModelWall(s, w);
  }
  if (m.cylinder) {
    WallSpec w;
    w.model = m.wall;
    w.law = s.pair;
    w.shape = WallShape::Cylinder;
    w.radius = cylinderRadius(box);
    addModelWall(s, w);
  }
  ForceTerm gravity;
  gravity.kind = ForceTermKind::Gravity;
  gravity.value = {1.0, 0.0, -5.0};
  s.terms.push_back(gravity);
  s.integrators.emplace_back();
  return s;
}

/// Random grains that the walls hold, touching here and there.
inline Grains grainsIn(const ModelScene &m, const Box &box, std::size_t count, unsigned seed)
{
  const Grains all = randomCloud(count, box, 0.3, 0.5, seed);
  if (!m.cylinder) return all;
  Grains inside;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Array3 x = all.at(all.x, i);
    if (std::hypot(x[0], x[1]) > cylinderRadius(box) - 0.97 * all.radius[i]) continue;
    inside.add(x, all.at(all.v, i), all.at(all.w, i), all.radius[i], all.mass[i], all.mask[i], all.type[i]);
  }
  return inside;
}

}  // namespace gpudem::testing
