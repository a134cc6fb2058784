// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/comparison.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace berm::coupling
{
namespace
{
TEST(PressureDifference, IsSeepageMinusTheOther)
{
  const PressureDifference d = pressure_difference({3, 5, 0, 2}, {1, 6, 0, 5});
  EXPECT_DOUBLE_EQ(d.mean, (2 - 1 + 0 - 3) / 4.0);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt((4 + 1 + 0 + 9) / 4.0));
  EXPECT_EQ(d.smallest, -3);
  EXPECT_EQ(d.largest, 2);
}

/// A rectangle of 8 m x 4 m in which the head is a + b x: linear elements and lines have it
/// exactly, to the rounding of a few sums.
struct Rectangle
{
  meshes::Section section = meshes::build_section(tests::rectangle_input(8, 4));
  seepage::Solution solution;

  Rectangle(double a, double b)
  {
    solution.mesh = tests::rectangle_mesh(section, 16, 8);
    for (const Vec2& x : solution.mesh.nodes)
      solution.head.push_back(a + b * x.x());
  }
};

TEST(PhreaticSurface, IsThePhreaticLineWhereTheGroundIsDry)
{
  Rectangle r(3, -0.25);
  r.solution.phreatic_lines = {{{0, 3}, {8, 1}}};
  for (const Vec2& p : phreatic_surface(r.section, r.solution))
  {
    if (p.x() > 0 && p.x() < 8) // the faces are ground, too
    {
      EXPECT_NEAR(p.y(), 3 - 0.25 * p.x(), 1e-12) << p.transpose();
    }
  }
}

TEST(PhreaticSurface, IsTheHeadWhereTheSoilIsWetUpToTheGround)
{
  Rectangle r(5, -0.25); // wet up to x = 4
  r.solution.phreatic_lines = {{{4, 4}, {8, 3}}};
  for (const Vec2& p : phreatic_surface(r.section, r.solution))
  {
    if (p.x() > 0 && p.x() < 8)
    {
      EXPECT_NEAR(p.y(), 5 - 0.25 * p.x(), 1e-12) << p.transpose();
    }
  }
}

TEST(PhreaticSurface, IsBelowTheBaseOfDrySoil)
{
  Rectangle r(-1, 0);
  for (const Vec2& p : phreatic_surface(r.section, r.solution))
    EXPECT_LT(p.y(), 0);
}

TEST(PhreaticSurface, HasIncreasingX)
{
  Rectangle r(3, 0);
  r.solution.phreatic_lines = {{{0, 3}, {8, 3}}};
  const Polyline surface = phreatic_surface(r.section, r.solution);
  EXPECT_EQ(surface.front().x(), 0);
  EXPECT_EQ(surface.back().x(), 8);
  for (std::size_t k = 1; k < surface.size(); ++k)
    EXPECT_GT(surface[k].x(), surface[k - 1].x());
}
} // namespace
} // namespace berm::coupling
