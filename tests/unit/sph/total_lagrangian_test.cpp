// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/total_lagrangian.h"

#include "core/error.h"
#include "sph/fill.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <omp.h>

namespace berm::sph
{
namespace
{
struct Body
{
  meshes::Section section;
  Particles particles;
  std::vector<Soil> soils{tests::embankment_soil()};
  Discretisation d;

  Body(const meshes::SectionInput& input, double dx)
      : section(meshes::build_section(input)), particles(fill(section, dx, "columns"))
  {
    tests::set_density(particles, soils[0].density);
    d = discretise(particles, soils, std::vector<double>(particles.size(), 0.0), section);
  }

  [[nodiscard]] State at_rest() const
  {
    const std::vector<double> zero(particles.size(), 0.0);
    return {.ux = zero,
            .uy = zero,
            .vx = zero,
            .vy = zero,
            .stress = std::vector<SymTensor>(particles.size()),
            .plastic_strain = zero};
  }
};
} // namespace

TEST(TotalLagrangian, GivesTheSameBitsForAnyNumberOfThreads)
{
  Body body(tests::embankment(), 2);
  const int threads_before = omp_get_max_threads();
  for (const bool panels : {true, false})
  {
    if (!panels)
      body.d.panels = {};
    std::vector<State> states;
    for (const int threads : {1, 2, 4, 7})
    {
      omp_set_num_threads(threads);
      TotalLagrangian soil(body.d, reduced_cones(body.soils, 3.0, "fitted"), 0.8, body.at_rest());
      for (const long steps : {1, 4, 95})
        soil.advance(steps);
      states.push_back(soil.state());
    }
    for (std::size_t k = 1; k < states.size(); ++k)
    {
      EXPECT_EQ(states[k].ux, states[0].ux);
      EXPECT_EQ(states[k].vy, states[0].vy);
      EXPECT_EQ(states[k].plastic_strain, states[0].plastic_strain);
    }
  }
  omp_set_num_threads(threads_before);
}

TEST(TotalLagrangian, PanelsAndTheListOfNeighboursAgree)
{
  // Weights of both are the same bits; sums are taken in another order. Without local damping,
  // which asks for the sign of velocities near zero and makes 1e-7 of the rounding.
  Body body(tests::embankment(), 1.5);
  ASSERT_FALSE(body.d.panels.block.empty());
  std::vector<State> states;
  for (const bool panels : {true, false})
  {
    if (!panels)
      body.d.panels = {};
    TotalLagrangian soil(body.d, reduced_cones(body.soils, 2.4, "fitted"), 0, body.at_rest());
    soil.advance(300);
    states.push_back(soil.state());
  }
  const auto largest = [](const std::vector<double>& v)
  {
    double most = 0;
    for (const double value : v)
      most = std::max(most, std::abs(value));
    return most;
  };
  EXPECT_GT(largest(states[0].plastic_strain), 1e-4); // the cone takes part
  const double u = largest(states[0].uy), e = largest(states[0].plastic_strain);
  double worst_u = 0, worst_e = 0;
  for (std::size_t i = 0; i < states[0].ux.size(); ++i)
  {
    worst_u = std::max({worst_u, std::abs(states[0].ux[i] - states[1].ux[i]),
                        std::abs(states[0].uy[i] - states[1].uy[i])});
    worst_e =
        std::max(worst_e, std::abs(states[0].plastic_strain[i] - states[1].plastic_strain[i]));
  }
  EXPECT_LT(worst_u, 1e-13 * u);
  EXPECT_LT(worst_e, 1e-13 * e);
}

TEST(TotalLagrangian, UniformVelocityGradientGivesTheExactStressRateInside)
{
  const Body body(tests::embankment(), 2);
  State state = body.at_rest();
  for (std::size_t i = 0; i < body.particles.size(); ++i)
  {
    state.vx[i] = 1e-3 * body.particles.x[i] + 4e-3 * body.particles.y[i];
    state.vy[i] = -2e-3 * body.particles.x[i] + 3e-3 * body.particles.y[i];
  }
  TotalLagrangian soil(body.d, {}, 0, state);
  soil.advance(1);
  const State after = soil.state();
  const Elastic& e = body.d.elastic[0];
  const double volume = (e.K - 2 * e.G / 3) * 4e-3;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
  {
    const double x = body.particles.x[i];
    if (body.particles.y[i] < 5 || x < 5 || x > 186) // near a wall the field is not linear
      continue;
    const SymTensor& s = after.stress[i];
    EXPECT_NEAR(s.xx / body.d.dt, volume + 2 * e.G * 1e-3, 1e-12 * e.K);
    EXPECT_NEAR(s.yy / body.d.dt, volume + 2 * e.G * 3e-3, 1e-12 * e.K);
    EXPECT_NEAR(s.zz / body.d.dt, volume, 1e-12 * e.K);
    EXPECT_NEAR(s.xy / body.d.dt, e.G * 2e-3, 1e-12 * e.K);
  }
}

TEST(TotalLagrangian, ANotFiniteValueIsAnErrorThatNamesIt)
{
  const Body body(tests::embankment(), 3);
  State state = body.at_rest();
  state.vx[17] = NAN;
  TotalLagrangian soil(body.d, {}, 0.8, state);
  soil.advance(1);
  EXPECT_THROW(soil.check_finite(), NumericalError);
}
} // namespace berm::sph
