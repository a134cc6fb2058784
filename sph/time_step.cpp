// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/time_step.h"

#include "sph/total_lagrangian.h"

#include <cmath>
#include <random>

namespace berm::sph
{
double stability_number(const Discretisation& d, int iterations)
{
  // Without body forces a step from zero stress gives v - (dt^2 K + dt C) v: take it with 2 C.
  const auto n = static_cast<std::size_t>(d.n);
  const std::vector<double> zero(n, 0.0);
  State state{.ux = zero,
              .uy = zero,
              .vx = zero,
              .vy = zero,
              .stress = std::vector<SymTensor>(n),
              .plastic_strain = zero};
  std::mt19937_64 engine(1);
  const auto random = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  for (std::size_t i = 0; i < n; ++i)
  {
    state.vx[i] = random();
    state.vy[i] = random();
  }

  TotalLagrangian one_step(d, {}, 0, state, {.viscosity = 2, .body_forces = false});
  double lambda = 0;
  for (int k = 0; k < iterations; ++k)
  {
    one_step.restart(state);
    one_step.advance(1);
    const State after = one_step.state();
    double before2 = 0, change2 = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      before2 += state.vx[i] * state.vx[i] + state.vy[i] * state.vy[i];
      state.vx[i] -= after.vx[i];
      state.vy[i] -= after.vy[i];
      change2 += state.vx[i] * state.vx[i] + state.vy[i] * state.vy[i];
    }
    lambda = std::sqrt(change2 / before2);
    const double scale = 1 / std::sqrt(change2);
    for (std::size_t i = 0; i < n; ++i)
    {
      state.vx[i] *= scale;
      state.vy[i] *= scale;
    }
  }
  return lambda;
}

void limit_time_step(Discretisation& d)
{
  constexpr double allowed =
      2.2; // 4 / (1 + zeta): local damping stiffens where force opposes motion
  const double lambda = stability_number(d);
  if (lambda > allowed)
    d.dt *= allowed / lambda; // the elastic part falls with dt^2, the viscous one with dt
}
} // namespace berm::sph
