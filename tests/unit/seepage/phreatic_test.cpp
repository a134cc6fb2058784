// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/phreatic.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berm::seepage
{
namespace
{
std::vector<double> sample(const meshes::TriangleMesh& mesh, auto f)
{
  std::vector<double> values;
  for (const Vec2& x : mesh.nodes)
    values.push_back(f(x));
  return values;
}

TEST(ZeroContours, OfALinearFieldIsItsStraightLine)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(6, 3, 12, 7);
  const auto p = [](const Vec2& x) { return 2.1 - 0.2 * x.x() - x.y(); };
  const std::vector<Polyline> lines = zero_contours(mesh, sample(mesh, p));
  ASSERT_EQ(lines.size(), 1);
  EXPECT_NEAR((lines[0].front() - Vec2(0, 2.1)).norm(), 0, 1e-14);
  EXPECT_NEAR((lines[0].back() - Vec2(6, 0.9)).norm(), 0, 1e-14);
  for (const Vec2& x : lines[0])
    EXPECT_NEAR(p(x), 0, 1e-14);
  EXPECT_TRUE(std::ranges::is_sorted(lines[0], {}, [](const Vec2& x) { return x.x(); }));
}

TEST(ZeroContours, AreSortedByLength)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(6, 3, 24, 12);
  const auto p = [](const Vec2& x) { return (x.y() - 2.6) * (x.y() - 0.4 - 0.3 * x.x()); };
  const std::vector<Polyline> lines = zero_contours(mesh, sample(mesh, p));
  ASSERT_EQ(lines.size(), 2);
  EXPECT_NEAR(lines[0].front().y(), 0.4, 0.1); // 6.26 m against 6 m
}

TEST(ZeroContours, AroundALensIsClosed)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 4, 16, 16);
  const auto p = [](const Vec2& x) { return 1.1 - (x - Vec2(2, 2)).norm(); };
  const std::vector<Polyline> lines = zero_contours(mesh, sample(mesh, p));
  ASSERT_EQ(lines.size(), 1);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  double length = 0;
  for (std::size_t k = 1; k < lines[0].size(); ++k)
    length += (lines[0][k] - lines[0][k - 1]).norm();
  EXPECT_NEAR(length, 2 * pi * 1.1, 0.05); // a polygon of about 30 sides: 0.7 % short
}

TEST(ZeroContours, OfAnAllWetFieldAreNone)
{
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(2, 2, 4, 4);
  EXPECT_TRUE(zero_contours(mesh, sample(mesh, [](const Vec2& x) { return 3 - x.y(); })).empty());
}

TEST(ZeroContours, EndAtTheLastWetNodeOfASeepageFace)
{
  // On x = 4: p = 0 up to y = 1 and below zero above it; inside wet below y = 1 + (4 - x) / 4.
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 2, 8, 8);
  const auto p = [](const Vec2& x)
  { return x.x() == 4 ? std::min(0.0, 1 - x.y()) : 1 + (4 - x.x()) / 4 - x.y(); };
  const std::vector<Polyline> lines = zero_contours(mesh, sample(mesh, p));
  ASSERT_EQ(lines.size(), 1);
  EXPECT_EQ(lines[0].back(), Vec2(4, 1));
}

TEST(ZeroContours, IgnoreNodesAtZeroWithoutWetNeighbours)
{
  // A drain along the base, p = 0, is wet only below the wet part of the soil, x <= 2.
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 2, 8, 8);
  const auto p = [](const Vec2& x) { return x.y() == 0 ? 0.0 : 2.1 - x.x() - x.y(); };
  const std::vector<Polyline> lines = zero_contours(mesh, sample(mesh, p));
  ASSERT_EQ(lines.size(), 1);
  EXPECT_LE(lines[0].back().x(), 2.5); // within an element of where the wet part ends
}

/// The right side of a 4 m x 2 m rectangle as a potential seepage face, wet up to y = 1.
struct Face
{
  meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 2, 8, 8);
  NodeConditions conditions;
  std::vector<double> entering;
  std::vector<Polyline> contours{{{0, 1.5}, {2, 1.4}, {4, 1}}};

  Face() : entering(mesh.nodes.size(), 0)
  {
    conditions.kind.assign(mesh.nodes.size(), NodeKind::interior);
    for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    {
      const auto [i, j] = mesh.boundary[e];
      if (mesh.nodes[static_cast<std::size_t>(i)].x() == 4 &&
          mesh.nodes[static_cast<std::size_t>(j)].x() == 4)
      {
        conditions.face_edges.push_back(static_cast<Index>(e));
        conditions.kind[static_cast<std::size_t>(i)] =
            conditions.kind[static_cast<std::size_t>(j)] = NodeKind::face;
      }
    }
  }
  double& entering_at(double y)
  {
    return entering[static_cast<std::size_t>(std::ranges::find(mesh.nodes, Vec2(4, y)) -
                                             mesh.nodes.begin())];
  }
};

TEST(ExitPoint, LiesWhereAUniformOutflowWouldEnd)
{
  // Uniform outflow of 3 m/s up to y = 0.9, lumped with the linear shape functions on edges of 0.25
  // m: 0.6 of the last edge, Q_A = 3 * 0.25 * 0.6^2 / 2. B carries full edges on both sides as far
  // as the estimate knows: 3 * 0.25.
  Face face;
  face.entering_at(0.75) = -3 * 0.25;
  face.entering_at(1) = -3 * 0.25 * 0.36 / 2;
  const auto exit = find_exit(face.mesh, face.conditions, face.entering, face.contours);
  ASSERT_TRUE(exit);
  EXPECT_NEAR((*exit - Vec2(4, 0.9)).norm(), 0, 1e-14);
  EXPECT_EQ(face.contours[0].back(), *exit);
}

TEST(ExitPoint, IsNotAboveTheLastWetNode)
{
  Face face;
  face.entering_at(0.75) = -1;
  face.entering_at(1) = -5;
  EXPECT_EQ(find_exit(face.mesh, face.conditions, face.entering, face.contours), Vec2(4, 1));
}

TEST(ExitPoint, IsHalfwayDownTheEdgeIfWaterStandsBelowIt)
{
  Face face;
  face.entering_at(0.75) = -1;
  face.entering_at(1) = -0.1;
  face.conditions.kind[static_cast<std::size_t>(std::ranges::find(face.mesh.nodes, Vec2(4, 0.75)) -
                                                face.mesh.nodes.begin())] = NodeKind::head;
  EXPECT_EQ(find_exit(face.mesh, face.conditions, face.entering, face.contours), Vec2(4, 0.875));
}

TEST(ExitPoint, IsNothingIfNoContourEndsOnTheFace)
{
  Face face;
  face.contours = {{{0, 1.5}, {2, 0}}};
  EXPECT_FALSE(find_exit(face.mesh, face.conditions, face.entering, face.contours));
  face.contours.clear();
  EXPECT_FALSE(find_exit(face.mesh, face.conditions, face.entering, face.contours));
}
} // namespace
} // namespace berm::seepage
