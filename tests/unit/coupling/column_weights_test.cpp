// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/column_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace berm::coupling
{
namespace
{
/// A slope of 10 m, a heavier soil below y = 2 m, water below a line that falls from 8 m to 3 m.
meshes::Section slope()
{
  meshes::SectionInput input;
  input.ground = {{0, 10}, {10, 10}, {30, 4}, {40, 4}};
  input.base = {{0, 0}, {40, 0}};
  input.zones = {{1, {{0, 0}, {40, 0}, {40, 2}, {0, 2}}}};
  return meshes::build_section(input);
}

double water_level(double x)
{
  return 8 - x / 8;
}

TEST(ColumnWeights, AreThoseOfTheSoilsAndTheWater)
{
  const meshes::Section section = slope();
  std::vector<sph::Soil> soils(2);
  soils[0].density = 1800;
  soils[0].saturated_density = 2000;
  soils[1].density = soils[1].saturated_density = 2200;
  const PorePressure pressure = [](std::span<const double> x, std::span<const double> y)
  {
    std::vector<double> p;
    for (std::size_t i = 0; i < x.size(); ++i)
      p.push_back(9810 * (water_level(x[i]) - y[i]));
    return p;
  };
  const ColumnWeights weights(section, soils, pressure);
  for (const double x : {0.0, 3.3, 10.0, 17.77, 29.9, 40.0})
  {
    const double ground = meshes::ground_level(section, x);
    const double water = std::min(water_level(x), ground);
    for (const double low : {0.0, 0.7, 2.5})
    {
      const double wet = water - std::max(low, 2.0), dry = ground - water;
      const double exact = gravity * (2200 * std::max(2 - low, 0.0) + 2000 * wet + 1800 * dry);
      // A level within a piece of 10 m / 256: half of it times the step in density.
      EXPECT_NEAR(weights.between(x, low, ground), exact, 0.04 * gravity * 200) << x << " " << low;
    }
  }
}
} // namespace
} // namespace berm::coupling
