// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "engine/make_engine.hpp"

#include "contact/scene_laws.hpp"
#include "step/roles.hpp"

namespace gpudem {

#ifdef GPUDEM_HAVE_CUDA
int gpuCount()
{
  std::string problem;
  return countGpus(problem);
}
std::string gpuProblem()
{
  std::string problem;
  countGpus(problem);
  return problem;
}
#else
int gpuCount()
{
  return 0;
}
std::string gpuProblem()
{
  return "this build has no CUDA backend";
}
#endif

HistoryLayout pairHistoryLayout(const SceneSpec &scene)
{
  return pairLayout(scene);
}

bool keepsContacts(const SceneSpec &scene)
{
  return pairLayout(scene).size > 0 || pairsReachBeyond(scene);
}

int wallHistorySize(const WallSpec &wall)
{
  return wallKeeps(wall);
}

int coordinateBits(const SceneSpec &scene, Precision precision)
{
  if (precision == Precision::Double) return 64;
  return rolesOf(scene).fineMask() ? 40 : 32;
}

std::unique_ptr<Engine> makeEngine(const EngineOptions &options)
{
  if (options.device == DeviceKind::Cpu) return makeCpuEngine(options);
#ifdef GPUDEM_HAVE_CUDA
  std::string problem;
  const int gpus = countGpus(problem);
  if (options.gpu < 0 || options.gpu >= gpus)
    throw Error("GPU " + std::to_string(options.gpu) + " was asked for, but " +
                (gpus ? "only " + std::to_string(gpus) + " are present" : "there is none: " + problem));
  return makeGpuEngine(options);
#else
  throw Error("a GPU was asked for, but " + gpuProblem());
#endif
}

}  // namespace gpudem
