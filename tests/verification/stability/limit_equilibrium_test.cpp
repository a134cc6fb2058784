// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim L-1 of docs/verification.md: critical circles against published and independently computed
/// Bishop and Spencer factors, within 0.5 %, the agreement between published programs.
#include "coupling/limit_equilibrium.h"
#include "tests/support/measured.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
struct Row
{
  const char* name;
  Polyline ground;
  double base;
  double c, phi, gamma; ///< kPa, degrees, kN/m3
  Polyline free_surface;
  bool moves_right;
  double bishop, spencer; ///< 0: not given
};

constexpr double foot = 0.3048;
const Polyline griffiths_lane = {{0, 10}, {12, 10}, {32, 0}};
const Polyline submerged = {
    {0, 15 * foot}, {30 * foot, 15 * foot}, {105 * foot, 45 * foot}, {140 * foot, 45 * foot}};

std::vector<Row> rows()
{
  const Polyline dam = tests::embankment().ground;
  const double c6 = 100 * 0.0478803, g6 = 128 * 0.157087, width6 = 140 * foot;
  return {
      {"embankment_dry", dam, 0, 13.8, 37, 18.2, {}, true, 2.450, 2.448},
      {"embankment_line",
       dam,
       0,
       13.8,
       37,
       18.2,
       {{86.75, 24.4}, {157.9, 7.3}},
       true,
       1.908,
       1.916},
      {"griffiths_lane_1", griffiths_lane, 0, 10, 20, 20, {}, true, 1.378, 1.376},
      {"drawdown_none", griffiths_lane, 0, 10, 20, 20, {{0, 10}, {32, 10}}, true, 1.823, 0},
      {"drawdown_half", griffiths_lane, 0, 10, 20, 20, {{0, 5}, {32, 5}}, true, 1.352, 0},
      {"drawdown_full", griffiths_lane, 0, 10, 20, 20, {{0, 0}, {32, 0}}, true, 1.378, 0},
      {"undrained", {{0, 20}, {20, 20}, {40, 10}, {80, 10}}, 0, 50, 0, 20, {}, true, 1.4716, 0},
      // Taylor's number for circles through the toe of a vertical cut: gamma H / c = 1 / 0.261.
      {"vertical_cut",
       {{0, 10}, {20, 10}, {20, 20}, {40, 20}},
       0,
       0.261 * 200,
       0,
       20,
       {},
       false,
       1.0,
       0},
      {"acads_1a", {{20, 25}, {30, 25}, {50, 35}, {70, 35}}, 20, 3, 19.6, 20, {}, false, 0.987, 0},
      {"submerged",
       submerged,
       0,
       c6,
       20,
       g6,
       {{0, 75 * foot}, {width6, 75 * foot}},
       false,
       1.60,
       0},
  };
}

std::optional<SlipCircle> solve(const Row& row)
{
  meshes::SectionInput input;
  input.ground = row.ground;
  input.base = {{row.ground.front().x(), row.base}, {row.ground.back().x(), row.base}};
  const meshes::Section section = meshes::build_section(input);
  sph::Soil soil = tests::embankment_soil();
  soil.density = soil.saturated_density = row.gamma * 1e3 / gravity;
  soil.cohesion = row.c * 1e3;
  soil.friction_angle = row.phi * pi / 180;
  const std::vector<sph::Soil> soils = {soil};
  const PorePressure p_w =
      row.free_surface.empty() ? no_pore_pressure() : hydrostatic_pore_pressure(row.free_surface);
  return critical_circle({section, soils, p_w}, row.moves_right, 0);
}
} // namespace

class LimitEquilibrium : public testing::TestWithParam<Row>
{
};

TEST_P(LimitEquilibrium, FindsThePublishedFactor)
{
  const auto circle = solve(GetParam());
  ASSERT_TRUE(circle.has_value());
  tests::expect_measured("L-1 Bishop", circle->bishop, GetParam().bishop,
                         0.005 * GetParam().bishop);
  if (GetParam().spencer > 0)
  {
    ASSERT_TRUE(circle->spencer.has_value());
    tests::expect_measured("L-1 Spencer", *circle->spencer, GetParam().spencer,
                           0.005 * GetParam().spencer);
  }
}

INSTANTIATE_TEST_SUITE_P(Slopes, LimitEquilibrium, testing::ValuesIn(rows()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(LimitEquilibriumInvariance, TheDepthOfThePoolDoesNotMatter)
{
  for (Row row : rows())
    if (row.name == std::string("submerged") || row.name == std::string("drawdown_none"))
    {
      const auto shallow = solve(row);
      for (Vec2& p : row.free_surface)
        p.y() += 20;
      const auto deep = solve(row);
      ASSERT_TRUE(shallow && deep);
      ASSERT_TRUE(shallow->spencer && deep->spencer);
      EXPECT_NEAR(deep->bishop / shallow->bishop, 1, 1e-9);     // rounding
      EXPECT_NEAR(*deep->spencer / *shallow->spencer, 1, 1e-7); // its iteration's tolerance
    }
}

/// Without friction, the moments on a circle are  c (L_reduced / F + L_held) R = M.
TEST(LimitEquilibriumInRegions, HeldSoilKeepsItsStrengthOnACircle)
{
  meshes::SectionInput input;
  input.ground = {{0, 20}, {20, 20}, {40, 10}, {80, 10}};
  input.base = {{0, 0}, {80, 0}};
  const meshes::Section section = meshes::build_section(input);
  sph::Soil soil = tests::embankment_soil();
  soil.cohesion = 50e3;
  soil.friction_angle = 0;
  const std::vector<sph::Soil> soils = {soil};
  const PorePressure dry = no_pore_pressure();
  const Vec2 centre{30, 27.8};
  const double radius = 25, x_held = 20; // a kink of the ground: a border of slices
  const auto free = evaluate_circle({section, soils, dry}, centre, radius, true, 200);
  ASSERT_TRUE(free);
  Region region;
  const auto same = evaluate_circle({section, soils, dry, &region}, centre, radius, true, 200);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->bishop, free->bishop);

  const auto angle = [&](double x) { return std::asin((x - centre.x()) / radius); };
  const double held =
      (angle(x_held) - angle(free->x_left)) / (angle(free->x_right) - angle(free->x_left));
  region.x_left = x_held;
  const auto found = evaluate_circle({section, soils, dry, &region}, centre, radius, true, 200);
  ASSERT_TRUE(found);
  tests::expect_measured("F-8 Bishop with part of a circle held", found->bishop,
                         (1 - held) / (1 / free->bishop - held),
                         2e-3);  // one slice more or less
  region.x_left = free->x_right; // all of it is held: with F > 1 it stands whatever the factor
  EXPECT_FALSE(evaluate_circle({section, soils, dry, &region}, centre, radius, true, 200));
}

TEST(LimitEquilibriumInvariance, AMirroredSlopeHasTheSameFactor)
{
  Row row = rows()[1];
  const auto right = solve(row);
  for (Polyline* line : {&row.ground, &row.free_surface})
  {
    std::reverse(line->begin(), line->end());
    for (Vec2& p : *line)
      p.x() = 191.4 - p.x();
  }
  row.moves_right = false;
  const auto left = solve(row);
  ASSERT_TRUE(right && left);
  EXPECT_NEAR(left->bishop / right->bishop, 1,
              1e-4); // the search ends at steps of 1e-4 of the width
}

TEST(LimitEquilibriumInvariance, TheEmbankmentsCirclesAreThoseOfTheReference)
{
  const auto dry = solve(rows()[0]), line = solve(rows()[1]);
  ASSERT_TRUE(dry && line);
  EXPECT_NEAR(dry->x_left, 104.2, 0.5);
  EXPECT_NEAR(dry->x_right, 157.9, 0.5);
  EXPECT_NEAR(line->x_left, 103.4, 0.5);
  EXPECT_NEAR(line->x_right, 165.5, 0.5);
}
} // namespace berm::coupling
