// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "surface_arguments.h"

#include "wall_arguments.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "math_const.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

using namespace LAMMPS_NS;
using gpudem::Array3;

namespace {

constexpr const char *command = "Fix wall/gran/sdf";

/// The words from one on, each asked for by what it means.
class Words {
 public:
  Words(LAMMPS *lmp, int narg, char **arg, int at) : lmp_(lmp), narg_(narg), arg_(arg), at_(at) {}
  bool done() const { return at_ >= narg_; }
  int at() const { return at_; }
  void jump(int at) { at_ = at; }
  std::string word(const std::string &what)
  {
    if (done()) lmp_->error->all(FLERR, "{}: {} is missing at the end of the command", command, what);
    return arg_[at_++];
  }
  bool next(const char *word) const { return !done() && strcmp(arg_[at_], word) == 0; }
  /// The word that is to come, or one behind it; empty beyond the end.
  std::string peek(int ahead = 0) const { return at_ + ahead < narg_ ? arg_[at_ + ahead] : ""; }
  double number(const std::string &what)
  {
    const std::string w = word(what);
    if (!utils::is_double(w))
      lmp_->error->all(FLERR, "{}: '{}' stands where {} is expected, a number", command, w, what);
    return std::stod(w);
  }
  double positive(const std::string &what)
  {
    const double x = number(what);
    if (!(x > 0.0)) lmp_->error->all(FLERR, "{}: {} is {:g}, it must be above 0", command, what, x);
    return x;
  }
  double notNegative(const std::string &what)
  {
    const double x = number(what);
    if (!(x >= 0.0)) lmp_->error->all(FLERR, "{}: {} is {:g}, it must not be negative", command, what, x);
    return x;
  }
  int steps(const std::string &what)
  {
    const double n = number(what);
    if (n != std::floor(n) || n < 1 || n > 1e9)
      lmp_->error->all(FLERR, "{}: {} is {:g}, it must be a whole number above 0", command, what, n);
    return static_cast<int>(n);
  }
  Array3 vector(const std::string &what) { return {number(what + " x"), number(what + " y"), number(what + " z")}; }
  Array3 direction(const std::string &what)
  {
    Array3 v = vector(what);
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0.0)) lmp_->error->all(FLERR, "{}: {} is a vector of no length", command, what);
    for (double &x : v) x /= length;
    return v;
  }
  /// Name of a variable, empty for NULL.
  std::string variable(const std::string &what)
  {
    const std::string w = word(what);
    if (w == "NULL") return "";
    if (!utils::strmatch(w, "^v_."))
      lmp_->error->all(FLERR, "{}: '{}' stands where {} is expected, v_name or NULL", command, w, what);
    return w.substr(2);
  }

 private:
  LAMMPS *lmp_;
  int narg_;
  char **arg_;
  int at_;
};

/// Coefficients of the styles hooke, hooke/history and hertz/history, as in fix wall/gran.
void readClassicLaw(LAMMPS *lmp, const std::string &style, Words &words, gpudem::ContactLaw &law)
{
  law.normal = style == "hertz/history" ? gpudem::NormalModel::Hertz : gpudem::NormalModel::Hooke;
  law.tangential = style == "hooke" ? gpudem::TangentialModel::Viscous : gpudem::TangentialModel::Spring;
  const auto orNull = [&](const char *what, double derived) {
    if (!words.next("NULL")) return words.notNegative(what);
    words.word(what);
    return derived;
  };
  law.normalStiffness = words.notNegative("Kn");
  law.tangentialStiffness = orNull("Kt", 2.0 / 7.0 * law.normalStiffness);
  law.normalDamping = words.notNegative("gamma_n");
  law.tangentialDamping = orNull("gamma_t", 0.5 * law.normalDamping);
  law.friction = words.notNegative("xmu");
  const double damp = words.number("dampflag");
  if (damp != 0.0 && damp != 1.0) lmp->error->all(FLERR, "{}: dampflag is 0 or 1, not {:g}", command, damp);
  if (damp == 0.0) law.tangentialDamping = 0.0;
  if (style == "hertz/history") {  // from pressure to force/distance^2
    law.normalStiffness /= lmp->force->nktv2p;
    law.tangentialStiffness /= lmp->force->nktv2p;
  }
  if (words.next("limit_damping")) {
    words.word("");
    law.limitDamping = true;
  }
}

void readLaw(LAMMPS *lmp, int narg, char **arg, Words &words, gpudem::WallSpec &wall)
{
  const std::string style = words.word("the style of the contact law");
  if (style == "granular") {
    WallLaw law = readWallLaw(lmp, command, narg, arg, words.at(), {"surface"});
    wall.model = law.model;
    words.jump(law.next);
  } else if (style == "hooke" || style == "hooke/history" || style == "hertz/history") {
    readClassicLaw(lmp, style, words, wall.law);
  } else {
    lmp->error->all(FLERR,
                    "{}: '{}' is no style of contact law; there are hooke, hooke/history, hertz/history and "
                    "granular",
                    command, style);
  }
}

SurfaceMove readMove(LAMMPS *lmp, Words &words)
{
  using Kind = SurfaceMove::Kind;
  SurfaceMove m;
  const std::string kind = words.word("a kind of motion");
  if (kind == "linear") {
    m.vector = words.vector("the velocity");
  } else if (kind == "wiggle") {
    m.kind = Kind::Wiggle;
    m.vector = words.vector("the amplitude");
    m.period = words.positive("the period");
  } else if (kind == "rotate" || kind == "nutate" || kind == "turn") {
    m.kind = kind == "rotate" ? Kind::Rotate : kind == "nutate" ? Kind::Nutate : Kind::Turn;
    m.point = words.vector("the point on the axis");
    m.axis = words.direction("the axis");
    if (m.kind == Kind::Nutate) m.tilt = words.number("the angle") * MathConst::MY_PI / 180.0;
    if (m.kind != Kind::Turn) m.period = words.positive("the period");
    else m.variable = {words.variable("the angle"), words.variable("the angular velocity")};
  } else if (kind == "variable") {
    m.kind = Kind::Variable;
    for (const char *what : {"the displacement in x", "the displacement in y", "the displacement in z",
                             "the velocity in x", "the velocity in y", "the velocity in z"})
      m.variable.push_back(words.variable(what));
  } else {
    lmp->error->all(FLERR, "{}: '{}' is no kind of motion; there are linear, wiggle, rotate, nutate, variable and turn",
                    command, kind);
  }
  return m;
}

gpudem::SurfaceSide readSide(LAMMPS *lmp, Words &words)
{
  const std::string side = words.word("the side of the grains");
  if (side == "both") return gpudem::SurfaceSide::Both;
  if (side == "inside") return gpudem::SurfaceSide::Inside;
  if (side == "outside") return gpudem::SurfaceSide::Outside;
  lmp->error->all(FLERR, "{}: side is both, inside or outside, not '{}'", command, side);
  return {};
}

FacesOutput readFaces(LAMMPS *lmp, Words &words)
{
  FacesOutput f;
  f.sampleEvery = words.steps("the number of steps between samples");
  f.writeEvery = words.steps("the number of steps between files");
  if (f.writeEvery % f.sampleEvery)
    lmp->error->all(FLERR, "{}: faces are written every {} steps, which is no multiple of the {} between samples",
                    command, f.writeEvery, f.sampleEvery);
  f.file = words.word("the VTK file of the faces");
  return f;
}

gpudem::Servo readServo(LAMMPS *lmp, Words &words, int &every)
{
  gpudem::Servo s;
  const std::string kind = words.word("what the servo holds");
  if (kind == "torque") {
    s.kind = gpudem::Servo::Kind::Torque;
    s.point = words.vector("the point on the axis");
  } else if (kind != "force") {
    lmp->error->all(FLERR, "{}: a servo holds force or torque, not '{}'", command, kind);
  }
  s.axis = words.direction("the axis");
  s.target = words.number("the target");
  s.fastest = words.positive("the largest speed");
  every = words.steps("the number of steps between updates of the servo");
  if (words.next("gain")) {
    words.word("");
    s.gain = words.positive("the gain");
  } else if (s.target == 0.0) {
    lmp->error->all(FLERR, "{}: a servo with target 0 needs a gain", command);
  } else {
    s.gain = s.fastest / std::abs(s.target);
  }
  return s;
}

/// Move all vertices: keywords scale, rotate and translate in their order.
template <class Change>
void change(gpudem::SurfaceMesh &mesh, const Change &place)
{
  for (Array3 &p : mesh.vertex) p = place(p);
}

void readKeyword(LAMMPS *lmp, const std::string &keyword, Words &words, SurfaceArguments &a, gpudem::SurfaceMesh &mesh,
                 double &weld)
{
  if (keyword == "scale") {
    const double s = words.positive("the scale");
    change(mesh, [&](const Array3 &p) { return Array3{s * p[0], s * p[1], s * p[2]}; });
  } else if (keyword == "translate") {
    const Array3 t = words.vector("the translation");
    change(mesh, [&](const Array3 &p) { return Array3{p[0] + t[0], p[1] + t[1], p[2] + t[2]}; });
  } else if (keyword == "rotate") {
    const Array3 axis = words.direction("the axis");
    const double angle = words.number("the angle") * MathConst::MY_PI / 180.0;
    const gpudem::BodyMotion turn = gpudem::turned({0.0, 0.0, 0.0}, axis, angle, 0.0);
    change(mesh, [&](const Array3 &p) { return gpudem::placeOf(turn, p); });
  } else if (keyword == "side") {
    a.wall.surfaceSide = readSide(lmp, words);
  } else if (keyword == "move") {
    a.moves.push_back(readMove(lmp, words));
  } else if (keyword == "reference") {
    a.reference = words.vector("the reference point");
  } else if (keyword == "weld") {
    weld = words.positive("the welding distance");
  } else if (keyword == "max/contacts") {
    const double n = words.number("the number of contacts");
    if (n != std::floor(n) || n < 1 || n > gpudem::maxSurfaceSlots)
      lmp->error->all(FLERR, "{}: max/contacts is {:g}, it must be a whole number from 1 to {}", command, n,
                      gpudem::maxSurfaceSlots);
    a.wall.mostContacts = static_cast<int>(n);
  } else if (keyword == "contacts") {
    a.recordContacts = true;
  } else if (keyword == "zones") {
    a.zones = a.wall.recordTouches = true;
  } else if (keyword == "faces") {
    const double wear = a.faces.wear;
    a.faces = readFaces(lmp, words);
    a.faces.wear = wear;
    a.wall.recordTouches = true;
  } else if (keyword == "wear") {
    a.faces.wear = words.notNegative("the coefficient of wear");
  } else if (keyword == "servo") {
    a.servo = readServo(lmp, words, a.servoEvery);
  } else if (keyword == "spacing") {
    lmp->error->all(FLERR, "{}: spacing stands right behind the shape", command);
  } else if (gpudem::isOperation(keyword)) {
    lmp->error->all(FLERR, "{}: {} stands between two shapes, ahead of spacing and the keywords", command, keyword);
  } else {
    lmp->error->all(FLERR,
                    "{}: '{}' is no keyword; there are scale, rotate, translate, side, move, reference, weld, "
                    "max/contacts, contacts, zones, faces, wear and servo",
                    command, keyword);
  }
}

/// Smallest radius of all atoms, 0 if there is none (distance).
double smallestRadius(LAMMPS *lmp)
{
  const Atom *atom = lmp->atom;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; atom->radius && i < atom->nlocal; ++i) smallest = std::min(smallest, atom->radius[i]);
  MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  return std::isfinite(smallest) ? smallest : 0.0;
}

/// Shapes behind the first one, each with its operation on all before it: A union B difference C is
/// difference(union(A,B),C).
std::string readShape(LAMMPS *lmp, std::string shape, Words &words)
{
  while (gpudem::isOperation(words.peek())) {
    const std::string operation = words.word(""), operand = words.word("the shape behind " + operation);
    for (const std::string &s : {shape, operand})
      if (!gpudem::isShape(s))
        lmp->error->all(FLERR, "{}: {} combines shapes, but '{}' has not the form name(value,value,...)", command,
                        operation, s);
    shape = fmt::format("{}({},{})", operation, shape, operand);
  }
  if (gpudem::isShape(words.peek()) || gpudem::isShape(words.peek(1)))
    lmp->error->all(FLERR, "{}: '{}' is no operation between shapes; there are union, intersection and difference",
                    command, words.peek());
  return shape;
}

/// The triangles of a shape or of a file.
gpudem::SurfaceMesh readMesh(LAMMPS *lmp, const std::string &surface, Words &words)
{
  constexpr double chordPerRadius = 1e-3;
  const bool given = words.next("spacing");
  if (!gpudem::isShape(surface)) {
    if (given)
      lmp->error->all(FLERR, "{}: spacing is for shapes, the triangles of '{}' are those of the file", command,
                      surface);
    return gpudem::readSurface(surface);
  }
  if (!given) return gpudem::shapeSurface(surface, 0.0, chordPerRadius * smallestRadius(lmp));
  words.word("");
  return gpudem::shapeSurface(surface, words.positive("the spacing"), 0.0);
}

}  // namespace

SurfaceArguments LAMMPS_NS::readSurfaceArguments(LAMMPS *lmp, int narg, char **arg)
{
  SurfaceArguments a;
  Words words(lmp, narg, arg, 3);
  readLaw(lmp, narg, arg, words, a.wall);
  const std::string keyword = words.word("keyword surface");
  if (keyword != "surface")
    lmp->error->all(FLERR, "{}: '{}' stands where keyword surface is expected", command, keyword);
  a.file = words.word("the file or shape of the surface");
  a.file = readShape(lmp, a.file, words);
  a.wall.shape = gpudem::WallShape::Surface;
  a.wall.mostContacts = 8;
  try {
    auto mesh = std::make_shared<gpudem::SurfaceMesh>(readMesh(lmp, a.file, words));
    double weld = 1e-6;
    while (!words.done()) readKeyword(lmp, words.word(""), words, a, *mesh, weld);
    a.report = gpudem::cleanSurface(*mesh, weld);
    a.wall.surface = mesh;
  } catch (const gpudem::Error &e) {
    lmp->error->all(FLERR, "{}: {}", command, e.what());
  }
  if (a.faces.wear > 0.0 && a.faces.file.empty())
    lmp->error->all(FLERR, "{}: wear is found at the samples of keyword faces, which is missing", command);
  if (a.wall.surfaceSide != gpudem::SurfaceSide::Both && !a.report.closed())
    lmp->error->all(FLERR,
                    "{}: side inside and outside need closed bodies, but '{}' has {} of {} bodies closed. Close it, or "
                    "use side both.\n{}",
                    command, a.file, a.report.closedBodies, a.report.bodies, a.report.text());
  return a;
}
