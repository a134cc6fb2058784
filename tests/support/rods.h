// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/trial.h"
#include "tests/support/moving_soil.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <vector>

/// Columns that collapse: claims D-8 and D-9 of docs/verification.md.
namespace berm::tests
{
using namespace sph;

/// A column at the left wall of an endless floor.
inline MovingBody column(const Soil& soil, double width, double height, double dx,
                         UpdatedLagrangianSettings settings)
{
  const meshes::Section section = tests::block(width, height);
  Particles particles = fill(section, dx, "columns");
  tests::set_density(particles, soil.density);
  MovingBody body = moving_body(particles, std::vector{soil}, {}, section, settings);
  body.walls.right.reset();
  return body;
}

/// Aluminium rods of Bui et al. 2008.
inline Soil rods()
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

inline UpdatedLagrangian solver(const MovingBody& body, const Soil& soil)
{
  return {body, reduced_cones(std::vector{soil}, 1, "fitted"),
          unstressed(static_cast<Index>(body.particles.size()))};
}

/// x that 99 % of the particles have not passed: single grains that roll off do not count [m].
inline double front(const UpdatedLagrangian& soil)
{
  std::vector<double> x = soil.state().x;
  std::sort(x.begin(), x.end());
  return x[x.size() * 99 / 100];
}

inline void expect_sound(UpdatedLagrangian& soil, const MovingBody& body)
{
  const State s = soil.state();
  EXPECT_GT(*std::min_element(s.y.begin(), s.y.end()), 0); // none through the floor
  EXPECT_GT(*std::min_element(s.x.begin(), s.x.end()), 0); // none through the wall
  EXPECT_GT(soil.closest_pair(), 0.2 * body.particles.spacing);
}

/// The rods' column once it has come to rest.
struct RodsAtRest
{
  double front = 0;        ///< [m]
  double intact_share = 0; ///< of the column, moved by less than 5 mm
  double intact_top = 0;   ///< x to which the top has moved by less than 5 mm [m]
  double balance = 0;      ///< error of the energy balance over the energy at the start
};

/// With the gradient correction.
inline RodsAtRest collapse_of_rods(double dx)
{
  const MovingBody body = column(rods(), 0.2, 0.1, dx, {.gradient_correction = true});
  UpdatedLagrangian soil = solver(body, rods());
  const double start = soil.energies().total();
  double kinetic_most = 0;
  for (int k = 0; k < 14; ++k)
  {
    soil.advance_for(0.05);
    kinetic_most = std::max(kinetic_most, soil.energies().kinetic);
    expect_sound(soil, body);
  }
  EXPECT_LT(soil.energies().kinetic, 0.02 * kinetic_most); // at rest but for single grains
  const State s = soil.state();
  RodsAtRest rest{.front = front(soil),
                  .balance = std::abs(soil.energies().total() - start) / start};
  for (std::size_t i = 0; i < s.x.size(); ++i)
    if (std::hypot(s.x[i] - body.particles.x[i], s.y[i] - body.particles.y[i]) < 0.005)
    {
      rest.intact_share += body.particles.volume[i] / 0.02;
      if (body.particles.y[i] > 0.1 - dx)
        rest.intact_top = std::max(rest.intact_top, body.particles.x[i]);
    }
  std::printf("  dx = %.5f m: front %.4f m, intact %.3f of the column, its top to %.4f m, balance "
              "%.4f\n",
              dx, rest.front, rest.intact_share, rest.intact_top, rest.balance);
  return rest;
}
} // namespace berm::tests
