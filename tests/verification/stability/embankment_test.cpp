// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim F-1 of docs/verification.md: the two-sided embankment in its three waters, from the
/// shipped case files. References: strict finite-element strength reduction with psi = 0
/// gives 2.40-2.42 dry, 1.83-1.87 under the straight line, 1.66-1.70 with seepage; critical Bishop
/// circles beside them.
#include "app/case_file.h"
#include "coupling/analysis.h"
#include "tests/support/measured.h"

#include <gtest/gtest.h>

namespace berm
{
namespace
{
coupling::Analysis run(const std::string& variant, const std::string& spacing)
{
  app::KeyPlaces places;
  const coupling::Case c =
      app::read_case(BERM_CASES "/two_sided_embankment/" + variant + ".toml",
                     {.overrides = {"sph.spacing_m=" + spacing}, .seepage_only = false}, places);
  Observer silent;
  return coupling::analyse(c, silent);
}

struct Circle
{
  Vec2 centre;
  double radius;
};

/// Share of the slip line's length that lies within 2 m of a circle [-].
double share_near(const Polyline& line, const Circle& circle)
{
  double near = 0, all = 0;
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const double length = (line[k] - line[k - 1]).norm();
    const Vec2 middle = 0.5 * (line[k] + line[k - 1]);
    all += length;
    near += std::abs((middle - circle.centre).norm() - circle.radius) < 2 ? length : 0;
  }
  return near / all;
}

void expect_factor(const coupling::Analysis& a, double expected, double tolerance,
                   const Circle& circle)
{
  const auto& stability = a.stability.value();
  const auto& F = stability.governing().F;
  ASSERT_TRUE(F.complete) << F.reason;
  tests::expect_measured("F-1 factor of safety", *F.factor(), expected, tolerance);
  EXPECT_LE(*F.fails - *F.stands, 0.02);
  for (const sph::Trial& trial : F.trials)
    EXPECT_NE(trial.outcome, sph::Outcome::undecided) << "F = " << trial.factor;
  ASSERT_TRUE(stability.governing().mechanism.has_value());
  EXPECT_EQ(stability.governing().mechanism->side, "right");
  EXPECT_GT(share_near(stability.governing().mechanism->slip_line, circle), 0.6);
}
} // namespace

// Tolerances cover the distance between the finite-element values and our own discretisation error.

TEST(Embankment, DryEndToEndAtACoarseSpacing)
{
  const coupling::Analysis a = run("dry", "1.5");
  EXPECT_FALSE(a.seepage.has_value());
  expect_factor(a, 2.39, 0.05, {{154.2, 76.5}, 69.3});
}

TEST(Embankment, DryFactorOfSafety)
{
  expect_factor(run("dry", "0.5"), 2.38, 0.04, {{154.2, 76.5}, 69.3});
}

TEST(Embankment, StraightLineFactorOfSafety)
{
  expect_factor(run("hydrostatic", "0.5"), 1.82, 0.04, {{146.0, 51.4}, 48.3});
}

#ifdef BERM_WITH_SEEPAGE
TEST(Embankment, SeepageFactorOfSafety)
{
  expect_factor(run("seepage", "0.5"), 1.645, 0.045, {{146.84, 51.20}, 47.09});
}
#endif
} // namespace berm
