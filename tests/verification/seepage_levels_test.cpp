// SPDX-License-Identifier: GPL-3.0-or-later
// No water, water everywhere, and water over the crest: docs/verification.md S-12.
#include "tests/support/measured.h"
#include "tests/unit/meshes/sections.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using seepage::Solution;

struct Listener : Observer
{
  void warn(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

meshes::SectionInput embankment(std::optional<double> left, std::optional<double> right)
{
  meshes::SectionInput input = tests::two_sided_embankment();
  input.left_pool_level = left;
  input.right_pool_level = right;
  return input;
}

TEST(DrySection, HasTheHeadOfItsLowestPointAndWarns)
{
  const meshes::Section section = meshes::build_section(embankment(7.3, std::nullopt));
  Listener listener;
  const Solution s =
      seepage::solve(section, {{1, 1, 0}}, seepage::boundary_conditions(section, {}), {}, listener);
  for (const double head : s.head)
    EXPECT_NEAR(head, 0, 1e-12);
  EXPECT_EQ(s.discharge, 0);
  EXPECT_TRUE(s.phreatic_lines.empty());
  ASSERT_EQ(listener.warnings.size(), 1u); // not once for every mesh
  EXPECT_NE(listener.warnings[0].find("no water reaches the soil"), std::string::npos);
}

TEST(SubmergedSection, IsHydrostatic)
{
  const Solution s = tests::solved(embankment(31, 31), {{1, 1, 0}});
  EXPECT_EQ(s.discharge, 0);
  for (const double head : s.head)
    EXPECT_NEAR(head, 31, 1e-9);
}

TEST(PoolUpToTheCrest, IsTheLimitOfPoolsBelowIt)
{
  const double at = tests::solved(embankment(28.6, std::nullopt), {{1, 1, 0}}).discharge,
               below = tests::solved(embankment(28.59, std::nullopt), {{1, 1, 0}}).discharge;
  tests::expect_measured("S-12 pool up to the crest: discharge / k [m]", at, below,
                         5e-3 * at); // 1 cm of 21 m, squared, and two meshes
}

// A film on a slope over soil that drains freely at its base: h = y everywhere, so the soil takes k
// times the width. The pool stands a millimetre above the crest, which is the upper end of the
// slope.
TEST(Overflow, OnFreelyDrainedSoilSinksWithUnitGradient)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {0, 10}, {20, 4}, {20, 0}};
  input.base = {{0, 0}, {20, 0}};
  input.left_pool_level = 10.001;
  input.marked_lines = {{{0, 0}, {0, 10}}, {{20, 0}, {20, 4}}, {{0, 0}, {20, 0}}};
  const Solution s = tests::solved(input, {{1, 1, 0}},
                                   {{BoundaryKind::impervious, 0},
                                    {BoundaryKind::impervious, 0},
                                    {BoundaryKind::seepage_face, 0}});
  tests::expect_measured("S-12 film on a slope: discharge / k [m]", s.discharge, 20, 1e-3 * 20);
  tests::expect_error("S-12 film on a slope: heads, largest error [m]",
                      tests::largest_head_error(s, {{5, 4, 4}, {10, 2, 2}, {15, 3, 3}}), 1e-3);
}

TEST(Overflow, HasADischargeThatConvergesWithTheMesh)
{
  // A jump of the head at the crest would make it grow without bound, by as much each time.
  const meshes::Section section = meshes::build_section(embankment(31, 10));
  Observer observer;
  std::vector<double> q;
  for (const double size : {2.0, 1.0, 0.5})
    q.push_back(seepage::solve(section, {{1, 1, 0}}, seepage::boundary_conditions(section, {}),
                               {.element_size = size, .adaptive = false}, observer)
                    .discharge);
  EXPECT_LT(std::abs(q[2] - q[1]), 0.75 * std::abs(q[1] - q[0]));
}

TEST(Overflow, IsBalancedMirroredAndWithinItsHeads)
{
  const meshes::SectionInput input = embankment(31, 10);
  const Solution a = tests::solved(input, {{1, 1, 0}}),
                 b = tests::solved(tests::mirrored(input), {{1, 1, 0}});
  EXPECT_LT(a.balance, 1e-8);
  tests::expect_measured("S-12 overtopped embankment: discharge / k, mirrored [m]", a.discharge,
                         b.discharge, 5e-3 * a.discharge); // meshes are not mirrored
  for (const double head : a.head)                         // maximum principle
  {
    EXPECT_LE(head, 31 + 1e-9);
    EXPECT_GE(head, 10 - 1e-9);
  }
}
} // namespace
} // namespace berm
