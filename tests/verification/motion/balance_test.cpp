// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-12 of docs/verification.md: balances of energy, momentum and mass.
#include "sph/total_lagrangian.h"
#include "sph/trial.h"
#include "tests/support/moving_soil.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <memory>
#include <random>

namespace berm::sph
{
namespace
{
State noise(const MovingBody& body, double speed)
{
  State state = tests::at_rest(body);
  std::mt19937_64 engine(1);
  const auto random = [&] { return speed * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1); };
  for (std::size_t i = 0; i < state.vx.size(); ++i)
  {
    state.vx[i] = random();
    state.vy[i] = random();
  }
  return state;
}

struct Closed
{
  bool corrected, plastic;
};
} // namespace

class EnergyOfAFreeBlock : public testing::TestWithParam<Closed>
{
};

/// Random velocities and free faces, no source of energy.
TEST_P(EnergyOfAFreeBlock, NeverGrowsAndIsAccountedFor)
{
  const Soil soft = tests::embankment_soil();
  const MovingBody body = tests::free_block(
      soft, 2, 1, 0.05, {.gradient_correction = GetParam().corrected, .gravity = 0});
  std::vector<Cone> cones;
  if (GetParam().plastic)
    cones = reduced_cones(std::vector{soft}, 1, "fitted");
  UpdatedLagrangian soil(body, cones, noise(body, 0.5));
  const double start = soil.energies().total();
  double before = start, growth = 0;
  for (int k = 0; k < 100; ++k)
  {
    soil.advance(20);
    const Energies e = soil.energies();
    growth = std::max(growth, e.kinetic + e.elastic - before);
    before = e.kinetic + e.elastic;
  }
  const Energies e = soil.energies();
  std::printf("  growth %.1e, balance %.1e, left %.2f, plastic %.2f\n", growth / start,
              e.total() / start - 1, before / start, e.plastic / start);
  // Leapfrog stores stress and speed half a step apart.
  EXPECT_LT(growth, 1e-3 * start);
  EXPECT_NEAR(e.total(), start, 1e-3 * start);
  EXPECT_EQ(e.plastic > 0.01 * start, GetParam().plastic);
}

INSTANTIATE_TEST_SUITE_P(ElasticAndPlastic, EnergyOfAFreeBlock,
                         testing::Values(Closed{false, false}, Closed{true, false},
                                         Closed{false, true}, Closed{true, true}));

/// Sudden gravity on a column between rollers: at every moment the base carries the weight and the
/// change of momentum. The stress at the base is that of the two lowest rows, carried on.
TEST(Momentum, ChangesByTheForcesOfBaseAndGravity)
{
  constexpr double length = 4, height = 10;
  const Soil soil = tests::embankment_soil();
  for (const bool updated : {false, true})
    for (const double dx : {0.5, 0.25})
    {
      const meshes::Section section = tests::block(length, height);
      const MovingBody body =
          tests::moving_block(soil, length, height, dx, {.gradient_correction = true});
      const Discretisation d = discretise(body.particles, std::vector{soil},
                                          std::vector<double>(body.particles.size(), 0.0), section);
      std::unique_ptr<SoilSolver> solver;
      if (updated)
        solver =
            std::make_unique<UpdatedLagrangian>(body, std::vector<Cone>{}, tests::at_rest(body));
      else
        solver = std::make_unique<TotalLagrangian>(d, std::vector<Cone>{}, 0, tests::at_rest(body));
      const double weight = length * height * soil.density * gravity;
      const double period = 4 * height / std::sqrt(body.elastic[0].M() / soil.density);
      double worst = 0, swing = 0;
      double t0 = 0, t1 = 0, P0 = 0, P1 = 0, R1 = 0;
      for (int k = 0; solver->time() < 2 * period; ++k)
      {
        solver->advance(5);
        const State s = solver->state();
        double P = 0, lowest = 0, second = 0;
        for (std::size_t i = 0; i < s.vy.size(); ++i)
        {
          P += body.particles.volume[i] * soil.density * s.vy[i];
          if (body.particles.y[i] < dx)
            lowest -= dx * s.stress[i].yy;
          else if (body.particles.y[i] < 2 * dx)
            second -= dx * s.stress[i].yy;
        }
        const double R = 1.5 * lowest - 0.5 * second;
        if (k >= 2)
        {
          const double change = (P - P0) / (solver->time() - t0);
          worst = std::max(worst, std::abs(R1 - weight - change) / weight);
          swing = std::max(swing, std::abs(change) / weight);
        }
        t0 = t1, P0 = P1, t1 = solver->time(), P1 = P, R1 = R;
      }
      std::printf("  updated %d, dx %.2f: %.4f of the weight, swing %.2f\n", updated, dx, worst,
                  swing);
      EXPECT_GT(swing, 0.8);
      EXPECT_LT(worst, 2 * dx / height); // the weight of two rows
    }
}

TEST(Momentum, OfAFreeBlockChangesByItsWeightAlone)
{
  for (const bool corrected : {false, true})
  {
    const Soil soil = tests::embankment_soil();
    const MovingBody body = tests::free_block(soil, 2, 1, 0.1, {.gradient_correction = corrected});
    UpdatedLagrangian solver(body, reduced_cones(std::vector{soil}, 1, "fitted"), noise(body, 0.5));
    const Vec2 before = solver.momentum();
    solver.advance(500);
    const double mass = 2 * soil.density;
    EXPECT_LT((solver.momentum() - before + Vec2{0, mass * gravity * solver.time()}).norm(),
              1e-11 * mass); // rounding of 500 steps at 1 m/s
  }
}

/// A column that settles: mass over density has shrunk by its width times its settlement.
TEST(Mass, OfASettlingColumnFollowsItsSettlement)
{
  constexpr double length = 4, height = 10;
  Soil soft = tests::embankment_soil();
  soft.young_modulus = 5e5; // strains of 20 % at the base
  for (const bool corrected : {false, true})
  {
    const MovingBody body = tests::moving_block(
        soft, length, height, 0.5, {.gradient_correction = corrected, .local_damping = 0.8});
    Observer silent;
    const State s = settle(body, silent).state;
    double volume = 0, top = 0, first = 0;
    for (std::size_t i = 0; i < s.density.size(); ++i)
    {
      volume += body.particles.volume[i] * soft.density / s.density[i];
      if (body.particles.y[i] > first)
      {
        first = body.particles.y[i];
        top = s.y[i];
      }
    }
    const double settled = length * (first - top), shrunk = length * height - volume;
    std::printf("  settled by %.4f m2, mass over density %.4f m2\n", settled, shrunk);
    EXPECT_NEAR(shrunk / settled, 1, 0.02);
  }
}
} // namespace berm::sph
