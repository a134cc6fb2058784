// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/circle_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace berm::sph
{
namespace
{
/// @param[in] from, to  Angles from the x axis [rad].
Polyline arc(const Vec2& centre, double radius, double from, double to, int points)
{
  Polyline line;
  for (int k = 0; k < points; ++k)
  {
    const double angle = from + (to - from) * k / (points - 1);
    line.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return line;
}
} // namespace

TEST(CircleFit, IsExactOnArcsOfAnyLength)
{
  for (const double span : {0.05, 0.5, 1.5, 3.0, 6.0})
    for (const double radius : {0.5, 60.0, 4000.0})
    {
      const Vec2 centre{154.2, 76.5};
      const auto circle = fit_circle(arc(centre, radius, -2.5, -2.5 + span, 40));
      ASSERT_TRUE(circle.has_value()) << span << " " << radius;
      // The sagitta is span^2 / 8 of the radius, its square is what rounding of 1e-16 stands
      // against; the coordinates have rounding of their own, 1e-14 m.
      const double tolerance = (1e-13 * radius + 1e-12) / std::pow(std::min(span, 1.0), 4);
      EXPECT_NEAR(circle->radius, radius, tolerance) << span;
      EXPECT_NEAR((circle->centre - centre).norm(), 0, tolerance) << span;
      EXPECT_NEAR(circle->misfit, 0, 1e-9 * radius);
    }
}

TEST(CircleFit, IsNearlyUnbiasedOnANoisyShortArc)
{
  // The curvature of a parabola y = t^2 / 2R through n points over -h..h with noise s is known to
  // s sqrt(45 / n) / h^2: 1.6 % of R here, 0.11 % in the mean of 200. The bias of the fit is of
  // second order in s: a tenth of that spread for one arc is allowed for it.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.5, 0.5);
  const double radius = 50, half_angle = std::asin(0.5);
  double mean = 0, spread = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    Polyline line = arc({10, 80}, radius, -pi / 2 - half_angle, -pi / 2 + half_angle, 100);
    for (Vec2& p : line)
      p.y() += noise(random);
    const auto circle = fit_circle(line);
    ASSERT_TRUE(circle.has_value());
    mean += circle->radius / radius / 200;
    spread = std::max(spread, std::abs(circle->radius / radius - 1));
    EXPECT_NEAR(circle->misfit, 1 / std::sqrt(12.0), 0.05); // of uniform noise; its own spread .02
  }
  RecordProperty("mean_over_radius", std::to_string(mean));
  EXPECT_NEAR(mean, 1, 4 * 0.0011 + 0.0016);
  EXPECT_LT(spread, 4 * 0.016);
}

TEST(CircleFit, CountsLengthNotVertices)
{
  // A line half on a circle and half off it: crowding vertices on one half does not move the fit.
  Polyline coarse = arc({0, 0}, 10, -2.5, -1.5, 400);
  const Polyline other = arc({0, 0.5}, 10, -1.5, -0.5, 400);
  Polyline crowded = arc({0, 0}, 10, -2.5, -1.5, 4000);
  coarse.insert(coarse.end(), other.begin(), other.end());
  crowded.insert(crowded.end(), other.begin(), other.end());
  const auto a = fit_circle(coarse), b = fit_circle(crowded);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->radius / b->radius, 1, 1e-3); // the chords of 1/400 of the arc
  EXPECT_NEAR((a->centre - b->centre).norm(), 0, 1e-2);
}

TEST(CircleFit, MeasuresItsMisfit)
{
  Polyline line = arc({0, 0}, 10, -3, 3, 2001);
  for (std::size_t k = 0; k < line.size(); ++k)
    line[k] *= k % 2 == 0 ? 1.001 : 0.999; // in and out by 0.01
  const auto circle = fit_circle(line);
  ASSERT_TRUE(circle.has_value());
  EXPECT_NEAR(circle->radius, 10, 1e-4);
  EXPECT_NEAR(circle->misfit, 0.01, 1e-4);
}

TEST(CircleFit, FindsNoneOnAStraightLineNorForTwoPoints)
{
  EXPECT_FALSE(fit_circle({{0, 0}, {1, 0.5}, {2, 1}, {7, 3.5}}).has_value());
  EXPECT_FALSE(fit_circle({{0, 0}, {1, 0.5}}).has_value());
  EXPECT_FALSE(fit_circle({{1, 1}, {1, 1}, {1, 1}}).has_value());
}
} // namespace berm::sph
