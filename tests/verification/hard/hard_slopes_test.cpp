// SPDX-License-Identifier: GPL-3.0-or-later
/// Strength reduction where it is hard; docs/hard_cases.md. All on coarse particles: what is asked
/// is whether the answer breaks, not how exact it is.
#include "coupling/analysis.h"
#include "tests/support/slopes.h"
#include "tests/support/soundness.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
using tests::slope;
using tests::soil;

const Polyline one_in_two = {{0, 15}, {12, 15}, {32, 5}, {44, 5}};     // 10 m, on 5 m of its own
const Polyline vertical_cut = {{0, 10}, {20, 10}, {20, 20}, {40, 20}}; // the same

Stability reduce(const Case& c)
{
  Observer silent;
  return analyse(c, silent).stability.value();
}

double factor(const Case& c)
{
  const sph::FactorOfSafety F = reduce(c).governing().F;
  EXPECT_TRUE(F.complete) << F.reason;
  return F.factor().value_or(0);
}

/// Bodies that differ in rounding alone: at the knee a trial may go either way, so that brackets of
/// 0.02 may lie half a step apart.
void expect_same_factor(const Case& a, const Case& b)
{
  const sph::FactorOfSafety F = reduce(a).governing().F, G = reduce(b).governing().F;
  ASSERT_TRUE(F.complete && G.complete) << F.reason << G.reason;
  EXPECT_NEAR(*F.factor(), *G.factor(), a.search.tolerance * (1 + 1e-9));
}
} // namespace

// tan(phi) / tan(beta), exact for an infinite slope. 2 % for half a particle of ten in the skin's
// weight (F-7 has the same bound at half the spacing), half a per cent for half the bracket.
TEST(HardSlope, WithoutCohesionHasTheFactorOfTheInfiniteSlope)
{
  const double beta = 20 * pi / 180;
  Case c =
      slope({{0, 5}, {20, 5}, {20 + 10 / std::tan(beta), 15}, {70, 15}}, 0, soil(0, 35, 20), 1);
  EXPECT_NEAR(factor(c) / (std::tan(35 * pi / 180) / std::tan(beta)), 1, 0.025);
}

// gamma H / c = 3.7765 +- 0.0015 without cut-off (2.5 % as F-4). Soil that bears no tension in any
// direction stands up to gamma H / c = 2 (Drucker & Prager 1952); a cut-off of the mean stress
// takes less away, so F lies between.
TEST(HardSlope, VerticalCutInClayWithAndWithoutTension)
{
  Case c = slope(vertical_cut, 0, soil(200 / 3.7765, 0, 20), 1);
  c.search.tolerance = 0.005; // well below the bound
  const double bears_tension = factor(c);
  EXPECT_NEAR(bears_tension, 1, 0.025);
  c.soils[0].mechanical.tensile_strength = 0;
  const double bears_none = factor(c);
  EXPECT_LT(bears_none, bears_tension);
  EXPECT_GT(bears_none, 2 / 3.7765);
}

// F does not depend on elasticity; 2 % is the width of the bracket and a half.
TEST(HardSlope, NearlyIncompressibleSoilDoesNotLock)
{
  for (const double phi : {20.0, 0.0})
  {
    Case c = slope(one_in_two, 0, soil(phi > 0 ? 10 : 40, phi, 20), 1);
    const double usual = factor(c);
    c.soils[0].mechanical.poisson_ratio = 0.495;
    EXPECT_NEAR(factor(c) / usual, 1, 0.02) << phi;
  }
}

// phi = psi = 45 deg. Associated flow is where Bishop's circle and collapse agree: 5 % for ten
// particles over the height.
TEST(HardSlope, AnyCohesionHasAFactorOrAReason)
{
  sph::Soil s = soil(0, 45, 20);
  s.dilation_angle = s.friction_angle;
  for (const double c : {1e3, 10e3, 100e3, 1000e3})
  {
    s.cohesion = c;
    Case strong = slope(one_in_two, 0, s, 1);
    strong.search.max_factor = 100;
    const Stability answer = reduce(strong);
    ASSERT_TRUE(answer.governing().F.complete) << c << answer.governing().F.reason;
    EXPECT_NEAR(*answer.governing().F.factor() / answer.governing().critical_circle.value().bishop,
                1, 0.05)
        << c;
  }
  const sph::FactorOfSafety beyond = reduce(slope(one_in_two, 0, s, 1)).governing().F;
  EXPECT_FALSE(beyond.complete);
  EXPECT_EQ(beyond.reason, "it stands even at 20");

  // Without cohesion, a skin that creeps: where trials fall into the hundredth of F that stays
  // undecided, the search says so; a step of it on either side makes two hundredths.
  s.cohesion = 0;
  const sph::FactorOfSafety skin = reduce(slope(one_in_two, 0, s, 1)).governing().F;
  ASSERT_TRUE(skin.stands && skin.fails);
  EXPECT_LT(*skin.fails - *skin.stands, 0.03 * *skin.stands);
  EXPECT_TRUE(skin.complete || skin.reason.find("undecided") != std::string::npos) << skin.reason;
  EXPECT_NEAR(*skin.factor(), 2, 0.06 * 2); // tan(45) / (1/2); one particle of ten is a thick skin
}

// Only differences of pressure enter: the depth of the pool is nothing, and below it the soil
// weighs gamma'.
TEST(HardSlope, UnderAPoolIsTheDrySlopeOfBuoyantSoil)
{
  const double gamma_w = water_unit_weight / 1e3;
  const auto under = [](double level) {
    return slope(one_in_two, 0, soil(10, 20, 20), 1, {{0, level}, {44, level}});
  };
  expect_same_factor(under(25), slope(one_in_two, 0, soil(10, 20, 20 - gamma_w), 1));
  expect_same_factor(under(25), under(125));
}

// A free surface that drops 10 m within 2 m, and one whose pressure lifts the soil at the toe.
TEST(HardSlope, SteepAndArtesianPressureStillGetAVerdict)
{
  for (const Polyline& line : {Polyline{{0, 15}, {12, 15}, {14, 5}, {44, 5}},
                               Polyline{{0, 25}, {12, 25}, {32, 10}, {34, 5}, {44, 5}}})
  {
    const sph::FactorOfSafety wet =
        reduce(slope(one_in_two, 0, soil(10, 20, 20), 1, line)).governing().F;
    EXPECT_TRUE(wet.complete) << wet.reason;
    EXPECT_LT(*wet.fails, 1.5); // 1.51 dry
  }
}

// A block on a weak seam along an inclined base, both ends free: F = c l / (W sin(beta)), by
// statics. At 30 deg, 2 c > sigma_n: the seam is not squeezed out at the ends. A seam of one
// particle has half its neighbours in stronger soil and on the wall: 10 % there, as measured (8 %).
TEST(HardSlope, BlockSlidesOnAWeakSeam)
{
  const double beta = pi / 6, length = 20, height = 5, rise = length * std::tan(beta), gamma = 20;
  const double exact =
      60 * length / std::cos(beta) / (gamma * length * height * std::sin(beta)); // c = 60 kPa
  for (const double dx : {0.5, 0.25})
  {
    double thinnest = 0, thickest = 0;
    for (const int layers : {1, 2, 3})
    {
      const double t = layers * dx;
      Case c = slope({{0, 0}, {0, height}, {length, height + rise}, {length, rise}}, 0,
                     soil(1000, 30, gamma), dx);
      c.section.base = {{0, 0}, {length, rise}};
      c.section.zones = {
          {.soil = 1, .polygon = {{0, 0}, {length, rise}, {length, rise + t}, {0, t}}}};
      c.soils.push_back({.name = "seam", .mechanical = soil(60, 0, gamma), .conductivity = {}});
      const double F = factor(c);
      EXPECT_NEAR(F / exact, 1, layers == 1 ? 0.1 : 0.05) << dx << " " << layers;
      if (layers == 2)
        thinnest = F;
      thickest = F;
    }
    EXPECT_NEAR(thinnest / thickest, 1, 0.05) << dx;
  }
}
} // namespace berm::coupling
