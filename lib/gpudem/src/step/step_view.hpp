// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Everything one launch of the step reads and writes: the kernels' only parameter.
#pragma once

#include "base/particle.hpp"
#include "contact/layout.hpp"
#include "contact/spring_dashpot.hpp"
#include "neighbor/cell_grid.hpp"
#include "gpudem/scene.h"

namespace gpudem {

/// Progress and alarms, shared by host and device.
struct Status {
  std::uint32_t lastAllowed;  ///< launches with a larger sequence number do nothing
  std::uint32_t rebuildAfter;  ///< launch after which the rows must be built anew, or noLimit
  std::uint32_t badParticle;  ///< smallest device index with a broken state, noParticle if none
  std::uint32_t longestStep2;  ///< bits of the largest squared displacement in a step seen so far (float, distance^2)
  std::uint32_t crowded;  ///< smallest device index with more contacts to a wall than the wall keeps, or noParticle
  std::uint32_t crossed;  ///< smallest device index whose centre went through a sheet, or noParticle
};
constexpr std::uint32_t noParticle = 0xffffffffu;
constexpr std::uint32_t noLimit = 0xffffffffu;

/// The row of a grain with so many neighbours that 31 others should not be padded to it, nor one lane walk it. Its entries
/// lie together, and teams of warps take a segment each (segment_contacts.hpp).
struct LongRow {
  static constexpr std::uint32_t segmentEntries = 256;

  std::uint32_t grain;
  std::uint32_t count;    ///< entries
  std::uint32_t start;    ///< the first of them
  std::uint32_t word;     ///< of entries 0 .. 31, those of the others follow
  std::uint32_t segment;  ///< the first of its segments

  GPUDEM_HD std::uint32_t segments() const { return (count + segmentEntries - 1) / segmentEntries; }
};

/// Neighbour rows on the GPU, in slices of W = 32 grains: entry k of grain i lies at
/// start[i / W] + k * W + i % W. A row lists each neighbour within the sum of radii plus the skin, on
/// both sides of the pair; grains that touched when the rows were built come first. A grain with a long row has an empty one
/// in its slice.
template <class Real>
struct RowView {
  const std::uint32_t *start;      ///< [slices] first entry of the slice
  const std::uint32_t *maskStart;  ///< [slices+1] first of the slice's words for entries beyond the 32nd of a row
  const std::uint32_t *count;      ///< [n] entries of the row
  std::uint32_t *near;             ///< [words] bit k: entry is within the inner reach
  const std::uint32_t *neighbor;   ///< [entries] device index
  std::uint32_t *touch;            ///< [words] bit k: entry is in contact (laws that keep something only)
  Real *spring;                    ///< [entries][size] what the contact keeps

  const std::uint32_t *longFirst;  ///< [slices+1] first of the long rows of each slice, null if there is none at all
  const LongRow *longRow;          ///< in the order of the grains
  const std::uint32_t *rowOfSegment;  ///< [segments] which long row
  Real *segmentLoad;                  ///< [segments][forces, torques, virial] sums over the contacts of each segment

  /// Number of words that each row of a slice has.
  GPUDEM_HD std::uint32_t words(std::uint32_t slice, std::uint32_t W) const
  {
    return 1 + (maskStart[slice + 1] - maskStart[slice]) / W;
  }
  /// Where the word for entries 32 w .. 32 w + 31 of row \p i lies. The first words of all rows lie together, where they
  /// are found without asking for the slice.
  GPUDEM_HD std::uint32_t wordOf(std::uint32_t i, std::uint32_t w, std::uint32_t W) const
  {
    return w == 0 ? i : maskStart[i / W] + (w - 1) * W + i % W;
  }
};

/// Displacement since the rows were built, from 10 bits per coordinate of the position at that time.
struct AnchorRule {
  int shiftX, shiftY, shiftZ;  ///< the bits kept are [shift, shift + 10) of the coarse coordinate
  float limit2;                ///< squared displacement that is still safe (distance^2)
  float stepLimit2;            ///< squared displacement of one step that is still safe (distance^2)
  float lost2;                 ///< squared displacement of one step beyond which the state is broken
};
constexpr std::uint32_t nearWallBit = 1u << 30;
constexpr std::uint32_t nearRegionBit = 1u << 31;

/// Which wall code a kernel holds.
enum class WallUse {
  None,
  Classic,  ///< laws of the gran/ styles
  Same,     ///< the product of sub-models that the pairs have
  Any,      ///< all of these
};

/// State of a wall at the step being evaluated.
template <class Real>
struct WallView {
  LawCoefficients<Real> law;
  NormalModel normal;
  TangentialModel tangential;
  const ModelCoefficients<Real> *model;  ///< product law, null: the law above
  LayoutView layout;                     ///< of what the product law keeps
  int flag;                              ///< 1: the numbers kept begin with the flag of adhesion
  int historySize;                       ///< numbers kept per grain
  WallShape shape;
  int axis;
  double lo, hi, radius;   ///< current positions (distance)
  Vec3<double> velocity;   ///< of the surface (distance/time)
  double tangentialSpeed;  ///< of a turning cylinder (distance/time)
  std::uint32_t role;      ///< bits of Motion::word
  Real *history;           ///< [n][historySize], null if nothing is kept
  Real *contacts;          ///< [8][n], null unless recorded
};

template <class Real>
struct TermView {
  ForceTermKind kind;
  std::uint32_t role;  ///< bits of Motion::word
  Vec3<Real> value;
  int prescribed;  ///< bits 0..2: components set
  int wall;        ///< index into StepView::wall
  const Real *dragPerType;
  const Vec3<Real> *load;  ///< RegionWall: [n] forces, [n] torques, valid where nearRegionBit is set
  Vec3<Real> *before;      ///< [n] force before the term, null unless recorded
};

/// One integrator at the step being finished and the one being begun.
struct IntegratorView {
  IntegratorKind kind;
  std::uint32_t role;                     ///< bits of Motion::word
  double halfKickPerInertia;              ///< dt/2 over the inertia factor
  int prescribed;                         ///< bits 0..2
  Vec3<double> displacement;              ///< Prescribed: from the origin at the coming step (distance)
  Vec3<double> velocity;                  ///< Prescribed: at the coming step (distance/time)
  Vec3<double> point, axis;               ///< Rotate
  double cosine, sine, angularFrequency;  ///< Rotate, at the coming step
};

/// What some product law of the pairs asks for; otherwise it is not computed.
struct ModelNeeds {
  bool inertia;      ///< Contact::inertia
  bool slipLever;    ///< the arm of the slip velocity is shortened
  bool beforeTouch;  ///< grains act on each other before they touch
};

template <class P>
struct StepView {
  using Real = typename P::Real;

  std::uint32_t count;
  std::uint32_t sequence;  ///< number of this launch since the last flush
  std::uint32_t step;      ///< of the force (low bits): seed of unbiased rounding
  Status *status;

  PositionArrays<P> in, out;
  const Motion<Real> *motionIn;
  Motion<Real> *motionOut;

  RowView<Real> rows;           ///< on the GPU; the CPU has chunks of pairs
  const std::uint32_t *anchor;  ///< [n] quantised position at the last rebuild and the near-wall bits
  AnchorRule anchorRule;
  Frame frame;
  Vec3<float> twiceFineUnit;  ///< 2 window/2^40, 0 if coordinates have no lower bits (mixed)
  Vec3<float> coarseUnit;     ///< window/2^32
  Vec3<Real> perUnit;         ///< stored fixed-point units per distance
  float reachSlack;           ///< added to a sum of radii so that the coarse test misses no contact

  std::uint32_t driftX, driftY, driftZ;  ///< of all grains since the last rebuild, after this step (coarse units)
  Vec3<float> stepDrift;                 ///< of all grains in a step (distance)

  bool wallsApart;        ///< some walls are launches of their own, which this one may overtake
  bool refresh;           ///< GPU: measure the distances of all entries and mark those within the inner reach
  float innerSkin;        ///< inner reach less contact (distance), see InnerList
  float innerStepLimit2;  ///< squared displacement of a step that the inner list allows for (distance^2)

  double touchMargin;  ///< twice the resolution of a distance: less overlap is no contact (distance)

  LawCoefficients<Real> law;
  const ModelCoefficients<Real> *models;  ///< [types][types] product laws, or null
  int commonModel[modelSlots];            ///< sub-model that all type pairs use, -1 if they differ
  ModelNeeds needs;
  LayoutView layout;         ///< of what a contact keeps
  bool keeps;                ///< the table remembers which pairs are in contact
  int types;                 ///< 1 if all types have the same law
  std::uint32_t frozenRole;  ///< bits of Motion::word
  Real dt;
  double halfKick;
  bool advanceSprings;

  int terms, integrators;
  TermView<Real> term[maxTerms];
  WallView<Real> wall[maxWalls];
  IntegratorView integrator[maxIntegrators];

  const std::uint32_t *cell;  ///< [n] cell at the last rebuild
  CellGrid grid;
  const int *type;             ///< [n]
  const Vec3<double> *origin;  ///< [n] original positions of prescribed motion

  Vec3<Real> *force, *torque;  ///< [n] written at events, read by the split kernels
  Real *virial;                ///< [6][n] or null
  bool finish;                 ///< event: apply the second half kick
};

}  // namespace gpudem
