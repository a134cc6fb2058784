// SPDX-License-Identifier: GPL-3.0-or-later
/// Claim D-11 of docs/verification.md: order of the sums over particles on smooth fields, and what
/// they reproduce exactly. Both solvers, regular and disordered points.
#include "sph/kernel.h"
#include "sph/total_lagrangian.h"
#include "sph/updated_lagrangian.h"
#include "tests/support/moving_soil.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace berm::sph
{
namespace
{
constexpr double jitter = 0.2; // width of the random moves over dx
constexpr double wave = 2 * pi;

/// One solver on one packing of the unit square, ready for one step.
struct Rates
{
  meshes::Section section = tests::block(1, 1);
  Soil soil = tests::embankment_soil();
  Particles particles;
  bool updated, free;
  MovingBody body;
  Discretisation d;

  Rates(double dx, double width, bool updated_, UpdatedLagrangianSettings settings)
      : updated(updated_), free(settings.gravity == 0)
  {
    if (width > 0)
      particles = tests::jittered_block(section, dx, width, soil.density);
    else
      particles = fill(section, dx, "columns");
    tests::set_density(particles, soil.density);
    body = moving_body(particles, std::vector{soil}, {}, section, settings);
    if (free)
      body.walls = {};
    d = discretise(particles, std::vector{soil}, std::vector<double>(particles.size(), 0.0),
                   section);
  }

  /// State after one step, and its length [s].
  [[nodiscard]] std::pair<State, double> step(const State& start) const
  {
    if (updated)
    {
      UpdatedLagrangian solver(body, {}, start);
      const double dt = solver.time_step();
      solver.advance(1);
      return {solver.state(), dt};
    }
    TotalLagrangian solver(d, {}, 0, start);
    solver.advance(1);
    return {solver.state(), d.dt};
  }

  [[nodiscard]] bool inside(std::size_t i, double margin) const
  {
    return std::min({particles.x[i], particles.y[i], 1 - particles.x[i], 1 - particles.y[i]}) >
           margin;
  }

  [[nodiscard]] State rest() const { return unstressed(static_cast<Index>(particles.size())); }

  /// Relative rms error of the rate of sigma_xx for v_x = sin(k x) cos(k y), v_y = 0.
  [[nodiscard]] double gradient_error() const
  {
    State start = rest();
    for (std::size_t i = 0; i < particles.size(); ++i)
      start.vx[i] = 1e-6 * std::sin(wave * particles.x[i]) * std::cos(wave * particles.y[i]);
    const auto [end, dt] = step(start);
    const double M = elastic_moduli(soil.young_modulus, soil.poisson_ratio).M();
    double error = 0, size = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (inside(i, 0.2))
      {
        const double exact =
            1e-6 * M * wave * std::cos(wave * particles.x[i]) * std::cos(wave * particles.y[i]);
        error += std::pow(end.stress[i].xx / dt - exact, 2);
        size += exact * exact;
      }
    return std::sqrt(error / size);
  }

  /// Acceleration [m/s2] less gravity by the given stress.
  [[nodiscard]] std::vector<Vec2>
  acceleration(const std::function<SymTensor(double, double)>& at) const
  {
    State start = rest();
    for (std::size_t i = 0; i < particles.size(); ++i)
      start.stress[i] = at(particles.x[i], particles.y[i]);
    const auto [end, dt] = step(start);
    std::vector<Vec2> a;
    for (std::size_t i = 0; i < particles.size(); ++i)
      a.push_back(Vec2{end.vx[i], end.vy[i]} / dt + Vec2{0, free && updated ? 0 : gravity});
    return a;
  }
};

SymTensor smooth_stress(double x, double y)
{
  return {std::sin(wave * x) * std::cos(wave * y), 0, 0,
          0.5 * std::cos(wave * x) * std::sin(wave * y)};
}
Vec2 divergence(double x, double y) // of the smooth stress
{
  return wave * Vec2{1.5 * std::cos(wave * x) * std::cos(wave * y),
                     -0.5 * std::sin(wave * x) * std::sin(wave * y)};
}

/// Relative rms error of the acceleration.
double divergence_error(const Rates& r)
{
  const std::vector<Vec2> a = r.acceleration(smooth_stress);
  double error = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (r.inside(i, 0.2))
    {
      const Vec2 exact = divergence(r.particles.x[i], r.particles.y[i]);
      error += (r.soil.density * a[i] - exact).squaredNorm();
      size += exact.squaredNorm();
    }
  return std::sqrt(error / size);
}

/// Relative error of int w . div sigma with a test function that vanishes outside a disc.
double weak_divergence_error(const Rates& r)
{
  const std::vector<Vec2> a = r.acceleration(smooth_stress);
  const auto w = [](double x, double y)
  {
    const double q = std::hypot(x - 0.45, y - 0.55) / 0.3;
    return q < 1 ? std::pow(1 - q * q, 3) : 0;
  };
  double sum = 0, exact = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum +=
        r.particles.volume[i] * r.soil.density * a[i].x() * w(r.particles.x[i], r.particles.y[i]);
  constexpr int n = 1000; // midpoint rule, error 1e-6
  for (int p = 0; p < n; ++p)
    for (int q = 0; q < n; ++q)
    {
      const double x = (p + 0.5) / n, y = (q + 0.5) / n;
      const double f = w(x, y) * divergence(x, y).x() / n / n;
      exact += f;
      size += std::abs(f);
    }
  return std::abs(sum - exact) / size;
}

struct Errors
{
  double gradient, divergence, weak;
};

std::vector<Errors> errors(double width, bool updated, const UpdatedLagrangianSettings& settings)
{
  std::vector<Errors> e;
  for (const int n : {16, 32, 64})
  {
    const Rates r(1. / n, width, updated, settings);
    e.push_back({r.gradient_error(), divergence_error(r), weak_divergence_error(r)});
    std::printf("  dx = 1/%d: gradient %.3e, divergence %.3e, weakly %.3e\n", n, e.back().gradient,
                e.back().divergence, e.back().weak);
  }
  return e;
}

const UpdatedLagrangianSettings corrected = {.gradient_correction = true, .gravity = 0};
const UpdatedLagrangianSettings plain = {.gradient_correction = false, .gravity = 0};
/// B_xx^-1 of eq. (9.2) on a square lattice, to which uncorrected gradients tend in place of one.
double lattice_sum()
{
  const CubicSpline W{1.2};
  double sum = 0;
  for (int p = -3; p <= 3; ++p)
    for (int q = -3; q <= 3; ++q)
      if (p != 0 || q != 0)
        sum -= p * p * W.dW(std::hypot(p, q)) / std::hypot(p, q);
  return sum;
}
} // namespace

TEST(Operators, AreOfSecondOrderOnRegularPoints)
{
  for (const bool updated : {false, true})
  {
    const std::vector<Errors> e = errors(0, updated, corrected);
    for (std::size_t k = 1; k < e.size(); ++k)
    {
      EXPECT_NEAR(tests::observed_order(e[k - 1].gradient, e[k].gradient), 2, 0.1);
      EXPECT_NEAR(tests::observed_order(e[k - 1].divergence, e[k].divergence), 2, 0.1);
    }
  }
}

/// On disordered points the corrected gradient is of first order at least (it is exact on linear
/// fields); the sum of stresses is not consistent point by point: a constant stress leaves a force
/// of the packing's residual over dx. As the adjoint of the gradient it is consistent as a whole.
TEST(Operators, OnDisorderedPointsConvergeInTheGradientAndInTheWeakDivergence)
{
  for (const bool updated : {false, true})
  {
    const std::vector<Errors> e = errors(jitter, updated, corrected);
    for (std::size_t k = 1; k < e.size(); ++k)
    {
      EXPECT_GT(tests::observed_order(e[k - 1].gradient, e[k].gradient), 1);
      EXPECT_GT(tests::observed_order(e[k - 1].weak, e[k].weak), 1);
      EXPECT_LT(tests::observed_order(e[k - 1].divergence, e[k].divergence), 0); // known limit
    }
  }
}

/// Without the correction every gradient on a lattice is too small by a constant factor, whatever
/// dx: the literal form of Bui et al. 2009 does not converge to better than that.
TEST(Operators, WithoutCorrectionTendToTheSumOverTheLattice)
{
  const double m = lattice_sum();
  const std::vector<Errors> with = errors(0, true, corrected), without = errors(0, true, plain);
  for (std::size_t k = 0; k < with.size(); ++k)
    EXPECT_NEAR(without[k].gradient, 1 - (1 - with[k].gradient) * m, 1e-5); // rms of one mode
  EXPECT_NEAR(m, 1, 0.01);
}

/// Fields that the walls allow: no velocity at the base, none across the sides.
TEST(Patch, AConstantStrainRateIsExactOnDisorderedPointsUpToBaseAndSurface)
{
  for (const bool updated : {false, true})
  {
    const Rates r(0.05, jitter, updated, {.gradient_correction = true});
    const Elastic e = elastic_moduli(r.soil.young_modulus, r.soil.poisson_ratio);
    State start = r.rest();
    for (std::size_t i = 0; i < r.particles.size(); ++i)
    {
      start.vx[i] = 4e-9 * r.particles.y[i];
      start.vy[i] = -3e-9 * r.particles.y[i];
    }
    const auto [end, dt] = r.step(start);
    const double volume = (e.K - 2 * e.G / 3) * -3e-9;
    double most = 0;
    for (std::size_t i = 0; i < r.particles.size(); ++i)
    {
      const SymTensor& s = end.stress[i];
      if (std::min(r.particles.x[i], 1 - r.particles.x[i]) > 0.12) // shear does not suit rollers
        most =
            std::max({most, std::abs(s.xx / dt - volume), std::abs(s.yy / dt - volume + 6e-9 * e.G),
                      std::abs(s.xy / dt - 4e-9 * e.G)});
    }
    EXPECT_LT(most, 1e-12 * 4e-9 * e.M()); // rounding
  }
}

/// Farther than 4 h from any end, where the neighbours too have whole neighbourhoods.
TEST(Patch, ALinearStressIsExactInside)
{
  for (const bool updated : {false, true})
  {
    const Rates r(0.05, 0, updated, corrected);
    const std::vector<Vec2> a = r.acceleration(
        [](double x, double y) {
          return SymTensor{1 + 2 * x - y, 3 * y - x, 5, x + 4 * y};
        });
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (r.inside(i, 0.24))
        most = std::max(most, (r.soil.density * a[i] - Vec2{2 + 4, 1 + 3}).norm());
    EXPECT_LT(most, 1e-12 * r.soil.density * gravity); // rounding of the sum with gravity
  }
}

/// The stress of soil at rest balances its weight to rounding inside, at the base and at the sides.
/// Within 4 h of the surface the sums miss part of their support; what they leave there is a share
/// of the weight of one row, whatever dx, and moves the two uppermost rows (claim D-1).
TEST(Patch, GeostaticStressBalancesItsWeightAtTheWalls)
{
  for (const bool updated : {false, true})
    for (const double dx : {0.05, 0.025})
    {
      const Rates r(dx, 0, updated, {.gradient_correction = true});
      const double gamma = r.soil.density * gravity;
      const std::vector<Vec2> a = r.acceleration(
          [=](double, double y) {
            return SymTensor{-0.4 * gamma * (1 - y), -gamma * (1 - y), -0.4 * gamma * (1 - y), 0};
          });
      double surface = 0, wall = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
      {
        const double error = (a[i] - Vec2{0, gravity}).norm() / gravity;
        double& most = r.particles.y[i] > 1 - 4 * 1.2 * dx ? surface : wall;
        most = std::max(most, error);
      }
      std::printf("  walls %.1e g, surface %.3f g\n", wall, surface);
      EXPECT_LT(wall, 1e-11); // rounding
      EXPECT_LT(surface, 0.5);
    }
}
} // namespace berm::sph
