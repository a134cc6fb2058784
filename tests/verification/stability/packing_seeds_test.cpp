// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim: whatever the disorder of the seeds, the relaxed packing gives the factor of columns.
#include "coupling/pore_pressure.h"
#include "sph/fill.h"
#include "sph/seeds.h"
#include "tests/support/factor.h"

#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
void expect_the_factor_of_columns_under_the_straight_line(double dx, double width)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 24.4;
  const meshes::Section section = meshes::build_section(input);
  const auto pressure =
      coupling::hydrostatic_pore_pressure(coupling::straight_free_surface(section));
  const auto wet_factor = [&](const Particles& p)
  { return tests::factor(p, section, pressure(p.x, p.y), 1.6, 2.0); };
  const double F = wet_factor(fill(section, dx, "columns"));
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const std::vector<Vec2> seeds = jittered(section, square_seeds(section, dx), width, seed);
    // What a packing may cost; the two brackets take 0.8 of the 2 %.
    EXPECT_NEAR(wet_factor(fill_from_seeds(section, seeds, dx, "jittered")) / F, 1, 0.02)
        << "seed " << seed;
  }
}
} // namespace

class PackingSeeds : public testing::TestWithParam<double>
{
};

TEST_P(PackingSeeds, AllGiveTheFactorOfColumns)
{
  const double dx = 1, width = GetParam() * dx;
  const meshes::Section section = meshes::build_section(tests::embankment());
  const double F = tests::dry_factor(fill(section, dx, "columns"), section);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const std::vector<Vec2> seeds = jittered(section, square_seeds(section, dx), width, seed);
    EXPECT_NEAR(tests::dry_factor(fill_from_seeds(section, seeds, dx, "jittered"), section) / F, 1,
                0.02)
        << "seed " << seed;
  }
}

TEST_P(PackingSeeds, AllGiveTheFactorOfColumnsUnderTheStraightLine)
{
  expect_the_factor_of_columns_under_the_straight_line(1, GetParam());
}

TEST(PackingSeedsUnderWater, AllGiveTheFactorOfColumnsUnderTheStraightLine)
{
  expect_the_factor_of_columns_under_the_straight_line(0.5, 0.5 * 0.2);
}

INSTANTIATE_TEST_SUITE_P(Widths, PackingSeeds, testing::Values(0.1, 0.2, 0.3));
} // namespace berm::sph
