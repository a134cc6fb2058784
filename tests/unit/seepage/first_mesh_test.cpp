// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/first_mesh.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berm::seepage
{
namespace
{
meshes::Section box()
{
  meshes::SectionInput input = tests::rectangle_input(8, 2);
  input.left_pool_level = 1.5;
  return meshes::build_section(input);
}

TEST(Stretching, IsNoneInIsotropicSoil)
{
  EXPECT_TRUE(Stretching(box(), {{1, 1, 0.3}}).none());
}

TEST(Stretching, ShrinksTheMoreConductiveAxisByTheFourthRootAndKeepsAreas)
{
  const meshes::Section section = box();
  const meshes::Section flat = Stretching(section, {{16, 1, 0}}).stretched(section);
  EXPECT_NEAR(flat.x_max - flat.x_min, 4, 1e-14);
  EXPECT_NEAR(flat.y_max - flat.y_min, 4, 1e-14);
  // Turned by 90 degrees it is the vertical axis.
  const meshes::Section tall = Stretching(section, {{16, 1, pi / 2}}).stretched(section);
  EXPECT_NEAR(tall.x_max - tall.x_min, 16, 1e-13);
  EXPECT_NEAR(tall.y_max - tall.y_min, 1, 1e-14);
  const meshes::Section turned = Stretching(section, {{9, 4, 0.7}}).stretched(section);
  EXPECT_NEAR(meshes::polygon_area(turned.outline), 16, 1e-13);
}

TEST(Stretching, MakesTheMostWidespreadSoilIsotropic)
{
  meshes::SectionInput input = tests::rectangle_input(8, 2);
  input.zones = {{1, {{0, 0}, {5, 0}, {5, 2}, {0, 2}}}};
  const meshes::Section section = meshes::build_section(input);
  const Conductivity k{25, 4, 0.4};
  const Stretching stretching(section, {{1, 1, 0}, k});
  // K maps to M K M^T, which is to be a multiple of the identity: principal axes have equal length.
  meshes::TriangleMesh axes;
  axes.nodes = {5 * Vec2(std::cos(0.4), std::sin(0.4)), 2 * Vec2(-std::sin(0.4), std::cos(0.4))};
  const meshes::TriangleMesh mapped = stretching.stretched(axes);
  EXPECT_NEAR(mapped.nodes[0].norm(), mapped.nodes[1].norm(), 1e-14);
  EXPECT_NEAR(mapped.nodes[0].dot(mapped.nodes[1]), 0, 1e-13);
  const meshes::TriangleMesh back = stretching.unstretched(mapped);
  EXPECT_NEAR((back.nodes[0] - axes.nodes[0]).norm(), 0, 1e-14);
}
} // namespace
} // namespace berm::seepage
