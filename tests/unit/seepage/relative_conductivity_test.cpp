// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/relative_conductivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berm::seepage
{
namespace
{
constexpr double eps = 0.2, k_min = 1e-4;

const RelativeConductivity sharp = on_mesh(law_of({}), eps, k_min);

TEST(RelativeConductivity, IsOneWhereWetAndTheFloorFarAbove)
{
  EXPECT_EQ(relative_conductivity(sharp, 5, 1), 1);
  EXPECT_EQ(relative_conductivity(sharp, eps, 1), 1);
  EXPECT_NEAR(relative_conductivity(sharp, -100, 1), k_min, 1e-18);
}

TEST(RelativeConductivity, IsOneAtZeroPressureOnASeepageFaceAndOneOverEInside)
{
  EXPECT_EQ(relative_conductivity(sharp, 0, 0), 1);
  EXPECT_DOUBLE_EQ(relative_conductivity(sharp, 0, 1), k_min + (1 - k_min) / std::exp(1));
}

TEST(RelativeConductivity, AddsNoTransmissivityToTheFreeSurface)
{
  // int k_r dp over [-infinity, eps] is eps: what the soil loses below p = eps it gains above p =
  // 0.
  constexpr int n = 200'000;
  constexpr double low = -40 * eps, step = (eps - low) / n;
  double sum = 0;
  for (int k = 0; k < n; ++k)
    sum += relative_conductivity(on_mesh(law_of({}), eps, 0), low + (k + 0.5) * step, 1) * step;
  EXPECT_NEAR(sum, eps, 1e-9); // midpoint rule: step^2 / 24
}

/// int k_r dp below eps, k_min = 0.
double transmissivity(double p)
{
  return p < eps ? eps * std::exp((p - eps) / eps) : p;
}

TEST(MovedPressure, IsNewtonsWhereWet)
{
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, 1, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, 1, -0.5), 0.5);
}

TEST(MovedPressure, WhereWettingMovesTheTransmissivityByTheCorrection)
{
  for (const double p : {-0.5, -0.1, 0.0, 0.1})
    for (const double correction : {0.01, 0.3, 4.0})
      EXPECT_NEAR(transmissivity(moved_pressure(sharp, p, correction)),
                  transmissivity(p) + std::exp((p - eps) / eps) * correction, 1e-14);
}

TEST(MovedPressure, SmallCorrectionsAreNewtons)
{
  EXPECT_NEAR(moved_pressure(sharp, -0.3, 1e-6), -0.3 + 1e-6,
              1e-11); // second order: d^2 / (2 eps)
}

TEST(MovedPressure, IsNewtonsWhereTheFloorGoverns)
{
  const double p_dry = eps * (1 + std::log(k_min));
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, -9, 2), -7);
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, -9, -2), -11);
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, p_dry - 1, 1), p_dry);
  // Beyond p_dry the rest of the correction wets.
  EXPECT_NEAR(moved_pressure(sharp, p_dry - 1, 3), moved_pressure(sharp, p_dry, 2), 1e-14);
}

TEST(MovedPressure, DriesByTwoSmoothingLengthsAtMost)
{
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, 3, -50), -eps);
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, -0.1, -50), -0.1 - 2 * eps);
  EXPECT_DOUBLE_EQ(moved_pressure(sharp, -0.1, -0.2), -0.3);
}

//------------------------------------------------------------------------------------------------
// Soils with a retention curve
//------------------------------------------------------------------------------------------------

Retention gardner(double alpha)
{
  return {.model = RetentionModel::gardner, .alpha = alpha, .n = 0, .l = 0.5, .air_entry = 0};
}

Retention van_genuchten(double alpha, double n, double air_entry, double l = 0.5)
{
  return {RetentionModel::van_genuchten, alpha, n, l, air_entry};
}

/// Mualem's conductivity as it is printed, from the saturation.
double mualem(const Retention& r, double suction)
{
  const double m = 1 - 1 / r.n, s_e = std::pow(1 + std::pow(r.alpha * suction, r.n), -m);
  return std::pow(s_e, r.l) * std::pow(1 - std::pow(1 - std::pow(s_e, 1 / m), m), 2);
}

/// int k_r dp over [from, to] by the midpoint rule.
double conducted(const RelativeConductivity& law, double from, double to)
{
  constexpr int n = 200'000;
  const double step = (to - from) / n;
  double sum = 0;
  for (int k = 0; k < n; ++k)
    sum += relative_conductivity(law, from + (k + 0.5) * step, 1) * step;
  return sum;
}

TEST(GardnersConductivity, IsItsExponentialWhereTheMeshShowsIt)
{
  for (const double alpha : {0.5, 2.0, 5.0})
    for (const double p : {-3.0, -0.1, 0.0, 2.0})
      EXPECT_NEAR(relative_conductivity(on_mesh(law_of(gardner(alpha)), eps, 0), p, 1),
                  std::min(std::exp(alpha * p), 1.0), 1e-15);
}

TEST(GardnersConductivity, OfACoarseMeshConductsInTheFringeWhatTheCurveDoes)
{
  for (const double alpha : {5.0, 8.0, 100.0})
  {
    const RelativeConductivity law = on_mesh(law_of(gardner(alpha)), eps, 0);
    // Surplus above p = 0 less what is missing below: 1 / alpha.
    EXPECT_NEAR(conducted(law, -40 * eps, eps) - eps, 1 / alpha, 1e-9); // step^2 / 24
  }
}

TEST(GardnersConductivity, BecomesTheSharpOneAsAlphaGrows)
{
  for (const double p : {-1.0, -0.1, 0.1, 0.3})
    EXPECT_NEAR(relative_conductivity(on_mesh(law_of(gardner(1e9)), eps, k_min), p, 1),
                relative_conductivity(sharp, p, 1), 1e-8); // shift differs by 1 / alpha
}

TEST(VanGenuchtensConductivity, IsMualemsOfTheSaturation)
{
  for (const Retention& r :
       {van_genuchten(14.5, 2.68, 0), van_genuchten(1, 2, 0), van_genuchten(3, 4, 0, -1)})
    for (const double suction : {0.01, 0.1, 0.3, 1.0})
      // Above n = 2 without air entry the curve ends at alpha s = 1e-5: k_r = 1 - 2e-5 there.
      EXPECT_NEAR(relative_conductivity(on_mesh(law_of(r), 1e-9, 0), -suction, 1),
                  mualem(r, suction), 2.1e-5);
}

TEST(VanGenuchtensConductivity, IsOneUpToTheAirEntryAndKeepsItsShapeBeyond)
{
  for (const Retention& r : {van_genuchten(0.8, 1.09, 0.02), van_genuchten(3.6, 1.56, 0.1),
                             van_genuchten(2, 1.05, 0.02)})
  {
    const RelativeConductivity law = on_mesh(law_of(r), 1e-9, 0);
    EXPECT_NEAR(relative_conductivity(law, -r.air_entry, 1), 1, 1e-14);
    EXPECT_NEAR(relative_conductivity(law, 3, 1), 1, 1e-14);
    for (const double suction : {1.1, 3.0, 30.0})
      EXPECT_NEAR(relative_conductivity(law, -suction * r.air_entry, 1),
                  mualem(r, suction * r.air_entry) / mualem(r, r.air_entry), 1e-12);
  }
}

TEST(VanGenuchtensConductivity, OfACoarseMeshConductsInTheFringeWhatTheCurveDoes)
{
  const Retention r = van_genuchten(7.5, 1.89, 0.02);
  const RelativeConductivity fine = on_mesh(law_of(r), 1e-9, 0), coarse = on_mesh(law_of(r), 1, 0);
  EXPECT_NEAR(fine.shift(), 0, 1e-15); // rounding
  EXPECT_GT(coarse.shift(), 0.3);
  // Both reach to alpha s = 3000; beyond, less than 3000^-2.8 of the integral. Simpson: 1e-6.
  EXPECT_NEAR(conducted(coarse, -3000, 2) - 2, conducted(fine, -400, 0), 2e-4);
}

TEST(VanGenuchtensConductivity, IsANumberAtAnySuction)
{
  for (const double n : {1.05, 2.0, 20.0})
    for (const double l : {-1.0, 10.0})
      for (const double p : {-1e12, -1e3, -1e-12, 0.0, 1e12})
      {
        const RelativeConductivity law =
            on_mesh(law_of(van_genuchten(1e3, n, 1e-3, l)), 1e-9, k_min);
        const double k_r = relative_conductivity(law, p, 1);
        EXPECT_TRUE(k_r >= k_min && k_r <= 1 + 1e-12) << n << " " << l << " " << p << " " << k_r;
        for (const double correction : {-1e6, -1e-6, 1e-6, 1e6})
          EXPECT_TRUE(std::isfinite(moved_pressure(law, p, correction)))
              << n << " " << l << " " << p;
      }
}

TEST(MovedPressure, WhereVanGenuchtensSoilWetsMovesTheTransmissivityByTheCorrection)
{
  for (const Retention& r : {van_genuchten(14.5, 2.68, 0), van_genuchten(0.8, 1.09, 0.02)})
  {
    const RelativeConductivity law = on_mesh(law_of(r), 1e-9, 0);
    for (const double p : {-1.0, -0.2, -0.03})
      for (const double correction : {0.01, 0.3, 4.0, 100.0})
      {
        const double wanted = relative_conductivity(law, p, 1) * correction;
        const double moved = conducted(law, p, moved_pressure(law, p, correction));
        // Pieces of exponentials, half a growth length each: a step wants no more.
        EXPECT_NEAR(moved / wanted, 1, 0.25) << p << " " << correction;
      }
  }
}

TEST(MovedPressure, IsNewtonsWhereTheFloorOfVanGenuchtensSoilGoverns)
{
  const RelativeConductivity law = on_mesh(law_of(van_genuchten(14.5, 2.68, 0)), 1e-9, 1e-3);
  EXPECT_NEAR(moved_pressure(law, -50, 1), -49, 1e-3); // k_r is 1e-3 + 3e-15 there
  EXPECT_DOUBLE_EQ(moved_pressure(law, -50, -9), -59);
}
} // namespace
} // namespace berm::seepage
