// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/planar.h"
#include "meshes/refine.h"
#include "meshes/sides.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace berm::meshes
{
namespace
{
const Vec2& node(const TriangleMesh& mesh, Index i)
{
  return mesh.nodes[static_cast<std::size_t>(i)];
}

double area(const TriangleMesh& mesh)
{
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += cross(node(mesh, b) - node(mesh, a), node(mesh, c) - node(mesh, a)) / 2;
  return sum;
}

double smallest_angle(const TriangleMesh& mesh)
{
  double smallest = pi;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec2 u = node(mesh, t[(k + 1) % 3]) - node(mesh, t[k]),
                 v = node(mesh, t[(k + 2) % 3]) - node(mesh, t[k]);
      smallest = std::min(smallest, std::atan2(cross(u, v), u.dot(v))); // negative if turned over
    }
  return smallest;
}

/// No node lies inside another triangle's side: sides with one triangle are the boundary's rows.
void expect_conforming(const TriangleMesh& mesh)
{
  const Sides sides(mesh);
  std::vector<std::array<Index, 2>> open;
  for (std::size_t s = 0; s < sides.ends.size(); ++s)
    if (sides.touches[s][0] == sides.touches[s][1])
      open.push_back(sides.ends[s]);
  std::vector<std::array<Index, 2>> rows;
  for (const auto& [i, j] : mesh.boundary)
    rows.push_back({std::min(i, j), std::max(i, j)});
  std::ranges::sort(rows);
  EXPECT_EQ(open, rows);
}

std::vector<std::uint8_t> only(std::size_t t, std::size_t m)
{
  std::vector<std::uint8_t> marked(m, 0);
  marked[t] = 1;
  return marked;
}

TEST(RefinedMesh, CutsMarkedTrianglesInFourAndStaysConforming)
{
  const TriangleMesh mesh = tests::rectangle_mesh(4, 3, 5, 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const RefinedMesh finer = refined(mesh, only(t, mesh.triangles.size()));
    EXPECT_EQ(std::ranges::count(finer.origin, static_cast<Index>(t)), 4);
    EXPECT_NEAR(area(finer.mesh), 12, 1e-12);
    expect_conforming(finer.mesh);
    EXPECT_EQ(finer.mesh.triangle_soil.size(), finer.mesh.triangles.size());
    EXPECT_EQ(finer.mesh.boundary_stretch.size(), finer.mesh.boundary.size());
  }
}

TEST(RefinedMesh, WithEverythingMarkedHalvesEveryEdge)
{
  const TriangleMesh mesh = tests::rectangle_mesh(4, 3, 5, 4);
  const RefinedMesh finer = refined(mesh, std::vector<std::uint8_t>(mesh.triangles.size(), 1));
  EXPECT_EQ(finer.mesh.triangles.size(), 4 * mesh.triangles.size());
  EXPECT_EQ(finer.mesh.boundary.size(), 2 * mesh.boundary.size());
  EXPECT_EQ(finer.mesh.nodes.size(), mesh.nodes.size() + Sides(mesh).ends.size());
  EXPECT_NEAR(smallest_angle(finer.mesh), smallest_angle(mesh), 1e-12); // the same shapes
}

TEST(RefinedMesh, KeepsHalfOfItsSmallestAngleHoweverOftenACornerIsRefined)
{
  TriangleMesh mesh = tests::rectangle_mesh(3, 1, 3, 2);
  const double before = smallest_angle(mesh);
  for (int k = 0; k < 25; ++k)
  {
    std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < marked.size(); ++t)
      for (const Index i : mesh.triangles[t])
        marked[t] = marked[t] || (node(mesh, i) - Vec2(3, 1)).norm() < 1e-12;
    mesh = refined(mesh, marked).mesh;
  }
  EXPECT_GE(smallest_angle(mesh), 0.5 * before * (1 - 1e-6));
  EXPECT_NEAR(area(mesh), 3, 1e-12);
  expect_conforming(mesh);
  EXPECT_LT(mesh.nodes.size(), 25 * 12); // a few nodes a level: the refinement stays in the corner
}

TEST(RefinedMesh, CutsTheTwoSidesOfASlitApartFromEachOther)
{
  // Two triangles along one line that share no node.
  TriangleMesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {0.5, 1}, {0, 0}, {1, 0}, {0.5, -1}};
  mesh.triangles = {{0, 1, 2}, {4, 3, 5}};
  mesh.triangle_soil = {0, 1};
  mesh.boundary = {{0, 1}, {1, 2}, {2, 0}, {4, 3}, {3, 5}, {5, 4}};
  mesh.boundary_stretch = {0, 1, 1, 0, 1, 1};
  const RefinedMesh finer = refined(mesh, only(0, 2));
  EXPECT_EQ(std::ranges::count(finer.origin, 0), 4);
  EXPECT_EQ(std::ranges::count(finer.origin, 1), 1);
  expect_conforming(finer.mesh);
}

TEST(RefinedMesh, ProlongsALinearFieldExactly)
{
  const TriangleMesh mesh = tests::rectangle_mesh(4, 3, 5, 4);
  const auto field = [](const Vec2& x) { return 2 + 3 * x.x() - 0.7 * x.y(); };
  std::vector<double> values;
  for (const Vec2& x : mesh.nodes)
    values.push_back(field(x));
  const RefinedMesh finer = refined(mesh, only(7, mesh.triangles.size()));
  prolong(finer, values);
  ASSERT_EQ(values.size(), finer.mesh.nodes.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], field(finer.mesh.nodes[i]), 1e-14);
}
} // namespace
} // namespace berm::meshes
