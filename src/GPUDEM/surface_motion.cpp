// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface_motion.h"

#include "formula.h"

#include "error.h"
#include "input.h"
#include "lammps.h"
#include "math_const.h"
#include "variable.h"

#include <cmath>

using namespace LAMMPS_NS;
using gpudem::BodyMotion;

namespace {

double value(LAMMPS *lmp, const std::string &name)
{
  if (name.empty()) return 0.0;
  return lmp->input->variable->compute_equal(lmp->input->variable->find(name.c_str()));
}

BodyMotion motionOf(LAMMPS *lmp, const SurfaceMove &m, double elapsed)
{
  using Kind = SurfaceMove::Kind;
  const double rate = m.period > 0.0 ? MathConst::MY_2PI / m.period : 0.0, angle = rate * elapsed;
  std::array<double, 3> place{}, velocity{};
  switch (m.kind) {
    case Kind::Rotate:
      return gpudem::turned(m.point, m.axis, angle, rate);
    case Kind::Nutate:
      return gpudem::nutating(m.point, m.axis, m.tilt, angle, rate);
    case Kind::Turn:
      return gpudem::turned(m.point, m.axis, value(lmp, m.variable[0]), value(lmp, m.variable[1]));
    case Kind::Linear:
    case Kind::Wiggle:
      for (std::size_t d = 0; d < 3; ++d) {
        const bool linear = m.kind == Kind::Linear;
        place[d] = m.vector[d] * (linear ? elapsed : std::sin(angle));
        velocity[d] = m.vector[d] * (linear ? 1.0 : rate * std::cos(angle));
      }
      return gpudem::displaced(place, velocity);
    case Kind::Variable:
      for (std::size_t d = 0; d < 3; ++d) {
        place[d] = value(lmp, m.variable[d]);
        velocity[d] = value(lmp, m.variable[3 + d]);
      }
      return gpudem::displaced(place, velocity);
  }
  return {};
}

template <class Visit>
void forEachVariable(const std::vector<SurfaceMove> &moves, const Visit &visit)
{
  for (const SurfaceMove &m : moves)
    for (const std::string &name : m.variable)
      if (!name.empty()) visit(name);
}

}  // namespace

BodyMotion LAMMPS_NS::bodyMotion(LAMMPS *lmp, const std::vector<SurfaceMove> &moves, double elapsed)
{
  BodyMotion all;
  for (const SurfaceMove &m : moves) all = gpudem::composed(motionOf(lmp, m, elapsed), all);
  return all;
}

std::string LAMMPS_NS::variableThatReadsParticles(LAMMPS *lmp, const std::vector<SurfaceMove> &moves)
{
  std::string reads;
  forEachVariable(moves, [&](const std::string &name) {
    if (reads.empty() && !isHostFree(lmp, name, FormulaScope::StepOnly)) reads = name;
  });
  return reads;
}

void LAMMPS_NS::checkVariables(LAMMPS *lmp, const std::string &command, const std::vector<SurfaceMove> &moves)
{
  forEachVariable(moves, [&](const std::string &name) {
    const int index = lmp->input->variable->find(name.c_str());
    if (index < 0) lmp->error->all(FLERR, "{}: variable {} does not exist", command, name);
    if (!lmp->input->variable->equalstyle(index))
      lmp->error->all(FLERR, "{}: variable {} is not of style equal", command, name);
  });
}
