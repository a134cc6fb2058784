// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/transfer.h"

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

TEST(Transfer, IsExactForALinearFieldOnABentSection)
{
  // A U-shaped mesh: a rectangle without the middle of its upper half. Straight walks leave it.
  meshes::TriangleMesh mesh = tests::rectangle_mesh(6, 4, 12, 8);
  std::erase_if(mesh.triangles,
                [&](const auto& t)
                {
                  const Vec2 centre = (mesh.nodes[static_cast<std::size_t>(t[0])] +
                                       mesh.nodes[static_cast<std::size_t>(t[1])] +
                                       mesh.nodes[static_cast<std::size_t>(t[2])]) /
                                      3;
                  return centre.y() > 1 && centre.x() > 2 && centre.x() < 4;
                });
  std::vector<double> nodal;
  for (const Vec2& x : mesh.nodes)
    nodal.push_back(linear(x));
  const Polyline points{{0.1, 3.9}, {5.9, 3.9}, {0, 0}, {6, 4}, {2, 3.3}, {4, 3.3}, {3, 0.5}};
  const std::vector<double> values = transfer(mesh, nodal, points);
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_NEAR(values[k], linear(points[k]), 1e-12);
}

TEST(Transfer, ExtrapolatesJustOutside)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(6, 4, 12, 8);
  std::vector<double> nodal;
  for (const Vec2& x : mesh.nodes)
    nodal.push_back(linear(x));
  const Polyline points{{3, 4.001}, {-0.001, 2}};
  const std::vector<double> values = transfer(mesh, nodal, points);
  EXPECT_NEAR(values[0], linear(points[0]), 1e-12);
  EXPECT_NEAR(values[1], linear(points[1]), 1e-12);
}
} // namespace
} // namespace berm::seepage
