// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The plan of measurements of the inner list, and the frame of the common motion.

#include "neighbor/common_drift.hpp"
#include "neighbor/inner_list.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace gpudem;

namespace {

TEST(InnerListTest, AllowsNoMoreDriftThanItsMarksBear)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-5.0, -1.0);
  for (int n = 0; n < 1000; ++n) {
    const double skin = std::pow(10.0, exponent(random)), resolution = 1e-9;
    InnerList list;
    list.setSkin(skin, resolution);
    EXPECT_TRUE(list.due()) << "nothing was measured yet";
    const double step = skin * std::pow(10.0, exponent(random));
    list.plan(static_cast<float>(step * step));
    EXPECT_TRUE(list.due()) << "a new plan begins with a measurement";
    list.measured();
    int drifts = 0;
    for (; !list.due() && drifts < 1000; ++drifts) list.drifted();
    ASSERT_LE(drifts, 33);
    const double longest = std::sqrt(static_cast<double>(list.stepLimit2()));
    if (drifts > 1) {
      EXPECT_GT(longest, step) << "steps of the length that was planned for must not stop the queue";
      EXPECT_LE((drifts - 1) * (longest + resolution), 0.5 * static_cast<double>(list.skin()) * (1 + 1e-6));
    }
  }
}

TEST(InnerListTest, KeepsItsPlanWhenStepsChangeLittle)
{
  InnerList list;
  list.setSkin(1.0, 0.0);
  list.plan(1e-4f);
  list.measured();
  list.plan(0.95e-4f);
  EXPECT_FALSE(list.due());
  list.plan(4e-4f);
  EXPECT_TRUE(list.due()) << "longer steps need a new plan at once";
  list.measured();
  list.plan(0.0f);
  EXPECT_FALSE(list.due()) << "no step was seen";
}

TEST(CommonDriftTest, FollowsTheMiddleOfTheVelocities)
{
  CommonDrift drift;
  drift.start({{8.0f, -1.0f, 0.0f}, {12.0f, 1.0f, 0.0f}}, 1e-3, 0.1, 0.2);
  EXPECT_DOUBLE_EQ(drift.perStep().x, 1e-2);
  EXPECT_DOUBLE_EQ(drift.perStep().y, 0.0);
  EXPECT_GT(drift.room(), 0.0);
  int steps = 0;
  for (; !drift.spent() && steps < 1000; ++steps) drift.drifted(1);
  EXPECT_EQ(steps, static_cast<int>(drift.room() / 1e-2) + 1);
  drift.drifted(-2);
  EXPECT_FALSE(drift.spent());
}

TEST(CommonDriftTest, StaysWhereGrainsMoveAllWays)
{
  CommonDrift drift;
  drift.start({{-5.0f, -5.0f, -5.0f}, {5.1f, 5.0f, 5.0f}}, 1e-3, 0.1, 0.2);
  EXPECT_EQ(drift.room(), 0.0);
  EXPECT_EQ(dot(drift.perStep(), drift.perStep()), 0.0);
  drift.drifted(100000);
  EXPECT_FALSE(drift.spent());
}

}  // namespace
