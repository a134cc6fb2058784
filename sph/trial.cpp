// SPDX-License-Identifier: GPL-2.0-or-later
#include "sph/trial.h"

#include "core/error.h"
#include "sph/total_lagrangian.h"
#include "sph/verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

namespace berm::sph
{
namespace
{
constexpr double local_damping = 0.8; // F does not depend on it between 0.7 and 0.8

/// Advance by one window of T0 and return its velocity measure s = mean(v_rms) T0 / d_ref [-].
double run_window(TotalLagrangian& soil, const Discretisation& d)
{
  constexpr int samples = 16;
  const auto steps = std::max(1L, std::lround(d.T0 / d.dt / samples));
  double sum = 0;
  for (int k = 0; k < samples; ++k)
  {
    soil.advance(steps);
    sum += soil.v_rms();
  }
  soil.check_finite();
  return sum / samples * d.T0 / d.d_ref;
}
} // namespace

Settled settle(const Discretisation& d, Observer& observer)
{
  constexpr double settled_measure = 1e-4, longest = 300;
  const auto n = static_cast<std::size_t>(d.n);
  const std::vector<double> zero(n, 0.0);
  TotalLagrangian soil(d, {}, local_damping,
                       {.ux = zero,
                        .uy = zero,
                        .vx = zero,
                        .vy = zero,
                        .stress = std::vector<SymTensor>(n),
                        .plastic_strain = zero});
  double first = 0;
  for (;;)
  {
    const double s = run_window(soil, d);
    const double time = soil.time() / d.T0;
    first = std::max(first, s);
    observer.progress(std::log(first / s) / std::log(first / settled_measure), "settling");
    if (s < settled_measure && time >= 4)
      break;
    if (observer.stop_requested())
      throw NotConverged("stopped while settling");
    if (time > longest)
      throw NotConverged(fmt::format("the soil did not settle within {:.0f} T0: velocity measure "
                                     "{:.3g}, wanted {:.3g}",
                                     time, s, settled_measure));
  }
  Settled settled{
      .state = soil.state(), .settlement = soil.max_displacement(), .steps = soil.steps()};
  settled.state.ux = settled.state.uy = settled.state.vx = settled.state.vy = zero;
  return settled;
}

std::vector<Cone> reduced_cones(std::span<const Soil> soils, double factor, const std::string& cone)
{
  std::vector<Cone> cones;
  for (const Soil& soil : soils)
  {
    const double c = soil.cohesion / factor;
    const double phi = std::atan(std::tan(soil.friction_angle) / factor);
    const double psi = std::min(soil.dilation_angle, phi);
    cones.push_back(cone == "paper" ? paper_cone(c, phi, psi) : fit_plane_strain(c, phi, psi));
  }
  return cones;
}

Trial run_trial(const Discretisation& d, const State& settled, std::vector<Cone> cones,
                double factor, Observer& observer)
{
  const Stopwatch watch;
  Trial trial;
  trial.factor = factor;
  TotalLagrangian soil(d, std::move(cones), local_damping, settled);
  Verdict verdict;
  bool over = false;
  while (!over && !trial.interrupted)
  {
    trial.velocity_measure = run_window(soil, d);
    trial.max_displacement = soil.max_displacement();
    const double time = soil.time() / d.T0;
    over = verdict.add_window(time, trial.velocity_measure, trial.max_displacement / d.d_ref);
    trial.interrupted = !over && observer.stop_requested();
    observer.progress(time / (time + 10), {}); // trials take some 10 to 40 T0
  }
  trial.outcome = verdict.outcome();
  trial.reason = trial.interrupted ? "stopped" : verdict.reason();
  trial.time = soil.time();
  trial.steps = soil.steps();
  trial.state = soil.state();
  trial.seconds = watch.elapsed();
  return trial;
}
} // namespace berm::sph
