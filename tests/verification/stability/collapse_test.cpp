// SPDX-License-Identifier: GPL-3.0-or-later
/// Claims D-8 and D-9 of docs/verification.md: soil that moves far, on the updated-Lagrangian
/// solver.
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "sph/updated_lagrangian.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
/// A column at the left wall of an endless floor.
MovingBody column(const Soil& soil, double width, double height, double dx, bool artificial_stress)
{
  const meshes::Section section = tests::block(width, height);
  Particles particles = fill(section, dx, "columns");
  tests::set_density(particles, soil.density);
  MovingBody body = moving_body(particles, std::vector{soil}, {}, section,
                                {.artificial_stress = artificial_stress, .geostatic_base = false});
  body.walls.right.reset();
  return body;
}

/// Aluminium rods of Bui et al. 2008.
Soil rods()
{
  Soil soil;
  soil.density = soil.saturated_density = 2650;
  soil.cohesion = 0;
  soil.friction_angle = 19.8 * pi / 180;
  soil.dilation_angle = 0;
  soil.poisson_ratio = 0.3;
  soil.young_modulus = 3 * 0.7e6 * (1 - 2 * soil.poisson_ratio);
  return soil;
}

UpdatedLagrangian solver(const MovingBody& body, const Soil& soil)
{
  return {body, reduced_cones(std::vector{soil}, 1, "fitted"),
          unstressed(static_cast<Index>(body.particles.size()))};
}

/// x that 99 % of the particles have not passed: single grains that roll off do not count [m].
double front(const UpdatedLagrangian& soil)
{
  std::vector<double> x = soil.state().x;
  std::sort(x.begin(), x.end());
  return x[x.size() * 99 / 100];
}

void expect_sound(UpdatedLagrangian& soil, const MovingBody& body)
{
  const State s = soil.state();
  EXPECT_GT(*std::min_element(s.y.begin(), s.y.end()), 0); // none through the floor
  EXPECT_GT(*std::min_element(s.x.begin(), s.x.end()), 0); // none through the wall
  EXPECT_GT(soil.closest_pair(), 0.2 * body.particles.spacing);
}

struct RunOut
{
  double front = 0, balance = 0;
};

RunOut collapse_of_rods(double dx)
{
  const MovingBody body = column(rods(), 0.2, 0.1, dx, false);
  UpdatedLagrangian soil = solver(body, rods());
  const double start = soil.energies().total();
  double speed_most = 0;
  for (int k = 0; k < 12; ++k)
  {
    soil.advance_for(0.05);
    speed_most = std::max(speed_most, soil.energies().kinetic);
    expect_sound(soil, body);
  }
  EXPECT_LT(soil.energies().kinetic, 0.02 * speed_most); // at rest but for single grains
  return {front(soil), std::abs(soil.energies().total() - start) / start};
}
} // namespace

/// Lube et al. 2005: columns of height over width a < 1.8 on a rough floor run out to width (1
/// + 1.2 a), 0.32 m here, with sand of 30 deg; the rods' lower friction carries them farther.
/// Bound: 20 %.
TEST(Collapse, RunOutOfRodsMatchesColumnsInTheLaboratoryAndConverges)
{
  const RunOut coarse = collapse_of_rods(0.005), fine = collapse_of_rods(0.0025);
  EXPECT_NEAR(coarse.front, 0.32, 0.2 * 0.32);
  EXPECT_NEAR(fine.front, 0.32, 0.2 * 0.32);
  EXPECT_NEAR(fine.front, coarse.front, 0.05 * 0.32); // run-out that grows with the count would not
  EXPECT_LT(coarse.balance, 0.04); // what the walls' images do not balance: first order in dx
  EXPECT_LT(fine.balance, 0.6 * coarse.balance + 0.005);
}

/// c = 5 kPa, phi = 25 deg, 2 m high: gamma H / c = 7.3 cannot stand (3.85 / sqrt(K_a) = 6).
TEST(Collapse, CohesiveSoilSlidesInOnePieceAndComesToRest)
{
  Soil clay = rods();
  clay.density = clay.saturated_density = 1850;
  clay.cohesion = 5e3;
  clay.friction_angle = 25 * pi / 180;
  clay.young_modulus = 1.8e6;
  const MovingBody body = column(clay, 4, 2, 0.1, false);
  UpdatedLagrangian soil = solver(body, clay);
  const double start = soil.energies().potential;
  double kinetic_most = 0;
  for (int k = 0; k < 40; ++k)
  {
    soil.advance_for(0.1);
    kinetic_most = std::max(kinetic_most, soil.energies().kinetic);
    expect_sound(soil, body);
  }
  const Energies e = soil.energies();
  EXPECT_LT(e.kinetic, 0.05 * kinetic_most);
  EXPECT_GT(start - e.potential, 0.05 * start);               // it did collapse
  EXPECT_NEAR(e.total(), start, 0.2 * (start - e.potential)); // bounded

  // No numerical fracture: every particle has neighbours within the first shell and a half.
  const State s = soil.state();
  int alone = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i)
  {
    int near = 0;
    for (std::size_t j = 0; j < s.x.size(); ++j)
      near += j != i && std::hypot(s.x[i] - s.x[j], s.y[i] - s.y[j]) < 0.15;
    alone += near < 2;
  }
  EXPECT_LE(alone, static_cast<int>(s.x.size()) / 100);
}

TEST(Collapse, AFallingBlockStaysAboveTheFloor)
{
  Soil stiff = rods();
  stiff.cohesion = 20e3;
  MovingBody body = column(stiff, 0.2, 0.1, 0.01, false);
  for (double& y : body.particles.y)
    y += 0.5; // lands at 3.1 m/s, a seventh of the wave speed
  body.walls.left.reset();
  UpdatedLagrangian soil = solver(body, stiff);
  const double start = soil.energies().potential;
  for (int k = 0; k < 30; ++k)
  {
    soil.advance_for(0.03);
    const State s = soil.state();
    ASSERT_GT(*std::min_element(s.y.begin(), s.y.end()), 0);
    ASSERT_GT(soil.closest_pair(), 0.2 * 0.01);
    const Energies e = soil.energies();
    ASSERT_LT(e.kinetic + e.elastic + e.potential, start * 1.01);
  }
}
} // namespace berm::sph
