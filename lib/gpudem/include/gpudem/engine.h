// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The door of the library: particles in, steps, particles out. Free of CUDA and of LAMMPS.
#pragma once

#include "gpudem/body_motion.h"
#include "gpudem/errors.h"
#include "gpudem/rank_exchange.h"
#include "gpudem/scene.h"
#include "gpudem/surface_faces.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gpudem {

/// Per-particle fields that can be copied one by one. Combine with |.
enum Field : unsigned {
  fieldPosition = 1u << 0,
  fieldVelocity = 1u << 1,
  fieldSpin = 1u << 2,
  fieldForce = 1u << 3,
  fieldTorque = 1u << 4,
  fieldImage = 1u << 5,
  fieldMask = 1u << 6,   ///< LAMMPS group bits and type
  fieldShape = 1u << 7,  ///< radius and mass
  fieldKinetic = fieldPosition | fieldVelocity | fieldSpin,
  fieldDynamic = fieldKinetic | fieldForce | fieldTorque | fieldImage,
};

/// The host's arrays, in host order; null pointers are skipped. Shapes: [n] or [n][3], contiguous.
struct HostParticles {
  std::size_t count = 0;
  double *position = nullptr;  ///< [n][3] (distance)
  double *velocity = nullptr;  ///< [n][3] (distance/time)
  double *spin = nullptr;      ///< [n][3] (radian/time)
  double *force = nullptr;     ///< [n][3]
  double *torque = nullptr;    ///< [n][3]
  double *radius = nullptr;    ///< [n] (distance)
  double *mass = nullptr;      ///< [n]
  int *mask = nullptr;         ///< [n] LAMMPS group bits
  int *type = nullptr;         ///< [n] from 1
  int *tag = nullptr;          ///< [n] LAMMPS atom-ID
  int *image = nullptr;        ///< [n] LAMMPS packed image flags (10/10/10 or 21/21/21 bits are the caller's)
};

/// What contacts keep (tangential springs, ...), in compressed rows: row i is [offset[i], offset[i+1]).
/// Each contact appears in both rows, as either grain sees it.
struct ContactHistory {
  int size = 3;                       ///< numbers per contact, in the scene's HistoryLayout
  std::vector<std::uint32_t> offset;  ///< [n+1]
  std::vector<std::int32_t> partner;  ///< [contacts] tag of the partner
  std::vector<double> spring;         ///< [contacts][size]
};

/// Where a part of a region is, and how it moves.
struct PartMotion {
  Array3 displacement{};       ///< (distance)
  double angle = 0;            ///< about pivot and pivotAxis (radian)
  Array3 velocity{};           ///< of the displacement (distance/time)
  double angularVelocity = 0;  ///< of the angle (radian/time)
};

/// What the grains do to a wall, sums over the contacts of the last event.
struct WallSums {
  Array3 force{};             ///< on the wall
  Array3 torque{};            ///< on the wall, about the body's origin at its place
  std::int64_t contacts = 0;  ///< that push or pull
  std::vector<SurfaceTouch> touches;  ///< each of them, if the wall records touches
};

/// Values of the current step that a scene with moving parts changes.
struct StepInputs {
  std::int64_t step = 0;                            ///< the step whose force is evaluated
  std::vector<Array3> termValue;                    ///< replaces ForceTerm::value where not empty
  std::vector<std::vector<PartMotion>> wallMotion;  ///< [walls][parts] of region walls; what is empty is at rest
  std::vector<BodyMotion> bodyMotion;               ///< [walls] of surfaces; empty: all at rest
};

/// What an evaluation of the force at an event shall leave behind.
struct Recording {
  bool virial = false;
};

struct Observables {
  std::array<double, 6> virial{};  ///< xx yy zz xy xz yz, sum of branch x force over contacts (energy)
  std::vector<Array3> termForce;   ///< per force term: total force before the term acted
  std::vector<WallSums> wall;      ///< [walls] of surfaces
};

/// Sums over the grains of a group; exact fixed order, so reproducible.
struct KineticSums {
  std::array<double, 6> momentumFlux{};  ///< sum m v_a v_b: xx yy zz xy xz yz
  double rotational = 0;                 ///< sum R^2 m omega^2 (to be multiplied by inertia/2)
  double gravity = 0;                    ///< sum m g.x (filled on request only)
  std::int64_t count = 0;
};

/// Where a rank's grains are, roughly. They may lie anywhere: it is only the place from which they are seen.
struct Home {
  Array3 middle{};           ///< of its sub-domain (distance)
  bool commonMotion = true;  ///< grains that move together may leave it far behind before the next rebuild
};

struct Extent {
  Array3 lo{}, hi{};         ///< with several ranks in periodic directions from the middle of the home (distance)
  std::int64_t outside = 0;  ///< grains outside a non-periodic box face
};

/// Result of running queued steps.
struct Progress {
  int executed = 0;           ///< steps that ran
  bool needsRebuild = false;  ///< a grain used up its share of the skin: rebuild before the next force
};

struct MemoryReport {
  std::size_t bytes = 0;     ///< all device arrays
  std::size_t capacity = 0;  ///< total memory of the device (0: host)
};

struct NeighborReport {
  std::int64_t rebuilds = 0;
  double entriesPerGrain = 0;
  int longestRow = 0;
  std::int64_t cells = 0;
  std::vector<double> levelRadii;  ///< largest radius of each level of grains (distance); one level if empty
  std::int64_t ghosts = 0;         ///< grains of other ranks that this one sees
  std::int64_t sent = 0;           ///< grains sent in a step, once for each rank that sees them
  int partners = 0;                ///< ranks to which and from which messages go in a step
};

/// Search tables of a wall of triangles.
struct SurfaceReport {
  std::size_t triangles = 0;
  std::size_t bytes = 0;
  double seconds = 0;  ///< to make them
};

/// The resident state and its advance. One instance per simulation and rank; not thread-safe.
///
/// With several ranks each engine holds the grains of its rank and ghosts of others within reach. setScene(), upload(),
/// uploadFields(), rebuild() and all that advances steps are then collective: same calls, same order, same scene (the
/// largest radius is that of all ranks). Steps stop, and rebuilds are asked for, on all ranks at once. What is summed
/// or copied out is that of the rank's own grains.
///
/// Phases. *At step*: x_n, v_n and f_n are known. *Mid step*: x_(n+1), v_(n+1/2) are known, the force is not.
/// Every call throws gpudem::Error on failure and leaves no half-written host array.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string deviceName() const = 0;
  virtual Precision precision() const = 0;
  virtual MemoryReport memory() const = 0;
  virtual NeighborReport neighbors() const = 0;
  /// Of the surfaces whose tables were made since the last call.
  virtual std::vector<SurfaceReport> takeSurfaceReports() = 0;

  /// Share the box with other ranks, from the next upload() on. \p exchange outlives the engine; null: one rank.
  virtual void joinRanks(RankExchange *exchange) = 0;
  /// Before the first rebuild() and whenever sub-domains have changed.
  virtual void setHome(const Home &home) = 0;

  /// Constants of the run. Must be followed by upload() when walls, box or integrators changed.
  virtual void setScene(const SceneSpec &scene) = 0;

  /// Replace all particles. \p history may be null (no springs). The box must hold every grain.
  virtual void upload(const HostParticles &host, const Box &box, const ContactHistory *history) = 0;

  /// Overwrite single fields of the particles that are resident (same grains, same host order).
  virtual void uploadFields(const HostParticles &host, unsigned fields) = 0;

  /// Copy fields to the host's arrays. Positions are not wrapped since the last rebuild.
  virtual void downloadFields(const HostParticles &host, unsigned fields) = 0;

  /// Velocities before the last half kick, as the force saw them (valid after completeStep).
  virtual void downloadHalfStepVelocities(const HostParticles &host) = 0;

  virtual void downloadHistory(ContactHistory &history) = 0;

  /// Numbers kept against wall \p wall, host order, [n][wallHistorySize(wall)]; zero where not touching. Walls whose
  /// contacts outlive touch begin with a flag, 1 while in contact. A region wall keeps that mostContacts times, each
  /// time after the number of the face plus one, which is 0 where there is no contact.
  virtual void uploadWallHistory(int wall, const double *spring) = 0;
  virtual void downloadWallHistory(int wall, double *spring) = 0;
  /// Columns flag, force, contact point, radius of the last evaluated force, host order, [n][8].
  virtual void downloadWallContacts(int wall, double *columns) = 0;
  /// Original positions of prescribed motion, host order, [n][3].
  virtual void uploadOrigins(const double *position) = 0;

  /// Extent of all grains now, and how many left the box through a non-periodic face.
  virtual Extent extent(const Box &box) = 0;
  /// Wrap into the (possibly changed) box, sort, rebuild rows, carry the springs.
  virtual void rebuild(const Box &box) = 0;

  /// Force at the current positions and velocities, springs not advanced (LAMMPS' setup).
  virtual void evaluateForce(const StepInputs &in, const Recording &record) = 0;
  /// At step n -> mid step: half kick, drift.
  virtual void beginStep(const StepInputs &next) = 0;
  /// Mid step: queue one fused step (force, full kick, drift). Runs only while no rebuild is due.
  virtual void queueStep(const StepInputs &in) = 0;
  /// Run what is queued (or was begun) and say how far it got.
  virtual Progress flush() = 0;
  /// Mid step: force and springs; velocities stay at the half step.
  virtual void forceStep(const StepInputs &in, const Recording &record) = 0;
  /// After forceStep: the second half kick -> at step n.
  virtual void finishStep(const StepInputs &in) = 0;
  /// forceStep and finishStep in one pass.
  virtual void completeStep(const StepInputs &in, const Recording &record) = 0;

  virtual const Observables &observables() = 0;
  virtual KineticSums kineticSums(std::uint32_t groupMask, const Array3 &gravity) = 0;
};

struct EngineOptions {
  DeviceKind device = DeviceKind::Cpu;
  Precision precision = Precision::Mixed;
  int threads = 1;  ///< CPU threads
  int gpu = 0;      ///< device ordinal
  int warps = 0;    ///< GPU: warps that take 32 grains together, 1 or 4; 0: 4 in scenes that leave the chip idle. Same bits
};

/// Number of usable GPUs (0 when built without CUDA or without a driver).
int gpuCount();
/// Why there is no GPU, for the log.
std::string gpuProblem();
/// \throws Error when the device does not exist.
std::unique_ptr<Engine> makeEngine(const EngineOptions &options);

/// Numbers that a scene's pairs keep per contact.
HistoryLayout pairHistoryLayout(const SceneSpec &scene);
/// Must the pairs of a scene remember which contacts there are?
bool keepsContacts(const SceneSpec &scene);
/// Numbers that a wall keeps per grain, the flag included.
int wallHistorySize(const WallSpec &wall);

/// Bits of a resident coordinate: 64 in double precision; in mixed 40, or 32 if the scene names more than eight groups.
int coordinateBits(const SceneSpec &scene, Precision precision);

}  // namespace gpudem
