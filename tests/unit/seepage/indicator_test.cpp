// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/indicator.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace berm::seepage
{
namespace
{
TEST(ErrorIndicator, OfUniformFlowBetweenItsBoundariesIsZero)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 3, 4, 3);
  const std::vector<Vec2> flux(mesh.triangles.size(), Vec2(0.3, 0));
  const std::vector<double> k(mesh.triangles.size(), 2);
  std::vector<std::uint8_t> given;
  std::vector<double> in;
  for (const auto& [i, j] : mesh.boundary)
  {
    const Vec2 side =
        mesh.nodes[static_cast<std::size_t>(j)] - mesh.nodes[static_cast<std::size_t>(i)];
    given.push_back(1);
    in.push_back(-0.3 * side.y() / side.norm()); // minus what leaves to the right of the side
  }
  for (const double eta2 : error_indicator(mesh, flux, k, given, in))
    EXPECT_NEAR(eta2, 0, 1e-30);
}

TEST(ErrorIndicator, IsTheJumpOfTheFlowSquaredOverTheConductivity)
{
  // Two triangles on one square; what the left one loses through the diagonal is not what the right
  // one gets.
  meshes::TriangleMesh mesh;
  mesh.nodes = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_soil = {0, 0};
  mesh.boundary = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  mesh.boundary_stretch = {0, 0, 0, 0};
  const std::vector<Vec2> flux{{0, 0}, {1, 0}};
  const std::vector<double> k{3, 5}, none(4, 0);
  // Diagonal: (1 x 2)^2 / (3 + 5), half to each.
  const std::vector<double> inside =
      error_indicator(mesh, flux, k, std::vector<std::uint8_t>(4, 0), none);
  EXPECT_NEAR(inside[0], 0.25, 1e-15);
  EXPECT_NEAR(inside[1], 0.25, 1e-15);
  // The left side is to let nothing through, and lets 1 x 2: (1 x 2)^2 / 5.
  const std::vector<double> at_side =
      error_indicator(mesh, flux, k, std::vector<std::uint8_t>{0, 0, 0, 1}, none);
  EXPECT_NEAR(at_side[0], 0.25, 1e-15);
  EXPECT_NEAR(at_side[1], 0.25 + 0.8, 1e-15);
}
} // namespace
} // namespace berm::seepage
