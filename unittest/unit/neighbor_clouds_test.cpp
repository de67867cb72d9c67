// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The neighbour tables of a hundred thousand grains of many sizes against every pair. Takes minutes: label long.

#include "testing/level_search.h"

using namespace gpudem;
using namespace gpudem::testing;

namespace {

constexpr std::size_t grains = 100000;

TEST(NeighborClouds, EveryPairInMixed) { compareClouds<Mixed>(grains, 10000); }
TEST(NeighborClouds, EveryPairInDouble) { compareClouds<Double>(grains, 20000); }

/// Small clouds, many seeds: the cases at the faces of cells and boxes.
TEST(NeighborClouds, ManySeeds)
{
  for (unsigned seed = 0; seed < 60; ++seed) compareClouds<Mixed>(300, 100000 + 1000 * seed);
}

}  // namespace
