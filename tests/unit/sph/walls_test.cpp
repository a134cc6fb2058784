// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/walls.h"

#include "sph/fill.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

namespace berm::sph
{
TEST(Walls, GhostsFillTheBandBehindTheBaseAndTheSides)
{
  // Four by five particles of spacing 1, reach 2.4: three rows below, three columns at either side
  // (the third row's centre lies 2.5 away, out of reach, so two and two), corners included.
  const meshes::Section section = tests::block(4, 5);
  const Particles p = fill(section, 1.0, "columns");
  const std::vector<Ghost> ghosts = mirror_ghosts(p, section, 2.4);
  EXPECT_EQ(ghosts.size(), 4u * 2 + 2u * 2 * 5 + 2u * 2 * 2);
  for (const Ghost& g : ghosts)
    EXPECT_TRUE(g.x < 0 || g.x > 4 || g.y < 0);
}

TEST(Walls, GhostsMirrorTheirSource)
{
  const meshes::Section section = tests::block(4, 5);
  const Particles p = fill(section, 1.0, "columns");
  for (const Ghost& g : mirror_ghosts(p, section, 2.4))
  {
    const auto s = static_cast<std::size_t>(g.source);
    const bool behind_side = g.x < 0 || g.x > 4, behind_base = g.y < 0;
    EXPECT_NEAR(g.x, !behind_side ? p.x[s] : g.x < 0 ? -p.x[s] : 8 - p.x[s], 1e-12);
    EXPECT_NEAR(g.y, behind_base ? -p.y[s] : p.y[s], 1e-12);
    EXPECT_NEAR(g.depth_below, behind_base ? 2 * p.y[s] : 0, 1e-12);
    // Fixed base: all of the velocity turns round. Roller: the normal part.
    EXPECT_EQ(g.sign_vy, behind_base ? -1 : 1);
    EXPECT_EQ(g.sign_vx, (behind_base ? -1 : 1) * (behind_side ? -1 : 1));
    EXPECT_EQ(g.sign_sxy, behind_side ? -1 : 1);
  }
}

TEST(Walls, AFreeVerticalFaceHasNoGhosts)
{
  meshes::SectionInput input; // ground goes straight up from the base at the left: no side there
  input.ground = {{0, 0}, {0, 5}, {4, 5}};
  input.base = {{0, 0}, {4, 0}};
  const meshes::Section section = meshes::build_section(input);
  const Particles p = fill(section, 1.0, "columns");
  for (const Ghost& g : mirror_ghosts(p, section, 2.4))
    EXPECT_GT(g.x, 0);
}
} // namespace berm::sph
