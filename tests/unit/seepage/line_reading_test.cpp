// SPDX-License-Identifier: GPL-3.0-or-later
// Lines through fields that linear elements hold exactly: all tolerances are rounding.
#include "seepage/line_reading.h"

#include "core/error.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace berm::seepage
{
namespace
{
/// Head and stream function of uniform flow q in a 4 m x 2 m block of conductivity 1.
Solution uniform(const Vec2& q, double head_at_origin)
{
  Solution s;
  s.mesh = tests::rectangle_mesh(4, 2, 9, 5);
  for (const Vec2& x : s.mesh.nodes)
  {
    s.head.push_back(head_at_origin - q.dot(x));
    s.pore_pressure.push_back(water_unit_weight * (s.head.back() - x.y()));
    s.stream_function.push_back(q.x() * x.y() - q.y() * x.x());
  }
  s.flux.assign(s.mesh.triangles.size(), q);
  return s;
}

TEST(LineReading, SamplesUniformFlowExactly)
{
  const Vec2 q(0.3, -0.1);
  const Polyline points{{0.2, 0.3}, {3.2, 0.3}, {3.2, 1.8}};
  const LineReading line = read_lines(uniform(q, 5), {{points, 10}}).front();
  EXPECT_NEAR(line.length, 4.5, 1e-14);
  ASSERT_EQ(line.samples.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
  {
    const LineSample& s = line.samples[i];
    const double distance = 0.5 * static_cast<double>(i);
    const Vec2 at = distance < 3 ? Vec2(0.2 + distance, 0.3) : Vec2(3.2, 0.3 + distance - 3);
    EXPECT_NEAR(s.distance, distance, 1e-14);
    EXPECT_LT((s.at - at).norm(), 1e-13);
    EXPECT_NEAR(s.head, 5 - q.dot(at), 1e-13);
    EXPECT_NEAR(s.pore_pressure, water_unit_weight * (5 - q.dot(at) - at.y()), 1e-9);
    EXPECT_LT((s.flux - q).norm(), 1e-14);
    EXPECT_NEAR(s.gradient, q.norm(), 1e-13);
  }
}

TEST(LineReading, DischargeIsPositiveToTheLeft)
{
  const Vec2 q(0.3, -0.1);
  Solution s = uniform(q, 5);
  const std::vector<Line> lines = {{{{1, 0}, {1, 2}}},     // up: the left is where x falls
                                   {{{1, 2}, {1, 0}}},     // and down
                                   {{{0.5, 1}, {3.5, 1}}}, // to the right: the left is up
                                   {{{1, 0.5}, {2, 1.5}, {1, 0.5 + 1e-3}}}}; // there and back
  const std::array<double, 4> expected = {-0.6, 0.6, -0.3, -3e-4};
  for (const bool has_psi : {true, false})
  {
    if (!has_psi)
      s.stream_function.clear();
    const std::vector<LineReading> readings = read_lines(s, lines);
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(readings[i].by_stream_function, has_psi);
      EXPECT_NEAR(readings[i].discharge, expected[i], 1e-13) << i << has_psi;
    }
  }
}

TEST(LineReading, FluxJumpsWhereSoilsMeet)
{
  Solution s = uniform({0, 0}, 3);
  for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t) // upper rows of another soil
  {
    double y = 0;
    for (const Index i : s.mesh.triangles[t])
      y += s.mesh.nodes[static_cast<std::size_t>(i)].y() / 3;
    s.mesh.triangle_soil[t] = y > 0.8 ? 1 : 0;
    s.flux[t] = y > 0.8 ? Vec2(1, 0) : Vec2(0.25, 0);
  }
  const LineReading line = read_lines(s, {{{{2.01, 0}, {2.01, 2}}, 201}}).front();
  for (const LineSample& sample : line.samples)
    if (std::abs(sample.at.y() - 0.8) > 1e-9)
    {
      EXPECT_NEAR(sample.flux.x(), sample.at.y() > 0.8 ? 1 : 0.25, 1e-14);
    }
}

// Still water up to y = 3 under a level base at y = 1, drawn from left to right, soil below:
// gamma 2 m upwards on 4 m.
TEST(WaterForce, OfStillWaterUnderALevelBaseIsUpliftInItsMiddle)
{
  const WaterForce w = read_lines(uniform({0, 0}, 3), {{{{0, 1}, {4, 1}}, 2}}).front().water;
  EXPECT_NEAR(w.force.x(), 0, 1e-9);
  EXPECT_NEAR(w.force.y(), 8 * water_unit_weight, 1e-8);
  EXPECT_NEAR(w.pressure, 8 * water_unit_weight, 1e-8);
  EXPECT_NEAR(w.distance, 2, 1e-12);
  EXPECT_NEAR(w.moment, 16 * water_unit_weight, 1e-8);
  EXPECT_LT((w.at - Vec2(2, 1)).norm(), 1e-12);
}

// Still water of depth H = 1.5 m on a wall of 2 m drawn upwards: gamma H^2 / 2 to the left, at H /
// 3; what stands above the water is under suction and pulls nothing.
TEST(WaterForce, OfStillWaterOnAWallActsAtAThirdOfItsDepth)
{
  const double H = 1.5;
  const WaterForce w = read_lines(uniform({0, 0}, H), {{{{4, 0}, {4, 2}}, 5}}).front().water;
  EXPECT_NEAR(w.force.x(), -water_unit_weight * H * H / 2, 1e-8);
  EXPECT_NEAR(w.force.y(), 0, 1e-9);
  EXPECT_NEAR(w.distance, H / 3, 1e-12);
  EXPECT_NEAR(w.moment, w.distance * w.pressure, 1e-8);
}

// A closed line round soil under water, counter-clockwise, the left inside: Archimedes' force
// upwards, none sideways, through the centroid.
TEST(WaterForce, RoundABodyIsItsBuoyancy)
{
  const Polyline triangle{{0.5, 0.25}, {3, 0.5}, {1.5, 1.75}, {0.5, 0.25}};
  const WaterForce w = read_lines(uniform({0, 0}, 9), {{triangle, 50}}).front().water;
  const Vec2 a = triangle[0], b = triangle[1], c = triangle[2];
  const double area = ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
  EXPECT_NEAR(w.force.x(), 0, 1e-8);
  EXPECT_NEAR(w.force.y(), water_unit_weight * area, 1e-8);
  EXPECT_NEAR(w.moment, ((a + b + c) / 3 - a).x() * water_unit_weight * area, 1e-8);
}

TEST(WaterForce, OfDryGroundIsNothing)
{
  const WaterForce w = read_lines(uniform({0, 0}, -1), {{{{0, 1}, {4, 1}}, 2}}).front().water;
  EXPECT_EQ(w.pressure, 0);
  EXPECT_EQ(w.distance, 0);
}

TEST(LineReading, OfALineOutsideTheMeshIsAnErrorWithItsPlace)
{
  try
  {
    static_cast<void>(read_lines(uniform({0, 0}, 3), {{{{1, 1}, {1, 2.5}}, 3}}));
    FAIL();
  }
  catch (const NumericalError& e)
  {
    EXPECT_NE(std::string(e.what()).find("(1, 2"), std::string::npos) << e.what();
  }
}
} // namespace
} // namespace berm::seepage
