// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim: the factor of safety does not depend on how the section is packed.
#include "sph/fill.h"
#include "sph/seeds.h"
#include "tests/support/factor.h"

#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
constexpr double dx = 1; // the embankment is 28.6 m high
} // namespace

TEST(Packing, LatticesGiveTheFactorOfColumns)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const double F = tests::dry_factor(fill(section, dx, "columns"), section);
  EXPECT_NEAR(F, 2.38, 0.03);
  for (const char* packing : {"lattice", "hexagonal"})
    EXPECT_NEAR(tests::dry_factor(fill(section, dx, packing), section) / F, 1, 0.02) << packing;
}

TEST(Packing, DisorderedSeedsGiveTheFactorOfColumns)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const double F = tests::dry_factor(fill(section, dx, "columns"), section);
  for (const double width : {0.1, 0.3})
  {
    const std::vector<Vec2> seeds = jittered(section, square_seeds(section, dx), width * dx, 1);
    EXPECT_NEAR(tests::dry_factor(fill_from_seeds(section, seeds, dx, "jittered"), section) / F, 1,
                0.02)
        << "jitter " << width;
  }
}
} // namespace berm::sph
