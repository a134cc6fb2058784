// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/uncertainty.h"

#include <cmath>
#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
Bracket around(double F, double half_width = 1e-4)
{
  return {F - half_width, F + half_width};
}

/// F(dx) = limit + c dx^p at dx = 1, 2, 4.
std::vector<SpacingFactor> of_order(double p, double limit, double c, double half_width = 1e-4)
{
  std::vector<SpacingFactor> levels;
  for (const double dx : {1.0, 2.0, 4.0})
    levels.push_back({dx, around(limit + c * std::pow(dx, p), half_width)});
  return levels;
}
} // namespace

TEST(DiscretisationError, FindsTheLimitOfAFactorThatConverges)
{
  for (const double p : {0.6, 1.0, 1.5, 2.0})
    for (const double c : {0.05, -0.02})
    {
      const auto error = discretisation_error(of_order(p, 1.5, c));
      ASSERT_TRUE(error && error->order);
      EXPECT_NEAR(*error->order, p, 1e-9);
      EXPECT_NEAR(*error->extrapolated, 1.5, 1e-9);
      EXPECT_NEAR(error->error, 1.25 * std::abs(c), 1e-9); // the true error is |c| at dx = 1
    }
}

TEST(DiscretisationError, ClaimsNoOrderWhereThereIsNone)
{
  // A change of sign; an order of 3, or of 0.2; changes within the brackets.
  const std::vector<std::vector<SpacingFactor>> erratic = {
      {{1, around(1.50)}, {2, around(1.52)}, {4, around(1.51)}},
      of_order(3, 1.5, 0.01),
      of_order(0.2, 1.5, 0.1),
      of_order(1, 1.5, 0.01, 0.01)};
  for (const auto& levels : erratic)
  {
    const auto error = discretisation_error(levels);
    ASSERT_TRUE(error.has_value());
    EXPECT_FALSE(error->order || error->extrapolated);
    const double F1 = levels[0].F.factor(), F2 = levels[1].F.factor(), F4 = levels[2].F.factor();
    EXPECT_NEAR(error->error, 1.25 * std::max(std::abs(F1 - F2), std::abs(F2 - F4) / 2), 1e-12);
  }
}

TEST(DiscretisationError, TwoSpacingsGiveTheirChangeAndOneNothing)
{
  const auto error = discretisation_error({{1, around(1.50)}, {2, around(1.52)}});
  ASSERT_TRUE(error.has_value());
  EXPECT_NEAR(error->error, 0.025, 1e-12);
  EXPECT_FALSE(error->order);
  EXPECT_FALSE(discretisation_error({{1, around(1.50)}}));
}

TEST(FactorRange, CoversEachOfItsParts)
{
  const Bracket F{1.49, 1.51};
  FactorRange range = factor_range(F, {}, {});
  EXPECT_EQ(range.low, 1.49);
  EXPECT_EQ(range.high, 1.51);
  range = factor_range(F, DiscretisationError{.error = 0.03, .order = {}, .extrapolated = {}},
                       FlowRuleSpread{{1.49, 1.51}, {1.55, 1.57}});
  EXPECT_NEAR(range.low, 1.46, 1e-12);
  EXPECT_NEAR(range.high, 1.60, 1e-12);
}
} // namespace berm::coupling
