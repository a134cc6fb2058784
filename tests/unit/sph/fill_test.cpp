// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/fill.h"

#include "core/error.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
TEST(Fill, ColumnsKeepTheAreaExactly)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const double dx : {2.0, 1.3, 0.5})
  {
    const Particles p = fill(section, dx, "columns");
    const double area = meshes::polygon_area(section.outline);
    EXPECT_NEAR(tests::total(p.volume) / area, 1, 1e-12) << "dx = " << dx;
    EXPECT_NEAR(static_cast<double>(p.size()) * dx * dx / area, 1, 0.02);
  }
}

TEST(Fill, LatticesKeepTheAreaExactly)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const char* packing : {"lattice", "hexagonal"})
    for (const double dx : {2.0, 0.7})
    {
      const Particles p = fill(section, dx, packing);
      EXPECT_NEAR(tests::total(p.volume) / meshes::polygon_area(section.outline), 1, 1e-12);
    }
}

TEST(Fill, ParticlesStandInColumnsFromTheBaseUp)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const char* packing : {"columns", "lattice", "hexagonal"})
  {
    const Particles p = fill(section, 1.0, packing);
    const auto column = [&](std::size_t i)
    { return p.packing == "columns" ? p.x[i] : std::floor((p.x[i] - section.x_min) / 1.0); };
    for (std::size_t i = 1; i < p.size(); ++i)
      EXPECT_TRUE(column(i) > column(i - 1) || (column(i) == column(i - 1) && p.y[i] > p.y[i - 1]));
  }
}

TEST(Fill, ColumnBordersFallOnVerticalSteps)
{
  meshes::SectionInput input;
  input.ground = {{0, 3}, {7.13, 3}, {7.13, 8}, {20, 8}};
  input.base = {{0, 0}, {20, 0}};
  const Particles p = fill(meshes::build_section(input), 0.5, "columns");
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.y[i] > 3)
    {
      EXPECT_GT(p.x[i], 7.13);
    }
  EXPECT_NEAR(tests::total(p.volume), 7.13 * 3 + (20 - 7.13) * 8, 1e-9);
}

TEST(Fill, ZonesGiveTheirSoil)
{
  meshes::SectionInput input = tests::embankment();
  input.zones = {{.soil = 1, .polygon = {{95, 0}, {112, 0}, {105, 20}, {102, 20}}}};
  const meshes::Section section = meshes::build_section(input);
  const Particles p = fill(section, 0.5, "auto");
  double core = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    core += p.soil[i] == 1 ? p.volume[i] : 0;
  EXPECT_NEAR(core, 0.5 * (17 + 3) * 20, 0.02 * 200);
}

TEST(Fill, OverhangsAreFilledByTheLattice)
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {20, 0}, {20, 5}, {12, 5}, {14, 9}, {6, 9}, {6, 5}, {0, 5}};
  const meshes::Section section = meshes::build_section(input);
  EXPECT_FALSE(section.single_valued);
  const Particles p = fill(section, 0.25, "auto");
  EXPECT_EQ(p.packing, "lattice");
  EXPECT_NEAR(tests::total(p.volume) / meshes::polygon_area(section.outline), 1, 1e-12);
  EXPECT_THROW((void)fill(section, 0.25, "columns"), InputError);
}

TEST(Fill, RefusesASpacingThatResolvesNothing)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  EXPECT_THROW((void)fill(section, 10, "auto"), InputError);
  EXPECT_THROW((void)fill(section, 1e-4, "auto"), InputError);
}
} // namespace berm::sph
