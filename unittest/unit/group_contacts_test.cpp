// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Lanes that search together find what one finds alone.

#include "surface/group_contacts.hpp"
#include "testing/emulated_warp.h"
#include "testing/meshes.h"

#include <gtest/gtest.h>

#include <random>

namespace gpudem::testing {
namespace {

constexpr std::uint32_t lanes = 4, groups = warpWidth / lanes;

/// A centre with the list made where it was before.
struct Case {
  Vec3<double> x;
  std::uint32_t entry[NearList::most];
  float gap[NearList::most];
  float moved;
  bool wanted;
  NearList list() const { return {entry, gap, 1, moved}; }
};

void expectSame(const SurfaceContacts &found, const SurfaceContacts &expected)
{
  ASSERT_EQ(found.count, expected.count);
  EXPECT_EQ(found.overflow, expected.overflow);
  for (int k = 0; k < found.count; ++k) {
    EXPECT_EQ(found.contact[k].triangle, expected.contact[k].triangle);
    EXPECT_EQ(found.contact[k].feature, expected.contact[k].feature);
    EXPECT_EQ(found.contact[k].distance, expected.contact[k].distance);
    EXPECT_EQ(found.contact[k].weight, expected.contact[k].weight);
    for (int d = 0; d < 3; ++d) EXPECT_EQ(found.contact[k].normal[d], expected.contact[k].normal[d]);
  }
}

}  // namespace

TEST(GroupContacts, AreThoseFoundAlone)
{
  std::mt19937 random(14);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  const double reach = 0.2, margin = 0.05;
  int several = 0, onTree = 0, unwanted = 0;
  for (int shape = 0; shape < 5; ++shape) {
    SurfaceMesh m = shape == 0 ? ball(1.0, 24) : shape == 1 ? tube(1.0, 2.0, 24, 4) : shape == 2 ? cube(1.5, 2) :
                    shape == 3 ? ball(1.0, 96) : cube(1.5, 1);
    tilt(m);
    cleanSurface(m);
    const Surface surface(m, reach + margin, shape == 4 ? SurfaceSide::Inside : SurfaceSide::Both);
    const SurfaceView s = surface.view();
    for (int n = 0; n < 700; ++n) {
      Case cases[groups];
      for (Case &c : cases) {
        const double span = shape == 4 ? 0.85 : 1.5;  // near the corners of the cube
        const Vec3<double> before = tilted({span * even(random), span * even(random), 1.0 + 1.5 * even(random)});
        std::fill(c.gap, c.gap + NearList::most, 0.0f);  // nobody may look behind the end
        std::fill(c.entry, c.entry + NearList::most, 0u);
        listNear(s, before, reach + margin, margin, c.entry, c.gap, 1);
        const Vec3<double> way{even(random), even(random), even(random)};
        c.x = before + way * (0.999 * margin / length(way));
        c.moved = static_cast<float>(length(c.x - before)) * 1.000001f;
        c.wanted = even(random) < 0.9;
      }
      SurfaceContacts found[groups];
      GroupScratch<lanes> scratch[groups];
      runTeam(1, [&] {
        const std::uint32_t g = warpLane() / lanes;
        const NearList list = cases[g].list();
        GroupSearch<lanes>(s, cases[g].x, reach, list, found[g], scratch[g]).find(cases[g].wanted);
      });
      for (std::uint32_t g = 0; g < groups; ++g) {
        SurfaceContacts expected{};
        if (cases[g].wanted) surfaceContacts(s, cases[g].x, reach, expected, cases[g].list());
        expectSame(found[g], expected);
        several += expected.count > 1;
        onTree += cases[g].wanted && !cases[g].list().holdsTriangles();
        unwanted += !cases[g].wanted;
      }
    }
  }
  EXPECT_GT(several, 200);
  EXPECT_GT(onTree, 100);
  EXPECT_GT(unwanted, 100);
}

}  // namespace gpudem::testing
