// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim: sections that columns cannot fill well, or at all, are as good on other packings.
#include "coupling/analysis.h"

#include <cmath>
#include <gtest/gtest.h>

namespace berm
{
namespace
{
sph::Soil soil(double cohesion, double friction_deg)
{
  sph::Soil s;
  s.density = s.saturated_density = 20e3 / gravity;
  s.cohesion = cohesion;
  s.friction_angle = friction_deg * pi / 180;
  s.dilation_angle = 0;
  s.young_modulus = 1e8;
  s.poisson_ratio = 0.3;
  return s;
}

double factor(const meshes::SectionInput& section, const std::vector<sph::Soil>& soils,
              const std::string& packing, double spacing = 0.5)
{
  coupling::Case input;
  input.section = section;
  for (const sph::Soil& s : soils)
    input.soils.push_back({.name = "soil", .mechanical = s, .conductivity = {}});
  input.sph.spacing = spacing;
  input.sph.packing = packing;
  Observer silent;
  const coupling::Analysis a = coupling::analyse(input, silent);
  const sph::FactorOfSafety& F = a.stability.value().governing().F;
  EXPECT_TRUE(F.complete) << F.reason;
  return F.factor().value_or(0);
}

/// A cut in clay, 10 m high, leaning back below 90 degrees and forward above.
meshes::SectionInput cut(double degrees)
{
  const double lean = 10 / std::tan(degrees * pi / 180);
  meshes::SectionInput input;
  input.outline = {{0, 0}, {40, 0}, {40, 5}, {20, 5}, {20 - lean, 15}, {0, 15}};
  return input;
}

/// Within 2 %: what a packing may cost, of which the two brackets take 0.8.
void expect_factor_on_other_packings(const meshes::SectionInput& section,
                                     const std::vector<sph::Soil>& soils, double F)
{
  const auto expect = [&](const char* packing, double spacing)
  {
    EXPECT_NEAR(factor(section, soils, packing, spacing) / F, 1, 0.02) << packing << " " << spacing;
  };
  expect("lattice", 0.5);
  expect("hexagonal", 0.5);
#ifdef BERM_WITH_SEEPAGE
  // Five meshes: one may be right by chance.
  for (const double spacing : {0.48, 0.49, 0.5, 0.51, 0.52})
    expect("mesh", spacing);
#endif
}
} // namespace

// The factor falls evenly as the cut leans over; nothing happens at 90 degrees, where columns end.
TEST(PackingOfShapes, AnOverhangIsTheEvenContinuationOfASteepCut)
{
  const std::vector<sph::Soil> clay = {soil(1.2 * 20e3 * 10 / 3.7765, 0)};
  std::vector<double> F;
  for (const double degrees : {80, 85, 90, 95, 100})
    F.push_back(factor(cut(degrees), clay, "lattice"));
  for (std::size_t k = 1; k < F.size(); ++k)
    EXPECT_LT(F[k], F[k - 1]);
  const double second_difference = F[1] - 2 * F[2] + F[3];
  EXPECT_NEAR(second_difference, 0, 0.02 * F[2] + 0.02); // and the width of the brackets
  EXPECT_NEAR(F[2], 1.2, 0.02 * 1.2);                    // the rigorous bound's cohesion, times 1.2
  expect_factor_on_other_packings(cut(95), clay, F[3]);
}

TEST(PackingOfShapes, CurvedGroundHasTheFactorOfColumns)
{
  meshes::SectionInput input;
  input.ground = {{0, 5}, {10, 5}};
  for (int degrees = 3; degrees < 61; degrees += 3)
  {
    const double t = degrees * pi / 180;
    input.ground.emplace_back(10 + 20 * std::sin(t), 25 - 20 * std::cos(t));
  }
  input.ground.emplace_back(45, input.ground.back().y());
  input.base = {{0, 0}, {45, 0}};
  const std::vector<sph::Soil> fill = {soil(10e3, 25)};
  expect_factor_on_other_packings(input, fill, factor(input, fill, "columns"));
}

TEST(PackingOfShapes, ZonesHaveTheFactorOfColumns)
{
  meshes::SectionInput input;
  input.ground = {{0, 5}, {20, 5}, {40, 15}, {48, 15}, {68, 5}, {90, 5}};
  input.base = {{0, 0}, {90, 0}};
  input.zones = {{.soil = 2, .polygon = {{0, 0}, {90, 0}, {90, 3}, {0, 4}}},
                 {.soil = 1, .polygon = {{36, 0}, {52, 0}, {46, 15}, {42, 15}}}};
  const std::vector<sph::Soil> soils = {soil(5e3, 33), soil(20e3, 15), soil(10e3, 18)};
  expect_factor_on_other_packings(input, soils, factor(input, soils, "columns"));
}
} // namespace berm
