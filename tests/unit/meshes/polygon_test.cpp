// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace berm::meshes
{
namespace
{
/// A comb with two teeth: not convex, area 10 * 2 + 2 * (2 * 6) = 44.
const Polyline comb = {{0, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {2, 2}, {2, 8}, {0, 8}};

Polyline regular_polygon(int corners, double radius, double first_angle)
{
  Polyline polygon;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = first_angle + 2 * pi * i / corners;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

TEST(PolygonArea, IsTheFormulaForRegularPolygons)
{
  for (const int n : {3, 4, 7, 100})
    EXPECT_NEAR(polygon_area(regular_polygon(n, 2, 0.3)), 0.5 * n * 4 * std::sin(2 * pi / n),
                1e-13);
}

TEST(PolygonArea, ChangesSignWithTheOrientationAndNotWithTheOrigin)
{
  EXPECT_DOUBLE_EQ(polygon_area(comb), 44);
  Polyline other(comb.rbegin(), comb.rend());
  EXPECT_DOUBLE_EQ(polygon_area(other), -44);
  for (Vec2& p : other)
    p += Vec2(3e6, -4e6); // coordinates of a national grid
  EXPECT_DOUBLE_EQ(polygon_area(other), -44);
}

TEST(PolygonArea, OfFewerThanThreePointsIsZero)
{
  EXPECT_EQ(polygon_area({}), 0);
  EXPECT_EQ(polygon_area({{1, 2}, {3, 4}}), 0);
}

TEST(PolygonContains, AgreesWithTheWindingAngle)
{
  for (double x = -0.95; x < 11; x += 0.7)
    for (double y = -0.95; y < 9; y += 0.7)
    {
      double angle = 0;
      for (std::size_t i = 0; i < comb.size(); ++i)
      {
        const Vec2 a = comb[i] - Vec2(x, y), b = comb[(i + 1) % comb.size()] - Vec2(x, y);
        angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      }
      EXPECT_EQ(polygon_contains(comb, {x, y}), angle > pi) << x << ", " << y;
    }
}

TEST(PolygonContains, CountsACornerOnTheRayOnce)
{
  const Polyline diamond = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  EXPECT_TRUE(polygon_contains(diamond, {0, 0}));
  EXPECT_FALSE(polygon_contains(diamond, {-2, 0}));
  EXPECT_FALSE(polygon_contains(diamond, {-1, 1}));
}

TEST(ClipToBox, OfACellInsideIsTheCellAndOutsideIsEmpty)
{
  EXPECT_DOUBLE_EQ(polygon_area(clip_to_box(comb, {0.5, 0.5}, {1, 1})), 0.25);
  EXPECT_DOUBLE_EQ(polygon_area(clip_to_box(comb, {4, 4}, {6, 6})), 0);
  EXPECT_TRUE(clip_to_box(comb, {20, 0}, {21, 1}).empty());
  EXPECT_DOUBLE_EQ(polygon_area(clip_to_box(comb, {-1, -1}, {11, 11})), 44);
}

TEST(ClipToBox, KeepsTheOrientation)
{
  const Polyline clockwise(comb.rbegin(), comb.rend());
  EXPECT_DOUBLE_EQ(polygon_area(clip_to_box(clockwise, {1, 1}, {9, 5})),
                   -polygon_area(clip_to_box(comb, {1, 1}, {9, 5})));
}

TEST(ClipToBox, OverAPartitionAddsUpToThePolygon)
{
  for (const Polyline& polygon : {comb, regular_polygon(7, 5, 0.2)})
  {
    double sum = 0;
    constexpr double d = 0.37;
    for (double x = -6; x < 11; x += d)
      for (double y = -6; y < 9; y += d)
        sum += polygon_area(clip_to_box(polygon, {x, y}, {x + d, y + d}));
    EXPECT_NEAR(sum, polygon_area(polygon), 1e-11); // 2000 cells, rounding only
  }
}

TEST(ClipToBox, AgreesWithCountingPoints)
{
  const Polyline polygon = regular_polygon(5, 4, 0.1);
  for (const auto& [lower, upper] : {std::pair<Vec2, Vec2>{{-1, -3}, {5, 2}},
                                     {{2, 0}, {6, 4}},
                                     {{-5, -5}, {0, 5}},
                                     {{3, -4}, {4, 4}}})
  {
    constexpr int n = 400;
    int inside = 0;
    const Vec2 size = upper - lower;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        inside += polygon_contains(
            polygon, lower + Vec2(size.x() * (i + 0.5) / n, size.y() * (j + 0.5) / n));
    const double counted = size.x() * size.y() * inside / (n * n);
    // Half of the cells that the border of at most 24 m crosses may be counted wrongly; most
    // cancel.
    const double tolerance = 24 * std::max(size.x(), size.y()) / n / 10;
    const Polyline clipped = clip_to_box(polygon, lower, upper);
    EXPECT_NEAR(polygon_area(clipped), counted, tolerance);
    for (const Vec2& p : clipped)
      EXPECT_TRUE((p.array() >= lower.array()).all() && (p.array() <= upper.array()).all());
  }
}
} // namespace
} // namespace berm::meshes
