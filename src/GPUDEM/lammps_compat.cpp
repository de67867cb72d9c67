// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "lammps_compat.h"

#include "lammps_expose.h"

#include "fix_balance.h"
#include "pair_granular.h"
#include "pair_hybrid.h"

using namespace LAMMPS_NS;

namespace {
GPUDEM_EXPOSE(ThermoComputeCount, Thermo, int, ncompute);
GPUDEM_EXPOSE(ThermoComputes, Thermo, Compute **, computes);
GPUDEM_EXPOSE(ThermoFixCount, Thermo, int, nfix);
GPUDEM_EXPOSE(ThermoFixes, Thermo, Fix **, fixes);
GPUDEM_EXPOSE(ThermoVariableCount, Thermo, int, nvariable);
GPUDEM_EXPOSE(ThermoVariables, Thermo, char **, id_variable);
GPUDEM_EXPOSE(VariableData, Variable, char ***, data);
GPUDEM_EXPOSE(FixBalanceWeighs, FixBalance, int, wtflag);
GPUDEM_EXPOSE(GranularNormalModel, PairGranular, int **, normal_model);
GPUDEM_EXPOSE(GranularDampingModel, PairGranular, int **, damping_model);
GPUDEM_EXPOSE(GranularTangentialModel, PairGranular, int **, tangential_model);
GPUDEM_EXPOSE(GranularRollModel, PairGranular, int **, roll_model);
GPUDEM_EXPOSE(GranularTwistModel, PairGranular, int **, twist_model);
GPUDEM_EXPOSE(GranularLimitDamping, PairGranular, int **, limit_damping);
GPUDEM_EXPOSE(GranularYoung, PairGranular, double **, Emod);
GPUDEM_EXPOSE(GranularPoisson, PairGranular, double **, poiss);
GPUDEM_EXPOSE(GranularNormal, PairGranular, double ***, normal_coeffs);
GPUDEM_EXPOSE(GranularTangential, PairGranular, double ***, tangential_coeffs);
GPUDEM_EXPOSE(GranularRoll, PairGranular, double ***, roll_coeffs);
GPUDEM_EXPOSE(GranularTwist, PairGranular, double ***, twist_coeffs);
GPUDEM_EXPOSE(GranularCutoff, PairGranular, double **, cutoff_type);
GPUDEM_EXPOSE(GranularNormalHistory, PairGranular, int, normal_history);
GPUDEM_EXPOSE(GranularTangentialHistory, PairGranular, int, tangential_history);
GPUDEM_EXPOSE(GranularRollHistory, PairGranular, int, roll_history);
GPUDEM_EXPOSE(GranularTwistHistory, PairGranular, int, twist_history);
GPUDEM_EXPOSE(HybridCount, PairHybrid, int, nstyles);
GPUDEM_EXPOSE(HybridStyles, PairHybrid, Pair **, styles);
GPUDEM_EXPOSE(HybridNames, PairHybrid, char **, keywords);
}  // namespace

GpudemCompat::ThermoInputs GpudemCompat::thermoInputs(Thermo *thermo)
{
  ThermoInputs in;
  for (int k = 0; k < thermo->*reach(ThermoComputeCount{}); ++k)
    in.computes.push_back((thermo->*reach(ThermoComputes{}))[k]);
  for (int k = 0; k < thermo->*reach(ThermoFixCount{}); ++k) in.fixes.push_back((thermo->*reach(ThermoFixes{}))[k]);
  for (int k = 0; k < thermo->*reach(ThermoVariableCount{}); ++k)
    in.variables.emplace_back((thermo->*reach(ThermoVariables{}))[k]);
  return in;
}

std::string GpudemCompat::equalFormula(Variable *variable, int index)
{
  if (!variable->equalstyle(index) || variable->internalstyle(index)) return "";
  char **data = (variable->*reach(VariableData{}))[index];
  return data && data[0] ? data[0] : "";
}

GpudemCompat::GranularTables GpudemCompat::granularTables(PairGranular *pair)
{
  return {pair->*reach(GranularNormalModel{}),
          pair->*reach(GranularDampingModel{}),
          pair->*reach(GranularTangentialModel{}),
          pair->*reach(GranularRollModel{}),
          pair->*reach(GranularTwistModel{}),
          pair->*reach(GranularLimitDamping{}),
          pair->*reach(GranularYoung{}),
          pair->*reach(GranularPoisson{}),
          pair->*reach(GranularNormal{}),
          pair->*reach(GranularTangential{}),
          pair->*reach(GranularRoll{}),
          pair->*reach(GranularTwist{}),
          pair->*reach(GranularCutoff{})};
}

void GpudemCompat::setGranularHistory(PairGranular *pair, bool tangential, bool roll, bool twist)
{
  pair->*reach(GranularNormalHistory{}) = 0;
  pair->*reach(GranularTangentialHistory{}) = tangential;
  pair->*reach(GranularRollHistory{}) = roll;
  pair->*reach(GranularTwistHistory{}) = twist;
}

bool GpudemCompat::weighs(const Fix *fix)
{
  const auto *balance = dynamic_cast<const FixBalance *>(fix);
  return balance && balance->*reach(FixBalanceWeighs{}) != 0;
}

Pair *GpudemCompat::soleSubStyle(PairHybrid *hybrid, int types)
{
  if (hybrid->*reach(HybridCount{}) != 1) return nullptr;
  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j)
      if (!hybrid->check_ijtype(i, j, (hybrid->*reach(HybridNames{}))[0])) return nullptr;
  return (hybrid->*reach(HybridStyles{}))[0];
}
