// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-10 of docs/verification.md: what the factor of safety must not depend on.
#include "coupling/analysis.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>

namespace berm::coupling
{
namespace
{
/// The dry embankment at a coarse spacing: quick, and every comparison is made at this spacing.
Case dry_embankment()
{
  Case c;
  c.section = tests::embankment();
  c.soils = {{.name = "fill", .mechanical = tests::embankment_soil(), .conductivity = {}}};
  c.sph.spacing = 2;
  c.search = {.lower = 1, .upper = 3, .tolerance = 0.01};
  return c;
}

sph::FactorOfSafety factor_of(const Case& c)
{
  Observer silent;
  return analyse(c, silent).stability.value().governing().F;
}

void expect_same_bracket(const Case& c, const Case& reference)
{
  const auto F = factor_of(c), F0 = factor_of(reference);
  ASSERT_TRUE(F.complete && F0.complete);
  EXPECT_EQ(*F.stands, *F0.stands);
  EXPECT_EQ(*F.fails, *F0.fails);
}
} // namespace

TEST(FactorOfSafetyInvariance, DoesNotDependOnYoungsModulus)
{
  for (const double E : {1e7, 1e9})
  {
    Case c = dry_embankment();
    c.soils[0].mechanical.young_modulus = E;
    expect_same_bracket(c, dry_embankment());
  }
}

TEST(FactorOfSafetyInvariance, DoesNotDependOnTheOrigin)
{
  Case c = dry_embankment();
  for (Polyline* line : {&c.section.ground, &c.section.base})
    for (Vec2& v : *line)
      v += Vec2{-1000, 350};
  expect_same_bracket(c, dry_embankment());
}

TEST(FactorOfSafetyInvariance, OfTheMirrorImageIsTheSame)
{
  Case c = dry_embankment();
  for (Polyline* line : {&c.section.ground, &c.section.base})
  {
    std::reverse(line->begin(), line->end());
    for (Vec2& v : *line)
      v.x() = 191.4 - v.x();
  }
  expect_same_bracket(c, dry_embankment());
}

TEST(FactorOfSafetyInvariance, ScalesWithTheStrength)
{
  // Strength times 1.25 is F times 1.25, exactly, with psi = 0: only c / F and tan(phi) / F enter.
  Case c = dry_embankment();
  sph::Soil& soil = c.soils[0].mechanical;
  soil.cohesion *= 1.25;
  soil.friction_angle = std::atan(1.25 * std::tan(soil.friction_angle));
  c.search = {.lower = 1.25, .upper = 3.75, .tolerance = 0.0125};
  const auto F = factor_of(c), F0 = factor_of(dry_embankment());
  ASSERT_TRUE(F.complete && F0.complete);
  EXPECT_NEAR(*F.stands, 1.25 * *F0.stands, 1e-12);
  EXPECT_NEAR(*F.fails, 1.25 * *F0.fails, 1e-12);
}
} // namespace berm::coupling
