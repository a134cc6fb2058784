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
  return analyse(c, silent).stability.value().factor_of_safety;
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
} // namespace berm::coupling
