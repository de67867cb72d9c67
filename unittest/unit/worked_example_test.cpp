// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file The sub-model that CONTRIBUTING.md shows compiles, works in a product, and stands there word for word.
#include "unit/power_normal.hpp"

#include "contact/product.hpp"
#include "testing/tolerance.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace gpudem {
namespace {

std::string textOf(const std::string &path)
{
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(WorkedExample, WorksInAProduct)
{
  using Law = Product<PowerNormal, RestitutionDamping, NoTangential, NoRolling, NoTwisting>;
  ModelCoefficients<double> k{};
  const double parameters[] = {1000.0, 1.0, 2.0};
  PowerNormal::derive(parameters, k.normal);
  Contact<double> c{};
  c.branch = {0.0, 0.0, 0.9};
  c.distance = 0.9;
  c.inverseDistance = 1.0 / 0.9;
  c.overlap = 0.1;
  c.effectiveRadius = 0.25;
  c.effectiveMass = 1.0;
  ModelHistory<double> kept{};
  const ContactForce<double> f = Law::evaluate(k, c, kept, 1e-3, true);
  EXPECT_TRUE(testing::near(f.force.z, 1000.0 * 0.25 * 0.4 * 0.4, testing::roundOff(Precision::Double, 40.0)));
  EXPECT_EQ(f.force.x, 0.0);
}

TEST(WorkedExample, StandsInContributing)
{
  const std::string source = textOf(GPUDEM_SOURCE_DIR "/unittest/unit/power_normal.hpp");
  const std::string begin = "// example-begin\n", end = "// example-end";
  const std::size_t from = source.find(begin) + begin.size(), to = source.find(end);
  ASSERT_LT(from, to);
  const std::string example = source.substr(from, to - from);
  EXPECT_NE(textOf(GPUDEM_SOURCE_DIR "/CONTRIBUTING.md").find(example), std::string::npos)
      << "CONTRIBUTING.md must show this, word for word:\n"
      << example;
}

}  // namespace
}  // namespace gpudem
