// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The engine of one backend and one precision. Included by engine_cpu.cpp and engine_gpu.cu only.
#pragma once

#include "base/buffer.hpp"
#include "base/saturated.hpp"
#include "contact/derive.hpp"
#include "contact/scene_laws.hpp"
#include "decomp/ghost_layer.hpp"
#include "engine/transfer.hpp"
#include "gpudem/engine.h"
#include "neighbor/cross_levels.hpp"
#include "neighbor/common_drift.hpp"
#include "neighbor/inner_list.hpp"
#include "neighbor/level_choice.hpp"
#include "neighbor/place.hpp"
#include "neighbor/pair_table.hpp"
#include "neighbor/row_table.hpp"
#include "neighbor/size_range.hpp"
#include "step/contact_chunk.hpp"
#include "step/contact_team.hpp"
#include "step/segment_contacts.hpp"
#include "step/contact_warp.hpp"
#include "step/kernel_products.hpp"
#include "step/observables.hpp"
#include "step/region_step.hpp"
#include "step/region_views.hpp"
#include "step/scene_views.hpp"
#include "step/surface_step.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

namespace gpudem {

template <class Exec, class P>
class EngineImpl final : public Engine {
 public:
  EngineImpl(Exec exec, Precision precision, int warps) : exec_(std::move(exec)), precision_(precision), warps_(warps)
  {
    status_.reserve(1);
    resetStatus();
  }

  std::string deviceName() const override { return exec_.name(); }
  Precision precision() const override { return precision_; }
  MemoryReport memory() const override;
  NeighborReport neighbors() const override { return report_; }
  std::vector<SurfaceReport> takeSurfaceReports() override { return std::exchange(surfaceReports_, {}); }

  void joinRanks(RankExchange *exchange) override { layer_.join(exchange); }
  void setHome(const Home &home) override { home_ = home; }
  void setScene(const SceneSpec &scene) override;
  void upload(const HostParticles &host, const Box &box, const ContactHistory *history) override;
  void uploadFields(const HostParticles &host, unsigned fields) override;
  void downloadFields(const HostParticles &host, unsigned fields) override;
  void downloadHalfStepVelocities(const HostParticles &host) override;
  void downloadHistory(ContactHistory &history) override;
  void uploadWallHistory(int wall, const double *spring) override;
  void downloadWallHistory(int wall, double *spring) override;
  void downloadWallContacts(int wall, double *columns) override;
  void uploadOrigins(const double *position) override;

  Extent extent(const Box &box) override;
  void rebuild(const Box &box) override;

  void evaluateForce(const StepInputs &in, const Recording &record) override;
  void beginStep(const StepInputs &next) override;
  void queueStep(const StepInputs &in) override;
  Progress flush() override;
  void forceStep(const StepInputs &in, const Recording &record) override;
  void finishStep(const StepInputs &in) override;
  void completeStep(const StepInputs &in, const Recording &record) override;

  const Observables &observables() override { return observables_; }
  KineticSums kineticSums(std::uint32_t groupMask, const Array3 &gravity) override;

 private:
  using Real = typename P::Real;
  template <class T>
  using Array = typename Exec::template Array<T>;

  /// Contacts of the last event with a wall that records touches.
  struct Touches {
    Array<std::uint32_t> at{"places of touches"};  ///< [n + 1] first of each grain
    Array<SurfaceTouch> room{"room for touches"};
    std::uint64_t total = 0;  ///< places in \c room
  };

  /// A wall of triangles, and what is known of its place. Empty for other walls.
  struct SurfaceWall {
    std::shared_ptr<const SurfaceMesh> mesh;
    std::shared_ptr<const Surface> surface;
    SurfaceSide side{};
    Array<unsigned char> copy{"surface of a wall"};  ///< on a GPU
    SurfaceView view{};
    Vec3<double> lo{}, hi{};  ///< box of the mesh in the frame of the body (distance)
    bool marked = false;      ///< the grains near it are known
    bool markQueued = false;  ///< the launches that find them are queued, and may not have been allowed
    BodyPose markedAt{};      ///< and were found here
    double room = 0.0;        ///< how far it may move until they are looked for anew (distance); 0 for one at rest
    Array<std::uint32_t> near{"grains near a surface"};  ///< [n] 1 or 0; those of 0 keep nothing
    Array<std::uint32_t> nearGrain{"grains near a surface (2)"}, nearList{"triangles near grains"},
        nearSlots{"contacts of near grains"};
    Array<float> nearGap{"distances of near triangles"};
    Array<Vec3<double>> nearFrom{"places of near grains"};
    std::uint32_t nearGrains = 0;
    Touches touches;
  };

  /// Positions \p pos, whose lower bits in mixed precision belong to the motion \p mot.
  PositionArrays<P> positions(int pos, int mot)
  {
    return {coarse_[pos].data(), P::fine ? fine_[pos].data() : nullptr, motion_[mot].data(), roles_.fineMask()};
  }
  PositionArrays<P> positions() { return positions(posNow_, motNow_); }
  void setRoles();
  void resetStatus();
  void reserveParticles();
  void importFields(const HostParticles &host, unsigned fields);
  std::size_t bytesPerGrain() const;
  template <class Work>
  void explainMemory(const Work &work);
  StepView<P> view(const StepInputs &in, std::int64_t coming);
  void runEvent(const StepInputs &in, const Recording &record, bool advance, bool finish);
  void launchRegions(const StepView<P> &v, const StepInputs &in);
  template <StepMode mode>
  void launchContactsIn(const StepView<P> &v);
  template <class Law, StepMode mode>
  void launchLaw(const StepView<P> &v);
  template <class Law, StepMode mode>
  void launchLongRows(const StepView<P> &v);
  template <class Law, StepMode mode, WallUse walls>
  void launchLawAndWalls(const StepView<P> &v);
  template <class Product>
  bool wallsAreServedBy(Product product) const;
  static constexpr int mostTeam = 4;
  int warpsPerSlice(std::uint32_t slices) const;
  bool hasSurfaces() const;
  double mostRoomOfDrift() const;
  void setLaws();
  void setRegions();
  WallView<Real> wallView(std::size_t w, std::int64_t step);
  void attachWalls(WallView<Real> *wall, std::int64_t step);
  bool isRegion(std::size_t w) const { return scene_.walls[w].shape == WallShape::Region; }
  bool isSurface(std::size_t w) const { return scene_.walls[w].shape == WallShape::Surface; }
  /// Walls with a launch of their own.
  static bool isApart(const WallSpec &wall)
  {
    return wall.shape == WallShape::Region || wall.shape == WallShape::Surface;
  }
  void setSurfaces();
  SurfaceAt surfaceAt(std::size_t w, const StepInputs &in);
  SurfaceStepView<P> surfaceStep(const StepView<P> &v, std::size_t w, const StepInputs &in);
  void launchSurface(const StepView<P> &v, std::size_t w, const StepInputs &in, Start start);
  template <class Law>
  void launchSurfaceWith(const SurfaceStepView<P> &step, Start start);
  void markNearSurfaces(const StepView<P> &v, const StepInputs &in);
  void sumSurfaces(const StepView<P> &v, const StepInputs &in);
  void makeRoomForTouches(std::size_t w, SurfaceStepView<P> &step);
  void collectTouches(std::size_t w);
  RegionStep<P> regionStep(const StepView<P> &v, std::size_t w, const StepInputs &in);
  void markNearRegions();
  void requireRows(const char *what) const;
  void checkStatus(const Status &status, std::int64_t step);
  void throwBroken(std::uint32_t particle, std::int64_t step);
  void throwCrowded(std::uint32_t particle, std::int64_t step);
  void throwCrossed(std::uint32_t particle, std::int64_t step);
  void collectObservables(const Recording &record);

  void extractSprings();
  void sortStore();
  SizeRange adoptSizes(const HostParticles &host);
  void importShape(const HostParticles &host);
  void requireRoom(const Box &box) const;
  void adaptSkin(const Box &box);
  void reframe(const Frame &frame);
  void rebuildIn(const CellGrid &fresh);
  void permuteWall(std::size_t w);
  void buildTable();
  void setAnchors();
  VelocityRange velocities();
  void exchangeGrains();
  template <class T>
  void extend(Array<T> &a);
  void followGhosts(const PositionArrays<P> &grains);
  void stepAndFollowGhosts(const StepView<P> &v);
  void finishGhosts(const PositionArrays<P> &grains);
  Vec3<double> periods() const;
  template <class T>
  void permute(Array<T> &a, Array<T> &scratch);
  template <class T>
  const T *stageIn(const T *host, std::size_t count);
  template <class T>
  T *stageOut(std::size_t count);

  Exec exec_;
  Precision precision_;
  int warps_;  ///< as in EngineOptions
  SceneSpec scene_;
  HistoryLayout layout_;  ///< of what a contact keeps
  bool keepsContacts_ = false;
  double pullOffGap_ = 0.0;  ///< largest gap across which grains pull on each other (distance)
  int commonModel_[modelSlots] = {};
  ModelNeeds needs_{};
  Roles roles_;
  Box box_;
  CellGrid grid_{};                 ///< cells that tell where a grain is
  std::vector<float> levelRadii_;   ///< largest radius of each level
  LevelGrid levels_{};              ///< cells to search in; grid_ where there is one level
  Frame frame_{};
  AnchorRule anchorRule_{};
  std::uint32_t count_ = 0;   ///< grains of this rank
  std::uint32_t ghosts_ = 0;  ///< grains of others, behind them
  GhostLayer<Exec, P> layer_;
  Home home_;
  Start contactsStart_ = Start::InTurn;  ///< Early: walls that are launches of their own may still be at work
  const UnitList *part_ = nullptr;  ///< units that the launch at hand is for, null: all
  bool stopAgreed_ = false, rebuildAgreed_ = false;  ///< alarms of any rank
  float longestAgreed2_ = 0.0f;                      ///< longest squared step of any rank (distance^2)

  int posNow_ = 0, motNow_ = 0;  ///< which of the two buffers holds the current state
  int queued_ = 0;
  InnerList inner_;  ///< GPU only
  CommonDrift drift_;
  double skin_ = 0.0;     ///< of the rows
  bool wornOut_ = false;  ///< the rows were given up because grains had moved, not for something else
  std::vector<std::int64_t> queuedSteps_;
  bool rowsValid_ = false, forceValid_ = false, storeFresh_ = false;
  NeighborReport report_;
  Observables observables_;

  Array<CoarsePosition> coarse_[2] = {Array<CoarsePosition>("positions"), Array<CoarsePosition>("positions (2)")};
  Array<FinePosition> fine_[2] = {Array<FinePosition>("fine positions"), Array<FinePosition>("fine positions (2)")};
  Array<Motion<Real>> motion_[2] = {Array<Motion<Real>>("velocities"), Array<Motion<Real>>("velocities (2)")};
  Array<int> type_{"types"}, image_{"image flags"}, intScratch_{"scratch"};
  Array<std::int32_t> tag_{"atom-IDs"};
  Array<std::uint32_t> mask_{"group bits"}, hostIndex_{"host indices"}, cell_{"cells of the grains"}, key_{"cell keys"},
      order_{"sorting permutation"}, anchor_{"anchors"}, uintScratch_{"scratch (2)"};
  Array<Vec3<Real>> force_{"forces"}, torque_{"torques"}, vecScratch_{"scratch (3)"};
  Array<Vec3<double>> origin_{"original positions"}, originScratch_{"original positions (2)"};
  Array<std::uint32_t> searchCell_{"cells of the levels"};
  CellTable<Exec> cells_, ghostCells_;
  CrossLevels<Exec, P> cross_;
  Array<std::uint32_t> storeOffset_{"stored contacts"};
  Array<std::int32_t> storePartner_{"partners of stored contacts"};
  Array<Real> storeSpring_{"stored springs"};
  StoreSorter<Exec, Real> storeSorter_;
  Array<Real> virial_{"virials"};
  Array<std::uint8_t> typeTable_{"type exclusions"};
  Array<unsigned char> staging_{"staging"};
  Array<Status> status_{"status"};
  Array<ModelCoefficients<Real>> models_{"contact laws"};  ///< of the type pairs, then of the walls
  std::vector<ModelCoefficients<Real>> wallModels_;        ///< of the walls, here
  std::vector<int> wallSize_;                              ///< numbers kept per grain and wall
  std::vector<int> wallPlace_;                             ///< of planes and cylinders in a launch, -1 for regions
  std::vector<std::uint8_t> wallSweeps_;                   ///< a region that changes its place
  std::vector<Array<RegionShape>> regionShapes_;           ///< per wall, empty for planes and cylinders
  std::vector<SurfaceWall> surfaces_;                      ///< per wall
  std::vector<SurfaceReport> surfaceReports_;              ///< not yet handed out
  std::vector<Array<Vec3<Real>>> regionLoad_;              ///< [n] forces, [n] torques of a region or surface
  std::vector<Array<Vec3<Real>>> termBefore_;
  std::vector<Array<Real>> wallHistory_, wallContacts_, drag_;
  Array<Real> blockScratch_{"scratch (4)"};
  std::conditional_t<Exec::onGpu, RowTable<Exec, P>, PairTable<Exec, P>> table_;
};

}  // namespace gpudem

#include "engine/engine_ghosts.inl.hpp"
#include "engine/engine_neighbors.inl.hpp"
#include "engine/engine_regions.inl.hpp"
#include "engine/engine_steps.inl.hpp"
#include "engine/engine_surfaces.inl.hpp"
#include "engine/engine_transfer.inl.hpp"
