// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The sub-models there are. A new one is a header and a line here.
#pragma once

#include "contact/cohesion/capillary.hpp"
#include "contact/cohesion/overlap_area.hpp"
#include "contact/cohesion/vdw.hpp"
#include "contact/damping/damping.hpp"
#include "contact/normal/dmt.hpp"
#include "contact/normal/eepa.hpp"
#include "contact/normal/hertz.hpp"
#include "contact/normal/hooke.hpp"
#include "contact/normal/jkr.hpp"
#include "contact/normal/luding.hpp"
#include "contact/normal/thornton_ning.hpp"
#include "contact/rolling/cdt.hpp"
#include "contact/rolling/epsd.hpp"
#include "contact/rolling/sds.hpp"
#include "contact/tangential/liggghts.hpp"
#include "contact/tangential/spring.hpp"
#include "contact/tangential/viscous.hpp"
#include "contact/twisting/twisting.hpp"

namespace gpudem {

template <class... Members>
struct ModelList {
};

using NormalModels = ModelList<HookeNormal, HertzNormal, HertzMaterialNormal, DmtNormal, JkrNormal, LudingNormal,
                               ThorntonNingNormal, EepaNormal, EepaLinearNormal>;
using DampingModels = ModelList<VelocityDamping, MassVelocityDamping, ViscoelasticDamping, RestitutionDamping,
                                TsujiDamping, TsujiFitDamping>;
using TangentialModels = ModelList<NoTangential, ViscousTangential, LinearHistoryTangential, MindlinTangential,
                                   MindlinRescaleTangential, MindlinForceTangential, MindlinRescaleForceTangential,
                                   LiggghtsHistoryTangential, LiggghtsLinearHistoryTangential>;
using RollingModels = ModelList<NoRolling, SdsRolling, CdtRolling, EpsdRolling, Epsd2Rolling, Epsd3Rolling>;
using TwistingModels = ModelList<NoTwisting, SdsTwisting, MarshallTwisting>;
using CohesionModels = ModelList<NoCohesion, SjkrCohesion, Sjkr2Cohesion, CapillaryCohesion, VdwCohesion>;

/// Call visit(member) for every member of the list, in order.
template <class Visit, class... Members>
void forEachModel(ModelList<Members...>, Visit &&visit)
{
  (visit(Members{}), ...);
}

/// visit(member) for the member number \p index.
template <class Result, class Visit, class... Members>
GPUDEM_HD Result selectModel(ModelList<Members...>, int index, Visit &&visit)
{
  Result result{};
  int m = 0;
  ((index == m++ ? (void)(result = visit(Members{})) : (void)0), ...);
  return result;
}

}  // namespace gpudem
