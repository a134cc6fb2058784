// SPDX-License-Identifier: GPL-3.0-or-later
// Embankments without closed form, against a P2 code that tracks the free surface and has the exact
// rectangular dam to 2e-4: docs/verification.md S-4, S-5. Default settings.
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

namespace berm
{
namespace
{
using tests::largest_head_error;
using tests::largest_level_error;
using tests::solved;

TEST(TwoSidedEmbankment, HasTheDischargeHeadsAndFreeSurfaceOfTheTrackedSolution)
{
  meshes::SectionInput input;
  input.ground = {{0, 7.3}, {33.5, 7.3}, {99.83, 28.6}, {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};
  input.base = {{0, 0}, {191.4, 0}};
  input.left_pool_level = 24.4;
  const seepage::Solution s = solved(input, {{1e-7, 1e-7, 0}});
  tests::expect_measured("S-4 discharge / k [m]", s.discharge / 1e-7, 3.317,
                         5e-4 * 3.317); // the reference itself is +- 0.001
  EXPECT_LT(s.balance, 1e-8);
  // Heads of the reference +- 0.002 m.
  tests::expect_error("S-4 heads, largest error [m]",
                      largest_head_error(s, {{60, 5, 24.204},
                                             {90, 5, 22.229},
                                             {90, 15, 22.591},
                                             {103, 10, 20.461},
                                             {103, 15, 20.575},
                                             {115, 10, 18.437},
                                             {130, 5, 15.437},
                                             {150, 3, 10.356}}),
                      0.003);
  tests::expect_error("S-4 free surface, largest error [m]",
                      largest_level_error(s, {{88, 23.70},
                                              {90, 23.138},
                                              {95, 22.119},
                                              {100, 21.241},
                                              {105, 20.392},
                                              {110, 19.536},
                                              {115, 18.656},
                                              {120, 17.739},
                                              {130, 15.753},
                                              {140, 13.478},
                                              {145, 12.168}}),
                      0.01);
  ASSERT_TRUE(s.exit_point); // reference +- (0.05, 0.02) m
  tests::expect_measured("S-4 exit point, x [m]", s.exit_point->x(), 150.17, 0.1);
  tests::expect_measured("S-4 exit point, y [m]", s.exit_point->y(), 10.54, 0.06);
  EXPECT_NEAR(s.phreatic_lines.at(0).front().x(), 86.75, 0.01); // the waterline
  EXPECT_EQ(s.phreatic_lines.at(0).back(), *s.exit_point);
  EXPECT_TRUE(s.error.within_tolerance);
  EXPECT_LT(s.seconds.cpu, 6); // 0.9 s where it was written; room for a slower machine
}

TEST(TrapezoidalDam, OfTwentyMetresMatchesTheTrackedSolution)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {50, 20}, {60, 20}, {100, 0}};
  input.base = {{0, 0}, {100, 0}};
  input.left_pool_level = 18.5;
  const seepage::Solution s = solved(input, {{1, 1, 0}});
  tests::expect_measured("S-5 discharge / k [m]", s.discharge, 3.135, 0.0015 * 3.135);
  tests::expect_error("S-5 heads, largest error [m]",
                      largest_head_error(s, {{40, 5, 17.605}, {55, 5, 15.373}, {70, 5, 12.015}}),
                      0.005);
  tests::expect_error(
      "S-5 free surface, largest error [m]",
      largest_level_error(s, {{50, 16.997}, {60, 14.711}, {70, 12.354}, {80, 9.467}}), 0.005);
  ASSERT_TRUE(s.exit_point);
  tests::expect_measured("S-5 exit point, x [m]", s.exit_point->x(), 84.42, 0.12);
  tests::expect_measured("S-5 exit point, y [m]", s.exit_point->y(), 7.79, 0.06);
}

TEST(TrapezoidalDam, OfTwelveMetresMatchesTheTrackedSolution)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {24, 12}, {28, 12}, {52, 0}};
  input.base = {{0, 0}, {52, 0}};
  input.left_pool_level = 10;
  const seepage::Solution s = solved(input, {{1, 1, 0}});
  tests::expect_measured("S-5 discharge / k [m]", s.discharge, 1.5360, 0.0015 * 1.5360);
  tests::expect_error("S-5 heads, largest error [m]", largest_head_error(s, {{26, 4, 8.333}}),
                      0.003);
  tests::expect_error("S-5 free surface, largest error [m]",
                      largest_level_error(s, {{26, 8.480}, {30, 7.691}, {34, 6.839}, {38, 5.870}}),
                      0.003);
  ASSERT_TRUE(s.exit_point);
  tests::expect_measured("S-5 exit point, x [m]", s.exit_point->x(), 44.36, 0.06);
  tests::expect_measured("S-5 exit point, y [m]", s.exit_point->y(), 3.82, 0.03);
}
} // namespace
} // namespace berm
