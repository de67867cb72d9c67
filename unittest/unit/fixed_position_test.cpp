// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
#include "neighbor/layout.hpp"
#include "testing/tolerance.h"

#include <random>
#include <set>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

Frame someFrame(double origin, double window)
{
  Frame f{};
  for (int d = 0; d < 3; ++d) {
    f.origin[d] = origin;
    f.window[d] = window;
    f.inverse[d] = 1.0 / window;
    f.unit32[d] = std::ldexp(window, -32);
    f.unit64[d] = std::ldexp(window, -64);
  }
  return f;
}

/// One grain stored and loaded as precision P does it.
template <class P>
class Stored {
 public:
  Stored(const Frame &f, double x, double y, double z, std::uint32_t fineMask)
  {
    motion.word = 0xa5u;
    arrays = {&coarse, &fine, &motion, fineMask};
    const FixedPosition exact{toFraction(x, f.origin.x, f.inverse.x), toFraction(y, f.origin.y, f.inverse.y),
                              toFraction(z, f.origin.z, f.inverse.z), 0.5};
    storePosition(arrays, 0, exact, motion.word);
  }
  FixedPosition load() const { return loadPosition(arrays, 0); }

  Motion<typename P::Real> motion{};

 private:
  CoarsePosition coarse{};
  FinePosition fine{};
  PositionArrays<P> arrays{};
};

template <class P>
FixedPosition fixed(const Frame &f, double x, double y, double z, std::uint32_t fineMask = 0xffu)
{
  return Stored<P>(f, x, y, z, fineMask).load();
}

/// Separations are right to the resolution, wherever the pair sits, across window borders too.
template <class P>
void expectSeparations(double resolution, std::uint32_t fineMask = 0xffu)
{
  std::mt19937 random(3);
  const Frame f = someFrame(-7.3, 9.1);
  std::uniform_real_distribution<double> near(-2.0, 2.0), where(-1e4, 1e4);
  for (int k = 0; k < 5000; ++k) {
    const double x = where(random), y = where(random), z = where(random);
    const double dx = near(random), dy = near(random), dz = near(random);
    const auto a = fixed<P>(f, x + dx, y + dy, z + dz, fineMask), b = fixed<P>(f, x, y, z, fineMask);
    const Vec3<double> s = separation(a, b, f), opposite = separation(b, a, f);
    ASSERT_NEAR(s.x, (x + dx) - x, resolution);
    ASSERT_NEAR(s.y, (y + dy) - y, resolution);
    ASSERT_NEAR(s.z, (z + dz) - z, resolution);
    ASSERT_EQ(s.x, -opposite.x);
  }
}

TEST(FixedPosition, SeparationIsExactToTheUnit)
{
  expectSeparations<Mixed>(std::ldexp(9.1, -40) + 2e-12);      // plus the round-off of the coordinates themselves
  expectSeparations<Mixed>(std::ldexp(9.1, -32) + 2e-12, 0u);  // more than eight roles
  expectSeparations<Double>(1e-11);  // the round-off of the double coordinates (1e4) themselves
}

TEST(FixedPosition, AbsoluteCoordinateSurvivesTheRoundTrip)
{
  std::mt19937 random(5);
  const Frame f = someFrame(3.0, 8.8);
  std::uniform_real_distribution<double> where(-500, 500), drift(-1.0, 1.0);
  for (int k = 0; k < 5000; ++k) {
    const double x = where(random), centre = x + drift(random);
    const auto p = fixed<Double>(f, x, 0, 0);
    EXPECT_NEAR(toAbsolute(p.x, centre, f.origin.x, f.inverse.x, f.unit64.x), x, 4e-13);
    const auto q = fixed<Mixed>(f, x, 0, 0);
    EXPECT_NEAR(toAbsolute(q.x, centre, f.origin.x, f.inverse.x, f.unit64.x), x, std::ldexp(8.8, -40));
  }
}

TEST(FixedPosition, LowerBitsLeaveTheRolesAlone)
{
  const Frame f = someFrame(0.0, 8.0);
  for (int k = 0; k < 100; ++k) {
    const double x = 0.0801 * k;
    EXPECT_EQ((Stored<Mixed>(f, x, 2 * x, 3 * x, 0xffu).motion.word & 0xffu), 0xa5u);
    EXPECT_EQ((Stored<Mixed>(f, x, 2 * x, 3 * x, 0u).motion.word), 0xa5u);
  }
}

TEST(FixedPosition, RadiusKeepsAllItsBits)
{
  std::mt19937 random(9);
  std::uniform_real_distribution<double> exponent(-20, 20);
  for (int k = 0; k < 5000; ++k) {
    const double r = std::exp2(exponent(random));
    float upper;
    std::uint32_t lower;
    splitRadius(r, upper, lower);
    ASSERT_EQ(joinRadius(upper, lower), r);
    ASSERT_LE(static_cast<double>(upper), r);
  }
}

TEST(Rounding, NearestIntegerOfAnySize)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(0.0, 62.9);
  for (int k = 0; k < 20000; ++k) {
    const double x = std::ldexp(mantissa(random), static_cast<int>(exponent(random)));
    ASSERT_EQ(roundToInt(x), std::llrint(x)) << x;
    const float f = static_cast<float>(std::ldexp(mantissa(random), static_cast<int>(exponent(random) * 0.8)));
    ASSERT_EQ(roundToInt(f), std::llrint(static_cast<double>(f))) << f;
  }
  for (const double x : {0.0, -0.0, 0.5, -0.5, 1.5, 2147483647.5, -2147483648.5, 4294967295.5, -4294967296.5, 0x1p62})
    EXPECT_EQ(roundToInt(x), std::llrint(x)) << x;
}

TEST(CellGrid, IndexAndCoordinatesAreInverse)
{
  Box box;
  box.lo = {0, 0, 0};
  box.hi = {13, 7, 29};
  box.periodic = {true, false, true};
  const CellGrid g = chooseGrid(box, 1.1, 1000);
  std::set<std::uint32_t> seen;
  for (int z = 0; z < g.nz; ++z)
    for (int y = 0; y < g.ny; ++y)
      for (int x = 0; x < g.nx; ++x) {
        const std::uint32_t c = g.index(x, y, z);
        ASSERT_LT(c, g.cells());
        ASSERT_TRUE(seen.insert(c).second);
        const Vec3<int> back = g.coordinates(c);
        ASSERT_EQ(back.x, x);
        ASSERT_EQ(back.y, y);
        ASSERT_EQ(back.z, z);
      }
}

TEST(CellGrid, NeighboursAreVisitedOnce)
{
  for (const bool wrap : {false, true})
    for (int n = 1; n < 6; ++n)
      for (int c = 0; c < n; ++c) {
        int first, last;
        neighbourRange(n, wrap, c, first, last);
        std::set<int> cells;
        for (int o = first; o <= last; ++o) {
          const int k = wrap ? wrapCell(c + o, n) : c + o;
          ASSERT_GE(k, 0);
          ASSERT_LT(k, n);
          ASSERT_TRUE(cells.insert(k).second) << n << " cells, cell " << c;
        }
        ASSERT_EQ(static_cast<int>(cells.size()), wrap ? std::min(n, 3) : last - first + 1);
      }
}

TEST(Layout, WindowsDivideAPeriodicBoxAndHoldEightCells)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> length(2.3, 400.0);
  for (int k = 0; k < 1000; ++k) {
    Box box;
    box.hi = {length(random), length(random), length(random)};
    box.periodic = {true, false, true};
    const CellGrid g = chooseGrid(box, 1.1, 100000000);
    const Frame f = chooseFrame(box, g);
    const double windows = (box.hi[0] - box.lo[0]) / f.window.x;
    ASSERT_NEAR(windows, std::round(windows), 1e-9);
    ASSERT_GE(f.window.x * (1 + 1e-12), std::min(8.0 * g.size.x, box.hi[0]));
    ASSERT_GE(g.size.x * (1 + 1e-12), 1.1);
  }
}

}  // namespace
