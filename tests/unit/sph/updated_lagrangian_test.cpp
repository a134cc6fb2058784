// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/updated_lagrangian.h"

#include "core/error.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/moving_soil.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <omp.h>
#include <random>

namespace berm::sph
{
namespace
{
/// A block of the embankment's soil, 2 m x 1 m.
MovingBody block(double dx, const UpdatedLagrangianSettings& settings)
{
  return tests::moving_block(tests::embankment_soil(), 2, 1, dx, settings);
}

MovingBody free_block(double dx, const UpdatedLagrangianSettings& settings)
{
  return tests::free_block(tests::embankment_soil(), 2, 1, dx, settings);
}

State random_velocities(const MovingBody& body, double size)
{
  State state = unstressed(static_cast<Index>(body.particles.size()));
  std::mt19937_64 engine(1);
  const auto random = [&] { return size * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1); };
  for (std::size_t i = 0; i < state.vx.size(); ++i)
  {
    state.vx[i] = random();
    state.vy[i] = random();
  }
  return state;
}
} // namespace

TEST(UpdatedLagrangian, GivesTheSameBitsForAnyNumberOfThreads)
{
  MovingBody body = block(0.1, {});
  body.walls.right.reset();
  State start = unstressed(static_cast<Index>(body.particles.size()));
  start.vx.assign(start.vx.size(), 20); // fast enough for many rebuilds
  const int threads_before = omp_get_max_threads();
  std::vector<State> states;
  for (const int threads : {1, 2, 7})
  {
    omp_set_num_threads(threads);
    UpdatedLagrangian soil(body, {{.alpha = 0.1, .alpha_psi = 0, .k = 1e3}}, start);
    soil.advance(400);
    EXPECT_GT(soil.rebuilds(), 40); // sorted again at least twice
    states.push_back(soil.state());
  }
  omp_set_num_threads(threads_before);
  for (std::size_t k = 1; k < states.size(); ++k)
  {
    EXPECT_EQ(states[k].x, states[0].x);
    EXPECT_EQ(states[k].vy, states[0].vy);
    EXPECT_EQ(states[k].density, states[0].density);
    EXPECT_EQ(states[k].plastic_strain, states[0].plastic_strain);
  }
}

TEST(UpdatedLagrangian, UniformVelocityGradientGivesTheExactStressRateWithCorrection)
{
  MovingBody body = free_block(0.1, {.gradient_correction = true, .gravity = 0});
  State state = unstressed(static_cast<Index>(body.particles.size()));
  for (std::size_t i = 0; i < state.vx.size(); ++i)
  {
    state.vx[i] = 1e-3 * body.particles.x[i] + 4e-3 * body.particles.y[i];
    state.vy[i] = -2e-3 * body.particles.x[i] + 3e-3 * body.particles.y[i];
  }
  UpdatedLagrangian soil(body, {}, state);
  const double dt = soil.time_step();
  soil.advance(1);
  const State after = soil.state();
  // In the middle of the step: eq. (9.11).
  Eigen::Matrix2d L;
  L << 1e-3, 4e-3, -2e-3, 3e-3;
  L = L * (Eigen::Matrix2d::Identity() - 0.5 * dt * L).inverse();
  const Elastic& e = body.elastic[0];
  const double volume = (e.K - 2 * e.G / 3) * L.trace();
  for (std::size_t i = 0; i < after.stress.size(); ++i)
  {
    const SymTensor& s = after.stress[i]; // edges and corners included; rounding only
    EXPECT_NEAR(s.xx / dt, volume + 2 * e.G * L(0, 0), 1e-12 * e.K);
    EXPECT_NEAR(s.yy / dt, volume + 2 * e.G * L(1, 1), 1e-12 * e.K);
    EXPECT_NEAR(s.xy / dt, e.G * (L(0, 1) + L(1, 0)), 1e-12 * e.K);
    EXPECT_NEAR(after.density[i], tests::embankment_soil().density * (1 - L.trace() * dt), 1e-9);
  }
}

/// Claim D-5: one full turn in 500 steps; at a quarter turn xx and yy have changed places.
TEST(UpdatedLagrangian, RigidRotationTurnsTheComponentsAndKeepsTheInvariants)
{
  const MovingBody body =
      free_block(0.2, {.gradient_correction = true, .artificial_stress = false, .gravity = 0});
  State state = unstressed(static_cast<Index>(body.particles.size()));
  const SymTensor stress = {.xx = -3, .yy = -1, .zz = -2, .xy = 0.5}; // too small to move the soil
  state.stress.assign(state.stress.size(), stress);
  UpdatedLagrangian soil(body, {}, state);
  const int steps = 500;
  double angle = 0, most_J2 = 0, most_I1 = 0;
  bool quarter_seen = false;
  while (angle < 2 * pi)
  {
    const State now = soil.state();
    const double dt = soil.time_step(), spin = 2 * pi / steps / dt;
    std::vector<double> vx, vy;
    for (std::size_t i = 0; i < now.x.size(); ++i)
    {
      // (I - R^-1)/dt of the step that ends here, R the rotation in it
      const double c = 2 * std::pow(std::sin(spin * dt / 2), 2) / dt, s = std::sin(spin * dt) / dt;
      vx.push_back(c * (now.x[i] - 1) - s * (now.y[i] - 0.5));
      vy.push_back(s * (now.x[i] - 1) + c * (now.y[i] - 0.5));
    }
    soil.set_velocity(vx, vy);
    soil.advance(1);
    angle += spin * dt;
    for (const SymTensor& s : soil.state().stress)
    {
      most_I1 = std::max(most_I1, std::abs(I1(s) - I1(stress)));
      most_J2 = std::max(most_J2, std::abs(J2(s) - J2(stress)));
    }
    if (!quarter_seen && angle >= pi / 2)
    {
      quarter_seen = true;
      const double late = 4 * (angle - pi / 2) + 0.02; // a step turns the circle by 0.025
      EXPECT_NEAR(soil.state().stress[0].xx, stress.yy, late);
      EXPECT_NEAR(soil.state().stress[0].yy, stress.xx, late);
      EXPECT_NEAR(soil.state().stress[0].xy, -stress.xy, late);
    }
  }
  EXPECT_TRUE(quarter_seen);
  // Rounding of D, 1e-16 spin, times G dt, 1e5 Pa, in 500 steps: 1e-7 Pa at most.
  EXPECT_LT(most_I1, 1e-6);
  EXPECT_LT(most_J2, 1e-6);
}

TEST(UpdatedLagrangian, FreeFallMakesNoStress)
{
  const MovingBody body = free_block(0.1, {});
  UpdatedLagrangian soil(body, {}, unstressed(static_cast<Index>(body.particles.size())));
  soil.advance(300);
  const State s = soil.state();
  for (std::size_t i = 0; i < s.x.size(); ++i)
  {
    EXPECT_EQ(s.stress[i].xx, 0);
    EXPECT_EQ(s.stress[i].yy, 0);
    EXPECT_NEAR(s.vy[i], -gravity * soil.time(), 1e-12);
  }
}

TEST(UpdatedLagrangian, MomentumIsConservedWithoutGravityAndWalls)
{
  for (const bool corrected : {false, true})
  {
    const MovingBody body = free_block(0.1, {.gradient_correction = corrected, .gravity = 0});
    UpdatedLagrangian soil(body, {}, random_velocities(body, 1));
    const Vec2 before = soil.momentum();
    soil.advance(300);
    const double mass = 2 * tests::embankment_soil().density;
    EXPECT_LT((soil.momentum() - before).norm(), 1e-11 * mass); // rounding of 300 steps at 1 m/s
  }
}

TEST(UpdatedLagrangian, EnergyNeverGrowsWithoutASourceAndTheBalanceHolds)
{
  const MovingBody body = free_block(0.05, {.gravity = 0});
  UpdatedLagrangian soil(body, {}, random_velocities(body, 0.1));
  const double start = soil.energies().total();
  double before = start;
  for (int k = 0; k < 50; ++k)
  {
    soil.advance(20);
    const Energies e = soil.energies();
    const double mechanical = e.kinetic + e.elastic;
    EXPECT_LT(mechanical,
              before + 1e-4 * start); // leapfrog stores stress and speed half a step apart
    before = mechanical;
  }
  const Energies e = soil.energies();
  EXPECT_LT(e.kinetic + e.elastic, 0.2 * start); // noise at the scale of the spacing is damped
  EXPECT_NEAR(e.total(), start, 1e-3 * start);   // the same
}

TEST(UpdatedLagrangian, AUniformPorePressureMovesNothing)
{
  MovingBody body = free_block(0.1, {.gravity = 0});
  body.pore_pressure.assign(body.particles.size(), 1e5);
  UpdatedLagrangian soil(body, {}, unstressed(static_cast<Index>(body.particles.size())));
  soil.advance(20);
  EXPECT_EQ(soil.v_rms(), 0);
}

TEST(UpdatedLagrangian, ALinearPorePressurePushesByItsGradientWithCorrection)
{
  MovingBody body = free_block(0.1, {.gradient_correction = true, .gravity = 0});
  body.reread_pressure = [](std::span<const double> x, std::span<const double> y)
  {
    std::vector<double> p;
    for (std::size_t i = 0; i < x.size(); ++i)
      p.push_back(2e3 * x[i] - 5e3 * y[i]);
    return p;
  };
  UpdatedLagrangian soil(body, {}, unstressed(static_cast<Index>(body.particles.size())));
  soil.advance(1);
  const State s = soil.state();
  const double rho = tests::embankment_soil().density;
  for (std::size_t i = 0; i < s.x.size(); ++i)
    EXPECT_NEAR(s.vx[i] / s.vy[i], -2e3 / 5e3, 1e-9);
  EXPECT_NEAR(s.vx[0] / soil.time(), -2e3 / rho, 1e-9);
}

TEST(UpdatedLagrangian, ANotFiniteValueIsAnErrorThatNamesIt)
{
  const MovingBody body = block(0.2, {});
  State state = unstressed(static_cast<Index>(body.particles.size()));
  state.stress[17].xx = NAN;
  EXPECT_THROW(UpdatedLagrangian(body, {}, state), NumericalError);
}

TEST(ArtificialStress, IsTheFractionOfEachTensilePrincipalStress)
{
  for (const SymTensor& sig :
       {SymTensor{3, 1, 0, 2}, SymTensor{5, 4, 0, 1}, SymTensor{-3, -1, 0, 1},
        SymTensor{2, 2, 0, 0}, SymTensor{-1, 4, 0, -0.5}})
  {
    Eigen::Matrix2d M;
    M << sig.xx, sig.xy, sig.xy, sig.yy;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(M);
    const Eigen::Vector2d tensile = -0.5 * eigen.eigenvalues().cwiseMax(0);
    const Eigen::Matrix2d R =
        eigen.eigenvectors() * tensile.asDiagonal() * eigen.eigenvectors().transpose();
    const SymTensor ours = tensile_repulsion(sig, 0.5);
    EXPECT_NEAR(ours.xx, R(0, 0), 1e-14);
    EXPECT_NEAR(ours.yy, R(1, 1), 1e-14);
    EXPECT_NEAR(ours.xy, R(0, 1), 1e-14);
  }
}

TEST(ArtificialStress, TheTableIsThePowerOfTheKernel)
{
  const double h = 1.2;
  const RepulsionTable table(h, 1);
  const CubicSpline W{h};
  for (double q = 0; q < 2; q += 0.0137)
    EXPECT_NEAR(table(q), std::pow(W.W(q * h) / W.W(1), 2.55),
                2e-4); // f'' / 8 (2/511)^2, f'' < 100
  EXPECT_EQ(table(2.1), 0);
}

TEST(VerletList, HoldsWhatBruteForceFinds)
{
  std::mt19937_64 engine(2);
  std::vector<double> x, y;
  for (int k = 0; k < 500; ++k)
  {
    x.push_back(static_cast<double>(engine() >> 11) * 0x1p-53 * 3);
    y.push_back(static_cast<double>(engine() >> 11) * 0x1p-53);
  }
  x.back() = 1e6; // one point far away must not blow up the grid
  VerletList list;
  list.build(x, y, 400, 0.2);
  for (Index i = 0; i < 400; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    std::vector<Index> expected, found;
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != at && std::hypot(x[j] - x[at], y[j] - y[at]) < 0.2)
        expected.push_back(static_cast<Index>(j));
    const VerletList::Row row = list.row(i);
    for (Index k = 0; k < 4 * row.blocks; ++k)
      if (row.index[k] != i)
        found.push_back(row.index[k]);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

/// No pair that was farther apart than the radius is now nearer than the radius less the bound;
/// soil that moves as one comes no nearer.
TEST(VerletList, BoundsHowMuchNearerOtherPairsHaveCome)
{
  const double radius = 0.2;
  std::mt19937_64 engine(3);
  const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<double> x, y;
  for (int k = 0; k < 500; ++k)
  {
    x.push_back(3 * random());
    y.push_back(random());
  }
  VerletList list;
  list.build(x, y, 500, radius);
  for (const double noise : {0.0, 0.01, 0.05})
    for (const double shear : {0.0, 0.05})
    {
      std::vector<double> x_now = x, y_now = y;
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        x_now[i] += 0.1 + shear * y[i] + noise * random();
        y_now[i] += 0.1 + shear * x[i] + noise * random();
      }
      double most = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
          const double before = std::hypot(x[i] - x[j], y[i] - y[j]);
          const double now = std::hypot(x_now[i] - x_now[j], y_now[i] - y_now[j]);
          if (before > radius)
            most = std::max(most, radius - now);
        }
      const double bound = list.closing(x_now, y_now);
      EXPECT_GE(bound, most);
      if (noise == 0 && shear == 0)
      {
        EXPECT_LT(bound, 1e-14); // rounding of coordinates up to 3
      }
    }
}
} // namespace berm::sph
