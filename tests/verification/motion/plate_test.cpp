// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-7 of docs/verification.md on the updated-Lagrangian solver.
#include "tests/support/plate.h"

#include <gtest/gtest.h>

namespace berm::sph
{
/// Swings of a thousandth of the length. The outer fibres are one-sided sums: first order in dx /
/// H.
TEST(Plate, SwingsWithItsPeriod)
{
  for (const double dx : {0.004, 0.002})
  {
    const tests::Swing s = tests::swing(dx, 0.005);
    EXPECT_NEAR(s.period / tests::plate_period, 1, dx / 0.02);
    EXPECT_NEAR(s.balance, 0, 0.01);
  }
}
} // namespace berm::sph
