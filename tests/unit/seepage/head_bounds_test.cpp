// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/head_bounds.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <vector>

namespace berm::seepage
{
namespace
{
/// 8 m x 4 m between water of 3 m and of 1 m: heads lie between 1 and 3 m.
struct Strip
{
  meshes::TriangleMesh mesh;
  NodeConditions conditions;
  std::vector<double> p; ///< the head falls evenly

  Strip()
  {
    meshes::SectionInput input = tests::rectangle_input(8, 4);
    input.left_pool_level = 3;
    input.right_pool_level = 1;
    const meshes::Section section = meshes::build_section(input);
    mesh = tests::rectangle_mesh(section, 16, 8);
    conditions = node_conditions(mesh, boundary_conditions(section, {}));
    for (const Vec2& x : mesh.nodes)
      p.push_back(3 - x.x() / 4 - x.y());
  }

  [[nodiscard]] double excess() const { return head_excess(mesh, conditions, p); }
  [[nodiscard]] std::size_t inside() const
  {
    for (std::size_t i = 0;; ++i)
      if ((mesh.nodes[i] - Vec2(4, 2)).norm() < 1e-9)
        return i;
  }
};

TEST(HeadExcess, IsNothingBetweenTheHeads)
{
  EXPECT_EQ(Strip().excess(), 0);
}

TEST(HeadExcess, IsWhatAHeadLiesOutsideOverTheRange)
{
  Strip high, low;
  high.p[high.inside()] += 1.5; // 3.5 m
  EXPECT_NEAR(high.excess(), 0.5 / 2, 1e-12);
  low.p[low.inside()] -= 1.2; // 0.8 m
  EXPECT_NEAR(low.excess(), 0.2 / 2, 1e-12);
}

TEST(HeadExcess, GivenFlowBoundsNoHeadOfItsOwn)
{
  Strip strip;
  strip.p[strip.inside()] += 1.5;
  strip.conditions.load[strip.inside()] = 1e-6;
  EXPECT_EQ(strip.excess(), 0);
}

TEST(HeadExcess, ASeepageFaceIsABoundFromBelowOnly)
{
  Strip strip;
  for (std::size_t i = 0; i < strip.p.size(); ++i)
    if (strip.mesh.nodes[i].x() == 8)
      strip.conditions.kind[i] = NodeKind::face;
  strip.p[strip.inside()] = 0.5 - 2; // lowest point of the face: 0 m
  EXPECT_EQ(strip.excess(), 0);
  strip.p[strip.inside()] = 3.3 - 2;
  EXPECT_NEAR(strip.excess(), 0.3 / 3, 1e-12);
}

TEST(HeadExcess, OfOneHeadCountsOverTheHeightOfTheMesh)
{
  Strip strip;
  for (std::size_t i = 0; i < strip.p.size(); ++i)
  {
    strip.p[i] = 2 - strip.mesh.nodes[i].y();
    if (strip.conditions.kind[i] == NodeKind::head)
      strip.conditions.pressure_head[i] = strip.p[i];
    if (strip.conditions.kind[i] == NodeKind::face)
      strip.conditions.kind[i] = NodeKind::interior;
  }
  EXPECT_EQ(strip.excess(), 0);
  strip.p[strip.inside()] += 0.4;
  EXPECT_NEAR(strip.excess(), 0.4 / 4, 1e-12);
}
} // namespace
} // namespace berm::seepage
