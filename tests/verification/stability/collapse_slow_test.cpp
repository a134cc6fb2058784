// SPDX-License-Identifier: GPL-3.0-or-later
/// The embankment of Bui et al. 2009 in their own terms, and a failed slope left to run on.
#include "app/case_file.h"
#include "coupling/analysis.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "sph/updated_lagrangian.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace berm
{
namespace
{
double factor(const std::string& variant)
{
  app::KeyPlaces places;
  const coupling::Case c = app::read_case(BERM_CASES "/bui_2009/" + variant + ".toml",
                                          {.overrides = {}, .seepage_only = false}, places);
  Observer silent;
  const coupling::Analysis a = coupling::analyse(c, silent);
  const sph::FactorOfSafety& F = a.stability.value().governing().F;
  EXPECT_TRUE(F.complete) << F.reason;
  return F.factor().value_or(0);
}
} // namespace

// Another program with the same equations has 2.394; the paper prints 2.4.
TEST(PaperMode, DryEmbankmentHasTheFactorOfItsEquations)
{
  EXPECT_NEAR(factor("dry"), 2.39, 0.05);
}

// Another program with the same equations has 1.844, the paper prints 1.9. We are at the lower end:
// 1.79 at 0.5 m, 1.83 at 1 m; cases/bui_2009/README.md.
TEST(PaperMode, StraightLineHasTheFactorOfItsEquations)
{
  EXPECT_NEAR(factor("hydrostatic"), 1.85, 0.06);
}

TEST(PaperMode, AFailedSlopeRunsOnForAHundredThousandStepsWithBoundedEnergy)
{
  using namespace sph;
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const double dx : {3.0, 2.0})
  {
    Particles particles = fill(section, dx, "columns");
    const std::vector<Soil> soils{tests::embankment_soil()};
    tests::set_density(particles, soils[0].density);
    const MovingBody body = moving_body(particles, soils, {}, section, {});
    UpdatedLagrangian soil(body, reduced_cones(soils, 4, "fitted"),
                           unstressed(static_cast<Index>(particles.size())));
    const double start = soil.energies().total();
    for (int k = 0; k < 20; ++k)
    {
      soil.advance(5000);
      soil.check_finite();
      const State s = soil.state();
      ASSERT_GT(*std::min_element(s.y.begin(), s.y.end()), 0) << dx;
      ASSERT_GT(soil.closest_pair(), 0.2 * dx);
      const Energies e = soil.energies();
      ASSERT_LT(e.kinetic + e.potential + e.elastic, 1.01 * start);
    }
  }
}
} // namespace berm
