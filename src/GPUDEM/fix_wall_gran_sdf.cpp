// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "fix_wall_gran_sdf.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {
constexpr int columns = 8;  // of the contacts output, as in fix wall/gran

/// Moment about the axis through \p point of a force that acts at \p at.
double axisMoment(const gpudem::Array3 &point, const double *at, const double *force, const gpudem::Array3 &axis)
{
  double moment = 0.0;
  for (int d = 0; d < 3; ++d) {
    const int a = (d + 1) % 3, b = (d + 2) % 3;
    moment += axis[d] * ((at[a] - point[a]) * force[b] - (at[b] - point[b]) * force[a]);
  }
  return moment;
}
}

FixWallGranSdf::FixWallGranSdf(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), in(readSurfaceArguments(lmp, narg, arg))
{
  if (!atom->sphere_flag) error->all(FLERR, "Fix wall/gran/sdf requires atom style sphere");
  forceTerm = true;
  in.wall.groupMask = static_cast<unsigned>(groupbit);
  in.wall.recordContacts = in.recordContacts;
  for (const SurfaceMove &m : in.moves)
    if (!in.reference && m.kind != SurfaceMove::Kind::Linear && m.kind != SurfaceMove::Kind::Wiggle &&
        m.kind != SurfaceMove::Kind::Variable)
      in.reference = m.point;
  reference = in.reference.value_or(gpudem::Array3{});

  vector_flag = 1;
  size_vector = 13;
  global_freq = 1;
  extvector = 0;
  if (in.zones) {
    array_flag = 1;
    size_array_rows = static_cast<int>(std::max<std::size_t>(1, in.wall.surface->zoneName.size()));
    size_array_cols = 7;
    extarray = 0;
  }
  if (!in.faces.file.empty()) faces = std::make_unique<gpudem::FaceLoads>(in.wall.surface, in.faces.wear);
  time_depend = bodyMoves() ? 1 : 0;
  create_attribute = 1;
  restart_peratom = restart_global = 1;
  maxexchange = 1 + numbers() + columns;
  if (in.recordContacts) {
    peratom_flag = 1;
    size_peratom_cols = columns;
    peratom_freq = 1;
  }
  FixWallGranSdf::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; ++i) FixWallGranSdf::set_arrays(i);
  timeOrigin = sampledStep = update->ntimestep;
  report();
}

FixWallGranSdf::~FixWallGranSdf()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(kept);
  if (peratom_flag) memory->destroy(array_atom);
}

void FixWallGranSdf::report()
{
  if (comm->me != 0) return;
  const gpudem::SurfaceMesh &mesh = *in.wall.surface;
  gpudem::Array3 lo = mesh.vertex[0], hi = lo;
  for (const gpudem::Array3 &p : mesh.vertex)
    for (std::size_t d = 0; d < 3; ++d) {
      lo[d] = std::min(lo[d], p[d]);
      hi[d] = std::max(hi[d], p[d]);
    }
  utils::logmesg(lmp, "Surface {} of fix {}: box ({:g} {:g} {:g}) to ({:g} {:g} {:g})\n  {}\n", in.file, id, lo[0],
                 lo[1], lo[2], hi[0], hi[1], hi[2], in.report.text());
}

int FixWallGranSdf::setmask()
{
  return POST_FORCE;
}

void FixWallGranSdf::init()
{
  if (!utils::strmatch(update->integrate_style, "^verlet"))
    error->all(FLERR, "Fix wall/gran/sdf: run_style {} is not possible, verlet is", update->integrate_style);
  for (int k = 0; k < modify->nfix; ++k)
    if (modify->fix[k]->rigid_flag)
      error->all(FLERR, "Fix wall/gran/sdf: rigid bodies are not possible (fix {})", modify->fix[k]->id);
  checkVariables(lmp, "Fix wall/gran/sdf", in.moves);
}

void FixWallGranSdf::setup(int vflag)
{
  post_force(vflag);
}

double FixWallGranSdf::elapsed() const
{
  return static_cast<double>(update->ntimestep - timeOrigin) * update->dt;
}

gpudem::BodyMotion FixWallGranSdf::bodyMotion()
{
  const gpudem::BodyMotion moved = LAMMPS_NS::bodyMotion(lmp, in.moves, elapsed());
  return in.servo ? gpudem::composed(in.servo->motionAt(elapsed()), moved) : moved;
}

std::vector<int> FixWallGranSdf::periods() const
{
  std::vector<int> all;
  if (in.servo) all.push_back(in.servoEvery);
  if (faces) all.push_back(in.faces.sampleEvery);
  return all;
}

void FixWallGranSdf::post_force(int)
{
  if (onDevice) return;
  gpudem::HostParticles p;
  p.count = static_cast<std::size_t>(atom->nlocal);
  if (p.count) {
    p.position = atom->x[0];
    p.velocity = atom->v[0];
    p.spin = atom->omega[0];
    p.force = atom->f[0];
    p.torque = atom->torque[0];
    p.radius = atom->radius;
    p.mass = atom->rmass;
    p.mask = atom->mask;
    p.tag = atom->tag;
  }
  try {
    if (!wallOnHost) wallOnHost = std::make_unique<gpudem::SurfaceWall>(in.wall);
    double *recorded = in.recordContacts && p.count ? array_atom[0] : nullptr;
    setSums(wallOnHost->apply(p, bodyMotion(), update->dt, !update->setupflag, p.count ? kept[0] : nullptr, recorded));
  } catch (const gpudem::Error &e) {
    error->one(FLERR, "Fix wall/gran/sdf: {} (fix {}, step {})", e.what(), id, update->ntimestep);
  }
}

void FixWallGranSdf::setSums(const gpudem::WallSums &sumsNow)
{
  sums = sumsNow;
  motionOfSums = bodyMotion();
  summed = zonesSummed = false;
  sample();
}

// the setup of a run evaluates the force of a step that was there before: nothing is seen twice
void FixWallGranSdf::sample()
{
  const bigint step = update->ntimestep;
  if (step <= sampledStep) return;
  sampledStep = step;
  if (faces && step % in.faces.sampleEvery == 0) {
    faces->add(sums.touches, motionOfSums, in.faces.sampleEvery * update->dt);
    if (step % in.faces.writeEvery == 0) writeFaces();
  }
  if (in.servo && step % in.servoEvery == 0) {
    sumOverRanks();
    const int first = in.servo->kind == gpudem::Servo::Kind::Force ? 0 : 3;
    double load = 0.0;
    for (int d = 0; d < 3; ++d) load += vector[first + d] * in.servo->axis[d];
    if (first == 3) load += axisMoment(in.servo->point, vector + 8, vector, in.servo->axis);
    in.servo->update(elapsed(), load);
  }
}

void FixWallGranSdf::writeFaces()
{
  const auto n = static_cast<int>(faces->sums().size()), m = static_cast<int>(faces->wear().size());
  std::vector<double> total(n), wear(m);
  MPI_Reduce(faces->sums().data(), total.data(), n, MPI_DOUBLE, MPI_SUM, 0, world);
  MPI_Reduce(faces->wear().data(), wear.data(), m, MPI_DOUBLE, MPI_SUM, 0, world);
  std::string path = in.faces.file;
  const auto star = path.find('*');
  if (star != std::string::npos) path.replace(star, 1, std::to_string(update->ntimestep));
  try {
    if (comm->me == 0) faces->write(path, motionOfSums, total, wear);
  } catch (const gpudem::Error &e) {
    error->one(FLERR, "Fix wall/gran/sdf: {}", e.what());
  }
  faces->restart();
}

void FixWallGranSdf::sumOverRanks()
{
  if (summed) return;
  summed = true;
  double mine[7];
  std::copy_n(sums.force.begin(), 3, mine);
  std::copy_n(sums.torque.begin(), 3, mine + 3);
  mine[6] = static_cast<double>(sums.contacts);
  double total[7];
  MPI_Allreduce(mine, total, 7, MPI_DOUBLE, MPI_SUM, world);
  // the sums refer to the body's origin
  const gpudem::Array3 place = gpudem::placeOf(motionOfSums, reference), &origin = motionOfSums.displacement;
  const double arm[3] = {origin[0] - place[0], origin[1] - place[1], origin[2] - place[2]};
  double power = 0.0;
  for (int d = 0; d < 3; ++d) {
    const int a = (d + 1) % 3, b = (d + 2) % 3;
    vector[d] = total[d];
    vector[3 + d] = total[3 + d] + arm[a] * total[b] - arm[b] * total[a];
    vector[8 + d] = place[d];
    power -= total[d] * motionOfSums.velocity[d] + total[3 + d] * motionOfSums.angularVelocity[d];
  }
  vector[6] = power;
  vector[7] = total[6];
  if (in.servo) {
    vector[11] = in.servo->placeAt(elapsed());
    vector[12] = in.servo->speed;
  }
}

void FixWallGranSdf::sumZones()
{
  if (zonesSummed) return;
  zonesSummed = true;
  const auto mine = gpudem::zoneSums(*in.wall.surface, sums.touches, gpudem::placeOf(motionOfSums, reference));
  zoneArray.assign(7 * mine.size(), 0.0);
  MPI_Allreduce(mine[0].data(), zoneArray.data(), static_cast<int>(zoneArray.size()), MPI_DOUBLE, MPI_SUM, world);
}

double FixWallGranSdf::compute_array(int zone, int n)
{
  sumZones();
  return zoneArray[7 * static_cast<std::size_t>(zone) + static_cast<std::size_t>(n)];
}

double FixWallGranSdf::compute_vector(int n)
{
  sumOverRanks();
  return vector[n];
}

void FixWallGranSdf::grow_arrays(int nmax)
{
  memory->grow(kept, nmax, numbers(), "wall/gran/sdf:kept");
  if (peratom_flag) memory->grow(array_atom, nmax, columns, "wall/gran/sdf:array_atom");
}

void FixWallGranSdf::copy_arrays(int i, int j, int)
{
  std::copy_n(kept[i], numbers(), kept[j]);
  if (peratom_flag) std::copy_n(array_atom[i], columns, array_atom[j]);
}

void FixWallGranSdf::set_arrays(int i)
{
  std::fill_n(kept[i], numbers(), 0.0);
  if (peratom_flag) std::fill_n(array_atom[i], columns, 0.0);
}

int FixWallGranSdf::packContacts(int i, double *buffer) const
{
  int n = 0;
  for (int slot = 0; slot < in.wall.mostContacts; ++slot) {
    const double *s = kept[i] + slot * slotSize();
    if (s[0] == 0.0 && s[1] == 0.0 && s[2] == 0.0) continue;
    std::copy_n(s, slotSize(), buffer + n);
    n += slotSize();
  }
  return n;
}

void FixWallGranSdf::unpackContacts(int i, const double *buffer, int count)
{
  std::fill_n(kept[i], numbers(), 0.0);
  std::copy_n(buffer, std::min(count, numbers()), kept[i]);
}

int FixWallGranSdf::pack_exchange(int i, double *buffer)
{
  int n = 1 + packContacts(i, buffer + 1);
  buffer[0] = n - 1;
  if (peratom_flag) {
    std::copy_n(array_atom[i], columns, buffer + n);
    n += columns;
  }
  return n;
}

int FixWallGranSdf::unpack_exchange(int nlocal, double *buffer)
{
  int n = static_cast<int>(buffer[0]);
  unpackContacts(nlocal, buffer + 1, n++);
  if (peratom_flag) {
    std::copy_n(buffer + n, columns, array_atom[nlocal]);
    n += columns;
  }
  return n;
}

// restart: length, numbers per contact, contacts
int FixWallGranSdf::pack_restart(int i, double *buffer)
{
  buffer[0] = 2 + packContacts(i, buffer + 2);
  buffer[1] = slotSize();
  return static_cast<int>(buffer[0]);
}

void FixWallGranSdf::unpack_restart(int nlocal, int nth)
{
  const double *extra = atom->extra[nlocal];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  const int count = static_cast<int>(extra[0]) - 2;
  // another law keeps other numbers: its contacts begin anew
  unpackContacts(nlocal, extra + 2, static_cast<int>(extra[1]) == slotSize() ? count : 0);
  if (peratom_flag) std::fill_n(array_atom[nlocal], columns, 0.0);
}

int FixWallGranSdf::maxsize_restart()
{
  return 2 + numbers();
}

int FixWallGranSdf::size_restart(int nlocal)
{
  std::vector<double> buffer(static_cast<std::size_t>(numbers()));
  return 2 + packContacts(nlocal, buffer.data());
}

// step of the beginning, last sampled step, servo (place, speed, time of its update), wear of the triangles
void FixWallGranSdf::write_restart(FILE *file)
{
  std::vector<double> wear;
  if (faces) {
    wear.resize(faces->wear().size());
    MPI_Reduce(faces->wear().data(), wear.data(), static_cast<int>(wear.size()), MPI_DOUBLE, MPI_SUM, 0, world);
  }
  if (comm->me != 0) return;
  std::vector<double> state{static_cast<double>(timeOrigin), static_cast<double>(sampledStep), 0.0, 0.0, 0.0};
  if (in.servo) {
    state[2] = in.servo->place;
    state[3] = in.servo->speed;
    state[4] = in.servo->since;
  }
  state.push_back(static_cast<double>(wear.size()));
  state.insert(state.end(), wear.begin(), wear.end());
  const int size = static_cast<int>(state.size() * sizeof(double));
  fwrite(&size, sizeof size, 1, file);
  fwrite(state.data(), sizeof(double), state.size(), file);
}

void FixWallGranSdf::restart(char *buffer)
{
  const auto *state = reinterpret_cast<const double *>(buffer);
  timeOrigin = static_cast<bigint>(state[0]);
  sampledStep = static_cast<bigint>(state[1]);
  if (in.servo) {
    in.servo->place = state[2];
    in.servo->speed = state[3];
    in.servo->since = state[4];
  }
  // another surface, or none before: its wear begins anew
  if (!faces || static_cast<std::size_t>(state[5]) != faces->wear().size()) return;
  if (comm->me == 0) std::copy_n(state + 6, faces->wear().size(), faces->wear().begin());
}

double FixWallGranSdf::memory_usage()
{
  return static_cast<double>(atom->nmax) * (numbers() + (peratom_flag ? columns : 0)) * sizeof(double);
}

ResidentVerdict FixWallGranSdf::resident()
{
  const std::string reads = variableThatReadsParticles(lmp, in.moves);
  if (reads.empty()) return {};
  return ResidentVerdict::no("it moves with variable " + reads + ", which depends on more than the step");
}

void FixWallGranSdf::describe(gpudem::SceneSpec &scene)
{
  wall = static_cast<int>(scene.walls.size());
  scene.walls.push_back(in.wall);
  gpudem::ForceTerm t;
  t.kind = gpudem::ForceTermKind::RegionWall;
  t.groupMask = in.wall.groupMask;
  t.wall = wall;
  term = static_cast<int>(scene.terms.size());
  scene.terms.push_back(t);
}

void FixWallGranSdf::exportHistory(std::vector<double> &history)
{
  const auto n = static_cast<std::size_t>(numbers()) * atom->nlocal;
  history.assign(n, 0.0);
  if (n) std::copy_n(kept[0], n, history.begin());
}

void FixWallGranSdf::importHistory(const std::vector<double> &history)
{
  if (!history.empty()) std::copy(history.begin(), history.end(), kept[0]);
}

void FixWallGranSdf::importContacts(const std::vector<double> &recorded)
{
  if (!recorded.empty()) std::copy(recorded.begin(), recorded.end(), array_atom[0]);
}
