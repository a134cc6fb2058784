// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/fill.h"
#include "sph/seeds.h"
#include "sph/soil_model.h"
#include "sph/updated_lagrangian.h"
#include "tests/support/sections.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

/// Blocks of soil that move, and what is measured of them.
namespace berm::tests
{
/// Columns on a rough base between rollers; take walls away as needed.
inline sph::MovingBody moving_block(const sph::Soil& soil, double length, double height, double dx,
                                    const sph::UpdatedLagrangianSettings& settings)
{
  const meshes::Section section = block(length, height);
  sph::Particles particles = sph::fill(section, dx, "columns");
  set_density(particles, soil.density);
  return sph::moving_body(particles, std::vector{soil}, {}, section, settings);
}

/// The same without walls.
inline sph::MovingBody free_block(const sph::Soil& soil, double length, double height, double dx,
                                  const sph::UpdatedLagrangianSettings& settings)
{
  sph::MovingBody body = moving_block(soil, length, height, dx, settings);
  body.walls = {};
  return body;
}

/// A square lattice each point of which is moved at random inside a square of the given width [dx].
inline sph::Particles jittered_block(const meshes::Section& section, double dx, double width,
                                     double density)
{
  sph::Particles particles = sph::fill_cells(
      section, sph::jittered(section, sph::square_seeds(section, dx), width * dx, 1), dx,
      "jittered");
  set_density(particles, density);
  return particles;
}

inline sph::State at_rest(const sph::MovingBody& body)
{
  return sph::unstressed(static_cast<Index>(body.particles.size()));
}

/// Velocity at a point [m/s].
using VelocityAt = std::function<Vec2(double x, double y)>;

/// Prescribe the velocity at the current positions.
inline void drive(sph::UpdatedLagrangian& soil, const VelocityAt& velocity)
{
  const sph::State now = soil.state();
  std::vector<double> vx, vy;
  for (std::size_t i = 0; i < now.x.size(); ++i)
  {
    const Vec2 v = velocity(now.x[i], now.y[i]);
    vx.push_back(v.x());
    vy.push_back(v.y());
  }
  soil.set_velocity(vx, vy);
}

/// Mean slope of y over x, by least squares.
inline double slope(const std::vector<double>& x, const std::vector<double>& y)
{
  const double n = static_cast<double>(x.size()), x_mean = total(x) / n, y_mean = total(y) / n;
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    xx += (x[k] - x_mean) * (x[k] - x_mean);
    xy += (x[k] - x_mean) * (y[k] - y_mean);
  }
  return xy / xx;
}

/// Order at which the error of the finer of two spacings, one half of the other, has fallen.
inline double observed_order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}
} // namespace berm::tests
