// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/newton.h"

#include <gtest/gtest.h>

#include <cmath>

namespace berm::seepage
{
namespace
{
constexpr double eps = 0.2, k_min = 1e-4;

TEST(RelativeConductivity, IsOneWhereWetAndTheFloorFarAbove)
{
  EXPECT_EQ(relative_conductivity(5, 1, eps, k_min), 1);
  EXPECT_EQ(relative_conductivity(eps, 1, eps, k_min), 1);
  EXPECT_NEAR(relative_conductivity(-100, 1, eps, k_min), k_min, 1e-18);
}

TEST(RelativeConductivity, IsOneAtZeroPressureOnASeepageFaceAndOneOverEInside)
{
  EXPECT_EQ(relative_conductivity(0, 0, eps, k_min), 1);
  EXPECT_DOUBLE_EQ(relative_conductivity(0, 1, eps, k_min), k_min + (1 - k_min) / std::exp(1));
}

TEST(RelativeConductivity, AddsNoTransmissivityToTheFreeSurface)
{
  // int k_r dp over [-infinity, eps] is eps: what the soil loses below p = eps it gains above p =
  // 0.
  constexpr int n = 200'000;
  constexpr double low = -40 * eps, step = (eps - low) / n;
  double sum = 0;
  for (int k = 0; k < n; ++k)
    sum += relative_conductivity(low + (k + 0.5) * step, 1, eps, 0) * step;
  EXPECT_NEAR(sum, eps, 1e-9); // midpoint rule: step^2 / 24
}

/// int k_r dp below eps, k_min = 0.
double transmissivity(double p)
{
  return p < eps ? eps * std::exp((p - eps) / eps) : p;
}

TEST(MovedPressure, IsNewtonsWhereWet)
{
  EXPECT_DOUBLE_EQ(moved_pressure(1, 0.5, eps, k_min), 1.5);
  EXPECT_DOUBLE_EQ(moved_pressure(1, -0.5, eps, k_min), 0.5);
}

TEST(MovedPressure, WhereWettingMovesTheTransmissivityByTheCorrection)
{
  for (const double p : {-0.5, -0.1, 0.0, 0.1})
    for (const double correction : {0.01, 0.3, 4.0})
      EXPECT_NEAR(transmissivity(moved_pressure(p, correction, eps, k_min)),
                  transmissivity(p) + std::exp((p - eps) / eps) * correction, 1e-14);
}

TEST(MovedPressure, SmallCorrectionsAreNewtons)
{
  EXPECT_NEAR(moved_pressure(-0.3, 1e-6, eps, k_min), -0.3 + 1e-6,
              1e-11); // second order: d^2 / (2 eps)
}

TEST(MovedPressure, IsNewtonsWhereTheFloorGoverns)
{
  const double p_dry = eps * (1 + std::log(k_min));
  EXPECT_DOUBLE_EQ(moved_pressure(-9, 2, eps, k_min), -7);
  EXPECT_DOUBLE_EQ(moved_pressure(-9, -2, eps, k_min), -11);
  EXPECT_DOUBLE_EQ(moved_pressure(p_dry - 1, 1, eps, k_min), p_dry);
  // Beyond p_dry the rest of the correction wets.
  EXPECT_NEAR(moved_pressure(p_dry - 1, 3, eps, k_min), moved_pressure(p_dry, 2, eps, k_min),
              1e-14);
}

TEST(MovedPressure, DriesByTwoSmoothingLengthsAtMost)
{
  EXPECT_DOUBLE_EQ(moved_pressure(3, -50, eps, k_min), -eps);
  EXPECT_DOUBLE_EQ(moved_pressure(-0.1, -50, eps, k_min), -0.1 - 2 * eps);
  EXPECT_DOUBLE_EQ(moved_pressure(-0.1, -0.2, eps, k_min), -0.3);
}
} // namespace
} // namespace berm::seepage
