// SPDX-License-Identifier: GPL-3.0-or-later
/// Hard cases that take a while; docs/hard_cases.md.
#include "coupling/analysis.h"
#include "tests/support/slopes.h"

#include <cstdio>
#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
sph::FactorOfSafety reduce(const Case& c)
{
  Observer silent;
  return analyse(c, silent).stability.value().governing().F;
}
} // namespace

// Griffiths & Lane Ex. 1, H = 10 m. Coarse particles miss the toe and cut the shear band: F grows
// to its limit. 5 % from H/10 on; below that only that there is an answer, and that it is low.
TEST(HardSlow, FactorHasAVerdictFromSixToSixtyParticlesOverTheHeight)
{
  std::vector<double> F;
  for (const double count : {6, 10, 20, 30, 40, 60})
  {
    const sph::FactorOfSafety answer =
        reduce(tests::slope({{0, 10}, {12, 10}, {32, 0}}, 0, tests::soil(10, 20, 20), 10 / count));
    ASSERT_TRUE(answer.complete) << count << answer.reason;
    F.push_back(*answer.factor());
    std::printf("H/%.0f: F = %.3f\n", count, F.back());
  }
  for (std::size_t k = 1; k < F.size(); ++k)
  {
    EXPECT_NEAR(F[k] / F.back(), 1, 0.05);
    EXPECT_GE(F[k], F[k - 1] - 0.02); // to within the bracket
  }
}

// F does not depend on elasticity, so neither on that of layers. 2 %: brackets of 0.02 around 1.5.
TEST(HardSlow, LayersOfVeryDifferentStiffnessHaveTheFactorOfOne)
{
  for (const double ratio : {1e2, 1e4})
    for (const bool stiff_over_soft : {true, false})
    {
      sph::Soil soft = tests::soil(20, 15, 20);
      soft.young_modulus = 1e7;
      sph::Soil stiff = soft;
      stiff.young_modulus *= ratio;
      Case c = tests::slope({{0, 15}, {12, 15}, {32, 5}, {44, 5}}, 0, soft, 1);
      const double uniform = *reduce(c).factor();
      c.soils.push_back(c.soils[0]);
      c.soils[stiff_over_soft ? 0 : 1].mechanical = stiff;
      c.section.zones = {{.soil = 1, .polygon = {{0, 0}, {44, 0}, {44, 5}, {0, 5}}}};
      const sph::FactorOfSafety F = reduce(c);
      ASSERT_TRUE(F.complete) << ratio << F.reason;
      EXPECT_NEAR(*F.factor() / uniform, 1, 0.02);
      std::printf("E ratio %.0e, %s: F = %.3f, uniform %.3f\n", ratio,
                  stiff_over_soft ? "stiff over soft" : "soft over stiff", *F.factor(), uniform);
    }
}
} // namespace berm::coupling
