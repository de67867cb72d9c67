// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file EngineImpl: launching steps and collecting what events record.
#pragma once

#include "engine/engine_impl.hpp"

namespace gpudem {

template <class Exec, class P>
void EngineImpl<Exec, P>::resetStatus()
{
  const Status fresh{noLimit, noLimit, noParticle, 0u, noParticle, noParticle};
  exec_.copyIn(status_.data(), &fresh, 1);
  stopAgreed_ = rebuildAgreed_ = false;
  longestAgreed2_ = 0.0f;
}

template <class Exec, class P>
void EngineImpl<Exec, P>::setScene(const SceneSpec &scene)
{
  const auto plain = std::count_if(scene.walls.begin(), scene.walls.end(),
                                   [](const WallSpec &wall) { return !isApart(wall); });
  if (plain > maxWalls) throw Error(fmt::format("{} planes and cylinders as walls, at most {}", plain, maxWalls));
  if (scene.walls.size() > maxTerms)
    throw Error(fmt::format("{} walls, but at most {} force terms", scene.walls.size(), maxTerms));
  if (scene.terms.size() > maxTerms)
    throw Error(fmt::format("{} force terms, at most {}", scene.terms.size(), maxTerms));
  if (scene.integrators.size() > maxIntegrators)
    throw Error(fmt::format("{} integrators, at most {}", scene.integrators.size(), maxIntegrators));
  if (scene.exclusions.groups.size() > maxGroupExclusions)
    throw Error(fmt::format("{} group exclusions, at most {}", scene.exclusions.groups.size(), maxGroupExclusions));
  scene_ = scene;
  skin_ = scene.skin;
  rowsValid_ = wornOut_ = false;
  setRoles();
  setLaws();

  wallHistory_.clear();
  wallContacts_.clear();
  wallSize_.clear();
  for (const WallSpec &wall : scene.walls) {
    wallHistory_.emplace_back("springs of a wall");
    wallContacts_.emplace_back("contacts of a wall");
    wallSize_.push_back(wallHistorySize(wall));
  }
  setRegions();
  setSurfaces();
  termBefore_.clear();
  drag_.clear();
  for (const ForceTerm &term : scene.terms) {
    termBefore_.emplace_back("recorded forces");
    drag_.emplace_back("drag per type");
    if (term.kind == ForceTermKind::Viscous) {
      const std::vector<Real> gamma(term.dragPerType.begin(), term.dragPerType.end());
      drag_.back().reserve(gamma.size());
      exec_.copyIn(drag_.back().data(), gamma.data(), gamma.size());
    }
  }
  typeTable_.clear();
  if (!scene.exclusions.types.empty()) {
    const int n = scene.types + 1;
    std::vector<std::uint8_t> table(static_cast<std::size_t>(n) * n, 0);
    for (const auto &[a, b] : scene.exclusions.types) table[a * n + b] = table[b * n + a] = 1;
    typeTable_.reserve(table.size());
    exec_.copyIn(typeTable_.data(), table.data(), table.size());
  }
}

/// Coefficients of all product laws, and what follows from the laws for rows and reach.
template <class Exec, class P>
void EngineImpl<Exec, P>::setLaws()
{
  const std::size_t pairs = scene_.pairModels.size(), types = static_cast<std::size_t>(scene_.types);
  if (pairs != 0 && pairs != types * types)
    throw Error(
        fmt::format("{} contact laws were given for {} types; one per ordered pair of types is needed", pairs, types));
  layout_ = pairLayout(scene_);
  keepsContacts_ = keepsContacts(scene_);
  pullOffGap_ = largestPullOffGap(scene_);
  std::vector<ModelCoefficients<Real>> table;
  for (const ContactModel &model : scene_.pairModels) table.push_back(coefficients<Real>(model));
  for (int s = 0; s < modelSlots; ++s) {
    commonModel_[s] = pairs ? table[0].model[s] : -1;
    for (const ModelCoefficients<Real> &k : table)
      if (k.model[s] != commonModel_[s]) commonModel_[s] = -1;
  }
  needs_ = {};
  for (const ModelCoefficients<Real> &k : table) {
    needs_.inertia = needs_.inertia || k.readsInertia;
    needs_.slipLever = needs_.slipLever || k.slipLever != Real(0);
    needs_.beforeTouch = needs_.beforeTouch || k.beforeTouch;
  }
  wallModels_.clear();
  for (const WallSpec &wall : scene_.walls)
    wallModels_.push_back(wall.model ? coefficients<Real>(*wall.model) : ModelCoefficients<Real>{});
  table.insert(table.end(), wallModels_.begin(), wallModels_.end());
  models_.reserve(std::max<std::size_t>(1, table.size()));
  exec_.copyIn(models_.data(), table.data(), table.size());
}

/// State of wall \p w at \p step with the arrays it writes to.
template <class Exec, class P>
auto EngineImpl<Exec, P>::wallView(std::size_t w, std::int64_t step) -> WallView<Real>
{
  const WallSpec &spec = scene_.walls[w];
  WallView<Real> wall = wallAt<Real>(spec, roles_, step, scene_.timestep);
  if (spec.model) {
    wall.model = models_.data() + scene_.pairModels.size() + w;
    wall.layout = layoutView(wallLayout(spec));
    wall.flag = wallFlag(spec);
  }
  wall.historySize = wallSize_[w];
  wall.history = wallSize_[w] ? wallHistory_[w].data() : nullptr;
  return wall;
}

/// Planes and cylinders, which the kernels of the contacts hold.
template <class Exec, class P>
void EngineImpl<Exec, P>::attachWalls(WallView<Real> *wall, std::int64_t step)
{
  for (std::size_t w = 0; w < scene_.walls.size(); ++w)
    if (!isApart(scene_.walls[w])) wall[wallPlace_[w]] = wallView(w, step);
}

/// Give the grains the roles of the scene; a position keeps its lower bits if there is still room for them.
template <class Exec, class P>
void EngineImpl<Exec, P>::setRoles()
{
  const std::uint32_t before = roles_.fineMask();
  roles_ = rolesOf(scene_);
  const std::uint32_t keep = before && roles_.fineMask() ? ~0xffu : 0u;
  if (count_) exec_.forEach(count_, SetRoles<Real>{roles_, keep, mask_.data(), motion_[motNow_].data()});
}

template <class Exec, class P>
StepView<P> EngineImpl<Exec, P>::view(const StepInputs &in, std::int64_t coming)
{
  StepView<P> v{};
  v.count = count_;
  v.step = static_cast<std::uint32_t>(in.step);
  v.status = status_.data();
  v.in = v.out = positions();
  v.motionIn = v.motionOut = motion_[motNow_].data();
  if constexpr (Exec::onGpu) v.rows = table_.view();
  v.anchor = anchor_.data();
  v.anchorRule = anchorRule_;
  v.frame = frame_;
  v.twiceFineUnit = (frame_.unit32 * (roles_.fineMask() ? 2.0 / 256.0 : 0.0)).template as<float>();
  v.coarseUnit = frame_.unit32.template as<float>();
  const double units = std::ldexp(1.0, P::fine ? 64 : 40);
  v.perUnit = (frame_.inverse * units).template as<Real>();
  v.reachSlack = reachSlackOf(frame_) + static_cast<float>(pullOffGap_);
  v.driftX = coarseUnits(drift_.next().x, frame_.unit32.x);
  v.driftY = coarseUnits(drift_.next().y, frame_.unit32.y);
  v.driftZ = coarseUnits(drift_.next().z, frame_.unit32.z);
  v.stepDrift = drift_.perStep().template as<float>();
  v.wallsApart = std::any_of(scene_.walls.begin(), scene_.walls.end(), isApart);
  v.refresh = true;
  v.innerSkin = inner_.skin();
  v.innerStepLimit2 = inner_.stepLimit2();
  const double widest = std::max(frame_.window.x, std::max(frame_.window.y, frame_.window.z));
  // two coordinates rounded to the unit (mixed), or to the 53 bits of the host's doubles
  v.touchMargin = 2.0 * std::ldexp(widest, P::fine ? -50 : roles_.fineMask() ? -39 : -31);
  v.law = coefficients<Real>(scene_.pair);
  v.models = models_.data();
  v.layout = layoutView(layout_);
  v.keeps = keepsContacts_;
  v.types = scene_.types;
  std::copy_n(commonModel_, modelSlots, v.commonModel);
  v.needs = needs_;
  v.frozenRole = roles_.of(scene_.frozenMask);
  v.dt = static_cast<Real>(scene_.timestep);
  v.halfKick = scene_.halfKick;
  v.advanceSprings = true;
  v.terms = static_cast<int>(scene_.terms.size());
  for (int k = 0; k < v.terms; ++k) {
    const ForceTerm &t = scene_.terms[k];
    const bool moving = k < static_cast<int>(in.termValue.size());
    TermView<Real> &o = v.term[k];
    o.kind = t.kind;
    o.role = roles_.of(t.groupMask);
    o.value = toVec3(moving ? in.termValue[k] : t.value).as<Real>();
    o.prescribed = componentBits(t.prescribed);
    if (t.kind == ForceTermKind::Wall) o.wall = wallPlace_[t.wall];
    if (t.kind == ForceTermKind::RegionWall) o.load = regionLoad_[t.wall].data();
    o.dragPerType = drag_[k].data();
    o.before = nullptr;
  }
  attachWalls(v.wall, in.step);
  v.integrators = static_cast<int>(scene_.integrators.size());
  for (int k = 0; k < v.integrators; ++k)
    v.integrator[k] = integratorAt(scene_.integrators[k], roles_, coming, scene_.timestep, scene_.halfKick);
  v.cell = cell_.data();
  v.grid = grid_;
  v.type = type_.data();
  v.origin = origin_.data();
  v.force = force_.data();
  v.torque = torque_.data();
  return v;
}

/// How many warps take 32 grains together: a chip that is nearly empty waits for the longest chain of instructions. More
/// than two warps on each scheduler lose more by waiting for one another than they gain (doc/performance.md).
template <class Exec, class P>
int EngineImpl<Exec, P>::warpsPerSlice(std::uint32_t slices) const
{
  if (warps_) return warps_;
  if constexpr (Exec::onGpu) return mostTeam * slices <= exec_.fewWarps() ? mostTeam : 1;
  return 1;
}

/// Ahead of the contacts of the slices, which may begin meanwhile. Parts of a step share one launch: the first brings it.
template <class Exec, class P>
template <class Law, StepMode mode>
void EngineImpl<Exec, P>::launchLongRows(const StepView<P> &v)
{
  if constexpr (Exec::onGpu) {
    if (table_.segments() == 0) return;
    const bool first = !part_ || part_->unit == layer_.border().unit;
    if (first) exec_.forEachTeam(table_.segments(), SegmentContacts<P, Law, mode>{{v}}, contactsStart_);
    contactsStart_ = first ? Start::Early : Start::InTurn;
  }
}

template <class Exec, class P>
template <class Law, StepMode mode, WallUse walls>
void EngineImpl<Exec, P>::launchLawAndWalls(const StepView<P> &v)
{
  if constexpr (Exec::onGpu) {
    const std::uint32_t *slice = part_ ? part_->unit : nullptr, slices = part_ ? part_->count : chunksOf(count_, 32);
    if constexpr (mode == StepMode::Fused) {
      if (warpsPerSlice(slices) == mostTeam)
        return exec_.forEachTeam(slices, TeamContacts<P, Law, walls, mostTeam>{{v}, slice}, contactsStart_);
    }
    using Kernel = WarpContacts<P, Law, mode, walls>;
    exec_.forEachWarp(part_ ? 32 * slices : count_, Kernel{{v}, slice}, contactsStart_);
  } else {
    using Kernel = ContactChunk<P, Law, mode, walls>;
    if (part_) return exec_.forEachChunk(part_->count, OnChunks<Kernel>{Kernel{v, table_.view()}, part_->unit});
    exec_.forEachChunk(chunksOf(count_, grainsPerChunk), Kernel{v, table_.view()});
  }
}

/// Have all planes and cylinders a law that this product evaluates?
template <class Exec, class P>
template <class Product>
bool EngineImpl<Exec, P>::wallsAreServedBy(Product product) const
{
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (isApart(scene_.walls[w])) continue;
    const ModelCoefficients<Real> &k = wallModels_[w];
    if (!scene_.walls[w].model || !servesAll(product, k.model, k.slipLever != Real(0))) return false;
  }
  return true;
}

template <class Exec, class P>
template <class Law, StepMode mode>
void EngineImpl<Exec, P>::launchLaw(const StepView<P> &v)
{
  const auto isPlain = [](const WallSpec &wall) { return !isApart(wall); };
  const auto hasModel = [](const WallSpec &wall) { return !isApart(wall) && wall.model; };
  launchLongRows<Law, mode>(v);
  if (std::none_of(scene_.walls.begin(), scene_.walls.end(), isPlain))
    return launchLawAndWalls<Law, mode, WallUse::None>(v);
  if constexpr (Exec::onGpu && Law::moments && !std::is_same<typename Law::WallProduct, AnyProduct>::value)
    if (wallsAreServedBy(typename Law::WallProduct{})) return launchLawAndWalls<Law, mode, WallUse::Same>(v);
  // a product's kernel is large anyway: it holds all wall code
  if (Law::moments || std::any_of(scene_.walls.begin(), scene_.walls.end(), hasModel))
    return launchLawAndWalls<Law, mode, WallUse::Any>(v);
  if constexpr (!Law::moments) launchLawAndWalls<Law, mode, WallUse::Classic>(v);
}

template <class Exec, class P>
template <StepMode mode>
void EngineImpl<Exec, P>::launchContactsIn(const StepView<P> &v)
{
  using N = NormalModel;
  using T = TangentialModel;
  if (!scene_.pairModels.empty()) {
    if constexpr (Exec::onGpu)
      withKernelProduct(commonModel_, needs_.slipLever,
                        [&](auto product) { launchLaw<ModelLaw<decltype(product)>, mode>(v); });
    else launchLaw<BatchModelLaw, mode>(v);
    return;
  }
  if (scene_.pair.normal == N::Hertz) {
    if (scene_.pair.tangential != T::Spring) throw Error("a Hertz contact without tangential springs is not compiled");
    return launchLaw<ClassicLaw<N::Hertz, T::Spring>, mode>(v);
  }
  switch (scene_.pair.tangential) {
    case T::Spring:
      return launchLaw<ClassicLaw<N::Hooke, T::Spring>, mode>(v);
    case T::Viscous:
      return launchLaw<ClassicLaw<N::Hooke, T::Viscous>, mode>(v);
    case T::None:
      return launchLaw<ClassicLaw<N::Hooke, T::None>, mode>(v);
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::launchRegions(const StepView<P> &v, const StepInputs &in)
{
  markNearSurfaces(v, in);  // the bit that says near is the same for all walls of their own launch
  contactsStart_ = Start::InTurn;
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (!isApart(scene_.walls[w])) continue;
    if (isRegion(w)) exec_.forEach(count_, regionStep(v, w, in), contactsStart_);
    else launchSurface(v, w, in, contactsStart_);
    if ((isRegion(w) ? count_ : surfaces_[w].nearGrains) != 0) contactsStart_ = Start::Early;  // there was a launch
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::requireRows(const char *what) const
{
  if (!rowsValid_) throw Error(fmt::format("{} needs neighbour rows, but a rebuild is due", what));
}

template <class Exec, class P>
void EngineImpl<Exec, P>::runEvent(const StepInputs &in, const Recording &record, bool advance, bool finish)
{
  requireRows("a force evaluation");
  StepView<P> v = view(in, in.step + 1);
  v.motionOut = motion_[1 - motNow_].data();
  v.advanceSprings = advance;
  v.finish = finish;
  if (record.virial) {
    virial_.reserve(6 * static_cast<std::size_t>(count_));
    v.virial = virial_.data();
  }
  for (int k = 0; k < v.terms; ++k) {
    if (!scene_.terms[k].record) continue;
    termBefore_[k].reserve(count_);
    v.term[k].before = termBefore_[k].data();
  }
  for (std::size_t w = 0; w < scene_.walls.size(); ++w) {
    if (!scene_.walls[w].recordContacts) continue;
    wallContacts_[w].reserve(8 * static_cast<std::size_t>(count_));
    exec_.fill(wallContacts_[w].data(), 8 * static_cast<std::size_t>(count_), 0);
    if (!isApart(scene_.walls[w])) v.wall[wallPlace_[w]].contacts = wallContacts_[w].data();
  }
  inner_.measured();
  launchRegions(v, in);
  launchContactsIn<StepMode::Event>(v);
  motNow_ = 1 - motNow_;
  Status s;
  exec_.copyOut(&s, status_.data(), 1);
  checkStatus(s, in.step);
  forceValid_ = true;
  collectObservables(record);
  sumSurfaces(v, in);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::collectObservables(const Recording &record)
{
  observables_.virial.fill(0.0);
  if (record.virial && count_) {
    const Sums<6> s = exec_.reduce(count_, VirialTerms<Real>{count_, virial_.data()}, AddSums{}, Sums<6>{});
    for (int k = 0; k < 6; ++k) observables_.virial[k] = s.value[k];
  }
  observables_.termForce.assign(scene_.terms.size(), Array3{});
  for (std::size_t k = 0; k < scene_.terms.size(); ++k) {
    if (!scene_.terms[k].record || !count_) continue;
    const Sums<3> s = exec_.reduce(count_, ForceTerms<Real>{termBefore_[k].data()}, AddSums{}, Sums<3>{});
    for (int d = 0; d < 3; ++d) observables_.termForce[k][d] = s.value[d];
  }
}

template <class Exec, class P>
void EngineImpl<Exec, P>::checkStatus(const Status &status, std::int64_t step)
{
  if (status.badParticle != noParticle) throwBroken(status.badParticle, step);
  if (status.crowded != noParticle) throwCrowded(status.crowded, step);
  if (status.crossed != noParticle) throwCrossed(status.crossed, step);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::throwBroken(std::uint32_t particle, std::int64_t step)
{
  std::int32_t tag = 0;
  exec_.copyOut(&tag, tag_.data() + particle, 1);
  Motion<Real> m;
  exec_.copyOut(&m, motion_[motNow_].data() + particle, 1);
  resetStatus();
  rowsValid_ = false;
  throw UnstableState(
      fmt::format("atom {} at step {} is not a number or moves more than a cell in one step (velocity {:g} {:g} {:g}): "
                  "the time step is too large for the stiffness, or the input overlaps grains",
                  tag, step, m.vx, m.vy, m.vz));
}

template <class Exec, class P>
void EngineImpl<Exec, P>::evaluateForce(const StepInputs &in, const Recording &record)
{
  runEvent(in, record, false, false);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::forceStep(const StepInputs &in, const Recording &record)
{
  runEvent(in, record, true, false);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::completeStep(const StepInputs &in, const Recording &record)
{
  runEvent(in, record, true, true);
}

template <class Exec, class P>
void EngineImpl<Exec, P>::finishStep(const StepInputs &in)
{
  exec_.forEach(count_, FinishStep<P>{view(in, in.step + 1)});
}

template <class Exec, class P>
void EngineImpl<Exec, P>::beginStep(const StepInputs &next)
{
  if (!forceValid_ && count_) throw Error("a step was begun without a force");
  exec_.forEach(count_, BeginStep<P>{view(next, next.step)});
  inner_.drifted();
  drift_.drifted(1);
  forceValid_ = false;
  queued_ = 0;
  queuedSteps_.assign(1, next.step);
  if (layer_.joined()) followGhosts(positions());
}

template <class Exec, class P>
void EngineImpl<Exec, P>::queueStep(const StepInputs &in)
{
  requireRows("a step");
  if (drift_.spent() || stopAgreed_) return;
  StepView<P> v = view(in, in.step + 1);
  const int from = queued_ & 1;
  v.in = positions(posNow_ ^ from, motNow_ ^ from);
  v.out = positions(posNow_ ^ from ^ 1, motNow_ ^ from ^ 1);
  v.motionIn = motion_[motNow_ ^ from].data();
  v.motionOut = motion_[motNow_ ^ from ^ 1].data();
  v.sequence = static_cast<std::uint32_t>(++queued_);
  v.refresh = inner_.due();
  if (v.refresh) inner_.measured();
  launchRegions(v, in);
  if (layer_.joined()) stepAndFollowGhosts(v);
  else launchContactsIn<StepMode::Fused>(v);
  inner_.drifted();
  drift_.drifted(1);
  queuedSteps_.push_back(in.step);
}

template <class Exec, class P>
Progress EngineImpl<Exec, P>::flush()
{
  Status s;
  exec_.copyOut(&s, status_.data(), 1);
  Progress p;
  const bool joined = layer_.joined();  // no rank queues beyond an alarm of any
  p.needsRebuild = joined ? rebuildAgreed_ : s.rebuildAfter != noLimit;
  const bool stopped = joined ? stopAgreed_ : s.lastAllowed != noLimit;
  const float longestStep2 = joined ? longestAgreed2_ : floatOf(s.longestStep2);
  p.executed = stopped && !joined ? std::min(queued_, static_cast<int>(s.lastAllowed)) : queued_;
  drift_.drifted(p.executed - queued_);
  p.needsRebuild = p.needsRebuild || drift_.spent();
  posNow_ ^= p.executed & 1;
  motNow_ ^= p.executed & 1;
  const std::int64_t reached = queuedSteps_.empty() ? 0 : queuedSteps_[p.executed];
  queued_ = 0;
  queuedSteps_.assign(1, reached);
  checkStatus(s, reached);
  if (p.needsRebuild) {
    rowsValid_ = false;
    wornOut_ = true;
  }
  if (stopped) {
    inner_.forget();
    for (SurfaceWall &s : surfaces_) s.marked = s.marked && !s.markQueued;
    resetStatus();
  }
  for (SurfaceWall &s : surfaces_) s.markQueued = false;
  inner_.plan(longestStep2);
  return p;
}

template <class Exec, class P>
KineticSums EngineImpl<Exec, P>::kineticSums(std::uint32_t groupMask, const Array3 &gravity)
{
  KineticSums k;
  if (!count_) return k;
  const Sums<9> s = exec_.reduce(count_,
                                 KineticTerms<P>{positions(), motion_[motNow_].data(), mask_.data(), cell_.data(),
                                                 grid_, frame_, groupMask, toVec3(gravity)},
                                 AddSums{}, Sums<9>{});
  for (int d = 0; d < 6; ++d) k.momentumFlux[d] = s.value[d];
  k.rotational = s.value[6];
  k.gravity = s.value[7];
  k.count = static_cast<std::int64_t>(s.value[8] + 0.5);
  return k;
}

}  // namespace gpudem
