// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/moving_soil.h"

#include <cmath>
#include <cstdio>
#include <vector>

/// Claim D-7 of docs/verification.md: the oscillating plate of Gray, Monaghan & Swift 2001, clamped
/// at one end: L = 0.2 m, H = 0.02 m, E = 1.9985 MPa, nu = 0.3975, 1000 kg/m3.
namespace berm::tests
{
/// Clamped-free beam in plane strain with shear and rotatory inertia (Timoshenko's frequency
/// equation, Huang 1961): 1 % above the 0.2541 s of a thin plate. SPH in the literature has about
/// 0.27 s.
inline constexpr double plate_period = 0.2565;

/// Period [s] of the first mode at the plate's tip, and the amplitude [m] of the last swing over
/// that of the first.
struct Swing
{
  double period, left, balance;
};

/// The plate stands on the rough base, which holds it: there velocity vanishes.
inline Swing swing(double dx, double speed)
{
  using namespace sph;
  constexpr double L = 0.2, H = 0.02, E = 1.9985e6, nu = 0.3975, rho = 1000;
  Soil rubber;
  rubber.density = rubber.saturated_density = rho;
  rubber.young_modulus = E;
  rubber.poisson_ratio = nu;
  MovingBody body = moving_block(rubber, H, L, dx, {.gradient_correction = true, .gravity = 0});
  body.walls.left.reset();
  body.walls.right.reset();
  State start = at_rest(body);
  const double k = 1.875104 / L, kL = 1.875104;
  const auto shape = [&](double y) // of the clamped-free beam
  {
    return (std::cos(kL) + std::cosh(kL)) * (std::cosh(k * y) - std::cos(k * y)) +
           (std::sin(kL) - std::sinh(kL)) * (std::sinh(k * y) - std::sin(k * y));
  };
  for (std::size_t i = 0; i < start.vx.size(); ++i)
    start.vx[i] = speed * shape(body.particles.y[i]) / shape(L);
  UpdatedLagrangian plate(body, {}, start);
  const double e0 = plate.energies().total();
  // Times at which the tip passes its place of rest, and the largest way between them.
  std::vector<double> passed;
  std::vector<double> most{0};
  double before = 0, t_before = 0;
  while (passed.size() < 5 && plate.time() < 1)
  {
    plate.advance(20);
    const State s = plate.state();
    double tip = 0;
    int n = 0;
    for (std::size_t i = 0; i < s.ux.size(); ++i)
      if (body.particles.y[i] > L - dx)
      {
        tip += s.ux[i];
        ++n;
      }
    tip /= n;
    most.back() = std::max(most.back(), std::abs(tip));
    if (before * tip < 0)
    {
      passed.push_back(t_before + (plate.time() - t_before) * before / (before - tip));
      most.push_back(0);
    }
    before = tip;
    t_before = plate.time();
  }
  if (passed.size() < 5)
    return {};
  const Swing s{(passed[4] - passed[0]) / 2, most[4] / most[0], plate.energies().total() / e0 - 1};
  std::printf("  dx = H/%.0f: T = %.4f s (%.1f %%), left %.3f, balance %.1e\n", H / dx, s.period,
              100 * (s.period / plate_period - 1), s.left, s.balance);
  return s;
}
} // namespace berm::tests
