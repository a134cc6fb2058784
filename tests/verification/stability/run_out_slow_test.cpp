// SPDX-License-Identifier: GPL-3.0-or-later
/// Run-out of the two-sided embankment, dry and with its seepage: at rest at three spacings, and
/// the run-out does not hang on the number of particles.
#include "app/case_file.h"
#include "coupling/analysis.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace berm
{
namespace
{
coupling::RunOut run_out(const std::string& water, const std::string& factor,
                         const std::string& spacing)
{
  app::KeyPlaces places;
  const coupling::Case input =
      app::read_case(BERM_CASES "/two_sided_embankment/" + water + ".toml",
                     {.overrides = {"sph.spacing_m=" + spacing, "stability.enabled=false",
                                    "runout.factor=" + factor},
                      .seepage_only = false},
                     places);
  Observer silent;
  return coupling::analyse(input, silent).run_out.value();
}

class EmbankmentRunOut : public testing::TestWithParam<std::pair<const char*, const char*>>
{
};
} // namespace

TEST_P(EmbankmentRunOut, ComesToRestAndDoesNotGrowWithTheNumberOfParticles)
{
  const auto [water, factor] = GetParam();
  double finest = 0;
  for (const char* spacing : {"0.5", "0.7", "1.0"})
  {
    const coupling::RunOut r = run_out(water, factor, spacing);
    EXPECT_TRUE(r.motion.at_rest) << spacing;
    EXPECT_EQ(r.shape.side, "right");
    EXPECT_GT(r.motion.closest_pair, 0.2 * std::stod(spacing));
    const auto &first = r.motion.history.front().energies, &last = r.motion.history.back().energies;
    EXPECT_NEAR(last.total(), first.total(), 0.005 * last.plastic) << spacing;
    const double distance = r.shape.run_out.value();
    std::printf("%s, strength / %s, %s m: run-out %.3f m, at rest at %.1f s\n", water, factor,
                spacing, distance, r.motion.time_to_rest);
    if (std::string(spacing) == "0.7")
    {
      EXPECT_NEAR(distance, finest, 0.1 * finest);
    }
    if (std::string(spacing) == "0.5")
      finest = distance;
  }
}

INSTANTIATE_TEST_SUITE_P(Waters, EmbankmentRunOut,
                         testing::Values(std::pair{"dry", "3"}, std::pair{"dry", "2.7"},
                                         std::pair{"hydrostatic", "2.4"}));
#ifdef BERM_WITH_SEEPAGE
INSTANTIATE_TEST_SUITE_P(Seepage, EmbankmentRunOut, testing::Values(std::pair{"seepage", "2"}));
#endif
} // namespace berm
