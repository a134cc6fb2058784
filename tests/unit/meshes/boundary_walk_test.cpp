// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/boundary_walk.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace berm::meshes
{
TEST(BoundaryWalk, FollowsTheOutlineWhateverTheOrderOfItsRows)
{
  TriangleMesh mesh = tests::rectangle_mesh(3, 2, 3, 2);
  std::swap(mesh.boundary[1], mesh.boundary[7]);
  std::swap(mesh.boundary[2], mesh.boundary[4]);
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 1u);
  const std::vector<std::size_t>& edges = loops.front();
  ASSERT_EQ(edges.size(), mesh.boundary.size());
  EXPECT_EQ(edges.front(), 0u);
  for (std::size_t k = 0; k < edges.size(); ++k)
    EXPECT_EQ(mesh.boundary[edges[k]][1], mesh.boundary[edges[(k + 1) % edges.size()]][0]);
  std::vector<std::size_t> sorted = edges;
  std::ranges::sort(sorted);
  EXPECT_EQ(std::ranges::unique(sorted).begin(), sorted.end()); // each row once
}
} // namespace berm::meshes
