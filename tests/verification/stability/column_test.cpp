// SPDX-License-Identifier: GPL-3.0-or-later
/// Claims D-1, D-2 and D-4 of docs/verification.md: a soil column between rollers against closed
/// forms.
#include "sph/fill.h"
#include "sph/total_lagrangian.h"
#include "sph/trial.h"
#include "tests/support/measured.h"
#include "tests/support/sections.h"

#include <functional>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
constexpr double H = 10; // m
constexpr double rho = 2000;
constexpr double gamma = rho * gravity;

struct Column
{
  meshes::Section section = tests::block(4, H);
  Particles particles;
  std::vector<Soil> soils{tests::embankment_soil()};
  Discretisation d;

  /// @param pressure  p_w [Pa] at depth z [m].
  explicit Column(
      double dx, const std::function<double(double)>& pressure = [](double) { return 0.; })
      : particles(fill(section, dx, "columns"))
  {
    tests::set_density(particles, rho);
    std::vector<double> p_w;
    for (const double y : particles.y)
      p_w.push_back(pressure(H - y));
    d = discretise(particles, soils, p_w, section);
  }
  [[nodiscard]] Settled settled() const
  {
    Observer silent;
    return settle(d, silent);
  }
};

/// Largest |sigma_yy + slope z| below the two uppermost particles, and among those two [Pa].
std::pair<double, double> stress_error(const Column& c, const State& state, double slope)
{
  double inside = 0, top = 0;
  for (std::size_t i = 0; i < c.particles.size(); ++i)
  {
    const double z = H - c.particles.y[i];
    const double error = std::abs(state.stress[i].yy + slope * z);
    (z < 2 * c.particles.spacing ? top : inside) =
        std::max(z < 2 * c.particles.spacing ? top : inside, error);
  }
  return {inside, top};
}
} // namespace

/// D-1: sigma_yy = -gamma z, sigma_xx = K0 sigma_yy, settlement gamma H^2 / (2M).
TEST(SoilColumn, SettlesToGeostaticStress)
{
  for (const double dx : {0.5, 0.25})
  {
    const Column column(dx);
    const Settled settled = column.settled();
    const auto [inside, top] = stress_error(column, settled.state, gamma);
    tests::expect_error("D-1 stress inside, largest error [Pa]", inside,
                        1e-3 * gamma * H); // the settling criterion leaves 2e-4
    // The sum at the surface misses half a row of support: an error of about half a spacing of
    // soil.
    tests::expect_error(fmt::format("D-1 stress at the surface, dx = {} m, largest error [Pa]", dx),
                        top, 0.6 * gamma * dx);
    const double K0 = 0.3 / 0.7;
    for (const SymTensor& sig : settled.state.stress)
    {
      EXPECT_NEAR(sig.xx, K0 * sig.yy, 1e-3 * gamma * H);
      EXPECT_NEAR(sig.xy, 0, 1e-9 * gamma * H);
    }
    const double exact = gamma * H * H / (2 * column.d.elastic[0].M());
    tests::expect_measured(fmt::format("D-1 settlement over the exact one, dx = {} m", dx),
                           settled.settlement / exact, 1, 0.01 * dx / 0.5);
  }
}

/// D-1: under sudden gravity the column swings with T = 4 H / sqrt(M / rho).
TEST(SoilColumn, SwingsWithThePeriodOfAnElasticRod)
{
  const Column column(0.25);
  const double T = 4 * H / std::sqrt(column.d.elastic[0].M() / rho);
  const std::vector<double> zero(column.particles.size(), 0.0);
  TotalLagrangian soil(column.d, {}, 0,
                       {.ux = zero,
                        .uy = zero,
                        .vx = zero,
                        .vy = zero,
                        .stress = std::vector<SymTensor>(zero.size()),
                        .plastic_strain = zero});
  // Times at which the mean settlement turns back; the first is half a period after the start.
  std::vector<double> turns;
  double before = 0, now = 0;
  while (turns.size() < 4)
  {
    soil.advance(1);
    const State state = soil.state();
    const double next = -tests::total(state.uy);
    if (now > before && now > next)
      turns.push_back(soil.time() - column.d.dt);
    before = now;
    now = next;
    ASSERT_LT(soil.time(), 10 * T);
  }
  tests::expect_measured("D-1 period [s]", (turns.back() - turns.front()) / 3, T, 0.01 * T);
}

/// D-2: a saturated column in equilibrium carries gamma' z and does not drift.
TEST(SoilColumn, SaturatedColumnStaysAtRest)
{
  const double dx = 0.5;
  const Column column(dx, [](double z) { return water_unit_weight * z; });
  const Settled settled = column.settled();
  const double buoyant = gamma - water_unit_weight;
  tests::expect_error("D-2 stress, largest error [Pa]",
                      stress_error(column, settled.state, buoyant).first, 1e-3 * gamma * H);

  TotalLagrangian soil(column.d, reduced_cones(column.soils, 1, "fitted"), 0, settled.state);
  soil.advance(std::lround(10 / column.d.dt)); // ten seconds, without damping
  tests::expect_error("D-2 velocity after 10 s [m/s]", soil.v_rms(), 1e-3 * std::sqrt(gravity * H));
  tests::expect_error("D-2 displacement after 10 s [m]", soil.max_displacement(), 1e-3 * dx);
}

/// D-4: upward flow with gradient i leaves sigma' = (gamma' - i gamma_w) z.
TEST(SoilColumn, UpwardFlowTakesItsShareOfTheWeight)
{
  const double i = 0.5;
  const Column column(0.5, [i](double z) { return water_unit_weight * (1 + i) * z; });
  const double left = gamma - (1 + i) * water_unit_weight;
  tests::expect_error("D-4 stress in upward flow, largest error [Pa]",
                      stress_error(column, column.settled().state, left).first, 1e-3 * gamma * H);
}

/// D-4: beyond i_c = gamma' / gamma_w cohesionless soil lifts: a trial at F = 1 fails, and nothing
/// blows up.
TEST(SoilColumn, BeyondTheCriticalGradientTheSoilLifts)
{
  const double critical = (gamma - water_unit_weight) / water_unit_weight;
  for (const double ratio : {0.9, 1.1})
  {
    Column column(0.5, [=](double z) { return water_unit_weight * (1 + ratio * critical) * z; });
    column.soils[0].cohesion = 0;
    const Settled settled = column.settled();
    Observer silent;
    const Trial trial =
        run_trial(column.d, settled.state, reduced_cones(column.soils, 1, "fitted"), 1, silent);
    EXPECT_EQ(trial.outcome, ratio < 1 ? Outcome::stands : Outcome::fails) << trial.reason;
  }
}
} // namespace berm::sph
