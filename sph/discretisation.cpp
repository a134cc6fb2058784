// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/discretisation.h"

#include "sph/kernel.h"
#include "sph/scales.h"
#include "sph/time_step.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace berm::sph
{
namespace
{
constexpr double smoothing_ratio = 1.2; // h / dx; above 1.35 the soil does not settle
constexpr double courant_number = 0.8;  // dt c_p / h; 1.0 is unstable
constexpr double alpha = 0.1;           // artificial viscosity, Bui et al. 2009 eq. (8)

/// V_j grad_i W_ij [1/m]
std::array<double, 2> weighted_gradient(const CubicSpline& W, double dx, double dy, double V_j)
{
  const double r = std::hypot(dx, dy); // of x_i - x_j
  const double g = V_j * W.dW(r) / r;
  return {g * dx, g * dy};
}
} // namespace

std::vector<SymTensor> gradient_correction(std::span<const double> x, std::span<const double> y,
                                           std::span<const double> volume,
                                           const NeighbourList& neighbours, double h)
{
  const CubicSpline W{h};
  const std::size_t n = neighbours.begin.size() - 1;
  std::vector<SymTensor> B(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    Eigen::Matrix2d M = Eigen::Matrix2d::Zero();
    for (const Index jj : neighbours.of(static_cast<Index>(i)))
    {
      const auto j = static_cast<std::size_t>(jj);
      const double dx = x[i] - x[j], dy = y[i] - y[j];
      const auto [gx, gy] = weighted_gradient(W, dx, dy, volume[j]);
      M(0, 0) -= dx * gx;
      M(0, 1) -= 0.5 * (dx * gy + dy * gx);
      M(1, 1) -= dy * gy;
    }
    M(1, 0) = M(0, 1);
    // 1/lambda on each principal direction; a direction without neighbours keeps 1.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(M);
    Eigen::Vector2d inverse;
    for (int d = 0; d < 2; ++d)
      inverse[d] = eigen.eigenvalues()[d] > 0.1 ? 1 / eigen.eigenvalues()[d] : 1;
    const Eigen::Matrix2d B_i =
        eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
    B[i] = {.xx = B_i(0, 0), .yy = B_i(1, 1), .zz = 0, .xy = B_i(0, 1)};
  }
  return B;
}

std::vector<Vec2> pore_pressure_acceleration(const Particles& particles,
                                             std::span<const double> p_w, double h)
{
  const CubicSpline W{h};
  const auto n = static_cast<Index>(particles.size());
  const NeighbourList neighbours = find_neighbours(particles.x, particles.y, n, W.radius());
  const std::vector<SymTensor> B =
      gradient_correction(particles.x, particles.y, particles.volume, neighbours, h);

  std::vector<Vec2> acceleration(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    double sx = 0, sy = 0;
    for (const Index jj : neighbours.of(static_cast<Index>(i)))
    {
      const auto j = static_cast<std::size_t>(jj);
      const auto [gx, gy] = weighted_gradient(W, particles.x[i] - particles.x[j],
                                              particles.y[i] - particles.y[j], particles.volume[j]);
      sx += (p_w[j] - p_w[i]) * gx;
      sy += (p_w[j] - p_w[i]) * gy;
    }
    acceleration[i] =
        Vec2{B[i].xx * sx + B[i].xy * sy, B[i].xy * sx + B[i].yy * sy} / -particles.density[i];
  }
  return acceleration;
}

Discretisation discretise(const Particles& particles, std::span<const Soil> soils,
                          std::span<const double> p_w, const meshes::Section& section)
{
  Discretisation d;
  d.n = static_cast<Index>(particles.size());
  d.h = smoothing_ratio * particles.spacing;
  d.density = particles.density;
  d.soil = particles.soil;
  const CubicSpline W{d.h};
  const auto n = particles.size();

  // Step 1: wave speeds, time step, and the scales of time and displacement.
  for (const Soil& soil : soils)
    d.elastic.push_back(elastic_moduli(soil.young_modulus, soil.poisson_ratio));
  const auto moduli = [&](std::size_t i) -> const Elastic&
  { return d.elastic[static_cast<std::size_t>(particles.soil[i])]; };
  double c_p_max = 0;
  for (std::size_t i = 0; i < n; ++i)
    c_p_max = std::max(c_p_max, std::sqrt(moduli(i).M() / particles.density[i]));
  d.dt = courant_number * d.h / c_p_max;
  d.height = section.y_max - section.y_min;
  const Scales scales = body_scales(particles, soils, d.height);
  d.T0 = scales.T0;
  d.d_ref = scales.d_ref;

  // Step 2: particles and their mirror images, ghosts ordered by source.
  d.ghosts = mirror_ghosts(particles, section, W.radius());
  std::stable_sort(d.ghosts.begin(), d.ghosts.end(),
                   [](const Ghost& a, const Ghost& b) { return a.source < b.source; });
  d.ghost_begin.assign(n + 1, 0);
  for (const Ghost& g : d.ghosts)
    ++d.ghost_begin[static_cast<std::size_t>(g.source) + 1];
  for (std::size_t i = 0; i < n; ++i)
    d.ghost_begin[i + 1] += d.ghost_begin[i];
  std::vector<double> x = particles.x, y = particles.y, V = particles.volume;
  std::vector<Index> source(n);
  for (std::size_t i = 0; i < n; ++i)
    source[i] = static_cast<Index>(i);
  for (const Ghost& g : d.ghosts)
  {
    x.push_back(g.x);
    y.push_back(g.y);
    V.push_back(particles.volume[static_cast<std::size_t>(g.source)]);
    source.push_back(g.source);
  }

  // Step 3: pairs. Soil much stiffer than the rest would creep against a viscosity of its own.
  const double fastest_shear = 2 * d.height / d.T0;
  const auto viscous_speed = [&](std::size_t i)
  {
    const double c_p = std::sqrt(moduli(i).M() / particles.density[i]);
    const double c_s = std::sqrt(moduli(i).G / particles.density[i]);
    return c_p * std::min(1.0, fastest_shear / c_s);
  };
  d.neighbours = find_neighbours(x, y, d.n, W.radius());
  d.B = gradient_correction(x, y, V, d.neighbours, d.h);
  d.G.reserve(d.neighbours.index.size());
  d.viscosity.reserve(d.neighbours.index.size());
  for (std::size_t i = 0; i < n; ++i)
  {
    const double c_i = viscous_speed(i);
    for (const Index jj : d.neighbours.of(static_cast<Index>(i)))
    {
      const auto j = static_cast<std::size_t>(jj), j0 = static_cast<std::size_t>(source[j]);
      const double dx = x[i] - x[j], dy = y[i] - y[j], r = std::hypot(dx, dy);
      const double c_j = viscous_speed(j0);
      d.G.push_back(weighted_gradient(W, dx, dy, V[j]));
      d.viscosity.push_back(-alpha * 0.5 * (c_i + c_j) * d.h * r /
                            (W.dW(r) * V[j] * (r * r + 0.01 * d.h * d.h)));
    }
  }

  if (particles.packing == "columns")
    d.panels = arrange_panels(d, x, y);

  // Step 4: body forces.
  const std::vector<Vec2> push = pore_pressure_acceleration(particles, p_w, d.h);
  for (const Vec2& a : push)
  {
    d.bx.push_back(a.x());
    d.by.push_back(a.y() - gravity);
  }

  // Step 5: the time step that this packing allows.
  limit_time_step(d);
  return d;
}
} // namespace berm::sph
