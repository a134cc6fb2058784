// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/solution.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace berm::seepage
{
namespace
{
double linear(const Vec2& x)
{
  return 3 - 0.7 * x.x() + 1.3 * x.y();
}

struct Field
{
  Solution solution;
  std::vector<double> nodal;

  Field()
  {
    solution.mesh = tests::rectangle_mesh(4, 2, 9, 5);
    for (const Vec2& x : solution.mesh.nodes)
      nodal.push_back(linear(x));
  }
};

TEST(ValueAt, IsExactForALinearField)
{
  const Field field;
  for (const Vec2& x : {Vec2(0, 0), Vec2(4, 2), Vec2(1.234, 0.567), Vec2(3.999, 1.999), Vec2(2, 2)})
    EXPECT_NEAR(value_at(field.solution, field.nodal, x, 0).value(), linear(x), 1e-13);
}

TEST(ValueAt, OutsideTakesTheNearestPointOfTheMesh)
{
  const Field field;
  EXPECT_NEAR(value_at(field.solution, field.nodal, {2, 2.05}, 0.1).value(), linear({2, 2}), 1e-13);
  EXPECT_NEAR(value_at(field.solution, field.nodal, {4.03, -0.04}, 0.1).value(), linear({4, 0}),
              1e-13);
}

TEST(ValueAt, FartherOutsideIsNothing)
{
  const Field field;
  EXPECT_FALSE(value_at(field.solution, field.nodal, {2, 2.11}, 0.1));
}

TEST(PhreaticLevel, InterpolatesAndTakesTheHighestLine)
{
  Solution solution;
  solution.phreatic_lines = {{{0, 5}, {10, 3}}, {{2, 1}, {4, 6}}};
  EXPECT_DOUBLE_EQ(phreatic_level(solution, 0).value(), 5);
  EXPECT_DOUBLE_EQ(phreatic_level(solution, 5).value(), 4);
  EXPECT_DOUBLE_EQ(phreatic_level(solution, 4).value(), 6);
  EXPECT_FALSE(phreatic_level(solution, 10.01));
}

TEST(PhreaticLevel, OfAVerticalPieceIsItsUpperEnd)
{
  Solution solution;
  solution.phreatic_lines = {{{0, 5}, {3, 4}, {3, 2}}};
  EXPECT_DOUBLE_EQ(phreatic_level(solution, 3).value(), 4);
}
} // namespace
} // namespace berm::seepage
