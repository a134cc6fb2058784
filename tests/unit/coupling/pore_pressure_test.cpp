// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/pore_pressure.h"

#include "core/error.h"
#include "tests/support/meshes.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
double at(const PorePressure& p_w, double x, double y)
{
  const std::vector<double> xs = {x}, ys = {y};
  return p_w(xs, ys).front();
}
} // namespace

TEST(PorePressure, OfDrySoilIsZero)
{
  EXPECT_EQ(at(no_pore_pressure(), 3, 4), 0);
}

TEST(PorePressure, HydrostaticIsUnitWeightTimesVerticalDepth)
{
  const PorePressure p_w = hydrostatic_pore_pressure({{10, 20}, {30, 10}});
  EXPECT_NEAR(at(p_w, 20, 5), 9810 * 10, 1e-9);
  EXPECT_NEAR(at(p_w, 0, 5), 9810 * 15, 1e-9); // level beyond the left end
  EXPECT_NEAR(at(p_w, 99, 5), 9810 * 5, 1e-9); // and beyond the right end
  EXPECT_EQ(at(p_w, 20, 16), 0);               // no suction above
}

TEST(PorePressure, ThePapersLineRunsFromTheWaterlineToTheToe)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 24.4;
  const Polyline line = straight_free_surface(meshes::build_section(input));
  ASSERT_EQ(line.size(), 2u);
  EXPECT_NEAR(line[0].x(), 33.5 + 66.33 * (24.4 - 7.3) / 21.3, 1e-9); // 86.75, as the paper says
  EXPECT_NEAR(line[0].y(), 24.4, 1e-12);
  EXPECT_NEAR((line[1] - Vec2{157.9, 7.3}).norm(), 0, 1e-9);
}

TEST(PorePressure, AroundTheSectionItIsThatOfPoolsAndAir)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 24.4;
  const PorePressure inside = [](std::span<const double> x, std::span<const double>)
  { return std::vector<double>(x.size(), 7.0); };
  const PorePressure p_w = pore_pressure_in_space(inside, meshes::build_section(input));
  EXPECT_EQ(at(p_w, 100, 10), 7);
  EXPECT_NEAR(at(p_w, 20, 10), 9810 * 14.4,
              1e-9);              // in the pool, no soil as drawn; rounding of 1.4e5 Pa
  EXPECT_EQ(at(p_w, 20, 25), 0);  // above it
  EXPECT_EQ(at(p_w, 170, 8), 0);  // beyond the dry toe
  EXPECT_EQ(at(p_w, 103, 30), 0); // above the crest
}

TEST(PorePressure, WithTwoPoolsTheLineJoinsTheirWaterlines)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 24.4;
  input.right_pool_level = 10;
  const Polyline line = straight_free_surface(meshes::build_section(input));
  ASSERT_EQ(line.size(), 2u);
  EXPECT_NEAR(line[1].y(), 10, 1e-12);
  EXPECT_NEAR(line[1].x(), 157.9 - 50.77 * 2.7 / 21.3, 1e-9);
}

TEST(PorePressure, APoolThatRunsOverEndsAtTheCrest)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 31;
  const Polyline line = straight_free_surface(meshes::build_section(input));
  ASSERT_EQ(line.size(), 2u);
  EXPECT_EQ(line[0], Vec2(99.83, 31));
  EXPECT_EQ(line[1], Vec2(157.9, 7.3)); // the toe
}

TEST(PorePressure, APoolOverEverythingIsALevelLine)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = input.right_pool_level = 40;
  const PorePressure p_w =
      hydrostatic_pore_pressure(straight_free_surface(meshes::build_section(input)));
  EXPECT_NEAR(at(p_w, 5, 5), 9810 * 35, 1e-9);
  EXPECT_NEAR(at(p_w, 180, 5), 9810 * 35, 1e-9);
}

TEST(PorePressure, WithoutAPoolThereIsNoLine)
{
  EXPECT_TRUE(straight_free_surface(meshes::build_section(tests::embankment())).empty());
}

TEST(PorePressure, OfSeepageIsTheFiniteElementFieldWithoutSuction)
{
  seepage::Solution solution;
  solution.mesh =
      tests::rectangle_mesh(meshes::build_section(tests::rectangle_input(16, 10)), 8, 5);
  for (const Vec2& node : solution.mesh.nodes)
    solution.pore_pressure.push_back(9810 * (6 + 0.1 * node.x() - node.y()));
  const PorePressure p_w = seepage_pore_pressure(solution, 0.5);
  EXPECT_NEAR(at(p_w, 3.3, 2.7), 9810 * (6 + 0.33 - 2.7), 1e-8);
  EXPECT_EQ(at(p_w, 3.3, 9), 0);
  EXPECT_NEAR(at(p_w, 16.2, 1), 9810 * (6 + 1.6 - 1), 1e-8); // a little outside: the nearest point
  EXPECT_THROW((void)at(p_w, 18, 1), InputError);
}
} // namespace berm::coupling
