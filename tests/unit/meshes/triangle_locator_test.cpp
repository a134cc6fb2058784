// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/triangle_locator.h"

#include "tests/support/meshes.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace berm::meshes
{
namespace
{
/// A structured mesh of a rectangle, sheared and stretched so that triangles differ in size and
/// shape.
TriangleMesh distorted_mesh()
{
  TriangleMesh mesh = tests::rectangle_mesh(build_section(tests::rectangle_input(16, 10)), 23, 17);
  for (Vec2& node : mesh.nodes)
    node = {node.x() * (1 + 0.03 * node.x()) + 0.3 * node.y(),
            node.y() * (1 + 0.05 * node.y()) + 0.02 * node.x() * node.x()};
  return mesh;
}

double value(const TriangleMesh& mesh, const TriangleLocator::Location& at,
             const std::function<double(const Vec2&)>& f)
{
  double sum = 0;
  for (std::size_t a = 0; a < 3; ++a)
    sum += at.weight[a] * f(mesh.nodes[std::size_t(mesh.triangles[std::size_t(at.triangle)][a])]);
  return sum;
}
} // namespace

TEST(TriangleLocator, AgreesWithBruteForceEverywhereInside)
{
  const TriangleMesh mesh = distorted_mesh();
  const TriangleLocator locator(mesh);
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 5000; ++k)
  {
    const auto t = static_cast<std::size_t>(unit(engine) * double(mesh.triangles.size()));
    double a = unit(engine), b = unit(engine);
    if (a + b > 1)
    {
      a = 1 - a;
      b = 1 - b;
    }
    const auto& c = mesh.triangles[t];
    const Vec2 point = (1 - a - b) * mesh.nodes[std::size_t(c[0])] +
                       a * mesh.nodes[std::size_t(c[1])] + b * mesh.nodes[std::size_t(c[2])];
    const auto at = locator.locate(point, 0.1);
    ASSERT_GE(at.triangle, 0);
    EXPECT_LT(at.shift, 1e-9);
    // A linear field is reproduced, whichever of two triangles holds a point on their edge.
    const auto f = [](const Vec2& p) { return 3 * p.x() - 2 * p.y() + 1; };
    EXPECT_NEAR(value(mesh, at, f), f(point), 1e-10);
  }
}

TEST(TriangleLocator, LosesNoNodeAndNoPointJustOutside)
{
  const TriangleMesh mesh = distorted_mesh();
  const TriangleLocator locator(mesh);
  const auto f = [](const Vec2& p) { return p.x() + p.y(); };
  for (const Vec2& node : mesh.nodes)
    for (const Vec2& nudge : {Vec2{0, 0}, Vec2{1e-8, 0}, Vec2{-1e-8, -1e-8}, Vec2{0, 1e-8}})
    {
      const auto at = locator.locate(node + nudge, 0.01);
      ASSERT_GE(at.triangle, 0);
      EXPECT_NEAR(value(mesh, at, f), f(node), 1e-7);
    }
}

TEST(TriangleLocator, MovesAnOutsidePointToTheNearestPointOfTheMesh)
{
  const TriangleMesh mesh =
      tests::rectangle_mesh(build_section(tests::rectangle_input(16, 10)), 8, 5);
  const TriangleLocator locator(mesh);
  const auto at = locator.locate({7.3, 10.4}, 1);
  ASSERT_GE(at.triangle, 0);
  EXPECT_NEAR(at.shift, 0.4, 1e-12);
  EXPECT_NEAR(value(mesh, at, [](const Vec2& p) { return p.x(); }), 7.3, 1e-12);
  EXPECT_NEAR(value(mesh, at, [](const Vec2& p) { return p.y(); }), 10, 1e-12);
  EXPECT_EQ(locator.locate({7.3, 12}, 1).triangle, -1);
}

TEST(TriangleLocator, AgreesWithBruteForceWhereAMeshIsMuchFinerInACorner)
{
  TriangleMesh mesh = tests::rectangle_mesh(build_section(tests::rectangle_input(1, 1)), 40, 40);
  for (Vec2& node : mesh.nodes)
    node = node.array().pow(4); // elements of 4e-7 beside one corner, of 0.1 at the other
  const TriangleLocator locator(mesh);
  const auto corner = [&](std::size_t t, std::size_t a) -> const Vec2&
  { return mesh.nodes[static_cast<std::size_t>(mesh.triangles[t][a])]; };
  const auto holds = [&](std::size_t t, const Vec2& p)
  {
    for (std::size_t a = 0; a < 3; ++a)
      if (polygon_area({corner(t, a), corner(t, (a + 1) % 3), p}) < 0)
        return false;
    return true;
  };
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> logarithm(-14, 0);
  for (int k = 0; k < 2000; ++k)
  {
    const Vec2 point(std::exp(logarithm(engine)), std::exp(logarithm(engine)));
    const auto at = locator.locate(point, 0.1);
    ASSERT_GE(at.triangle, 0);
    EXPECT_EQ(at.shift, 0);
    EXPECT_TRUE(holds(static_cast<std::size_t>(at.triangle), point)) << point.transpose();
    const auto below = locator.locate({point.x(), -0.05}, 0.1);
    EXPECT_NEAR(below.shift, 0.05, 1e-12);
    EXPECT_NEAR(value(mesh, below, [](const Vec2& p) { return p.x(); }), point.x(), 1e-12);
  }
}
} // namespace berm::meshes
