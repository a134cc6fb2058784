// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/trial.h"

#include "core/error.h"
#include "sph/verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <utility>

namespace berm::sph
{
namespace
{
/// Advance by one window of T0 and return its velocity measure s = mean(v_rms) T0 / d_ref [-].
double run_window(SoilSolver& soil, const SoilModel& model)
{
  constexpr int samples = 16;
  double sum = 0;
  for (int k = 0; k < samples; ++k)
  {
    soil.advance(std::max(1L, std::lround(model.T0 / soil.time_step() / samples)));
    sum += soil.v_rms();
  }
  soil.check_finite();
  return sum / samples * model.T0 / model.d_ref;
}
} // namespace

Settled settle(const SoilModel& model, Observer& observer, std::vector<Cone> cones)
{
  constexpr double settled_measure = 1e-4, longest = 300;
  const std::unique_ptr<SoilSolver> soil = model.solver(std::move(cones), unstressed(model.n));
  double first = 0;
  for (;;)
  {
    const double s = run_window(*soil, model);
    const double time = soil->time() / model.T0;
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
      .state = soil->state(), .settlement = soil->max_displacement(), .steps = soil->steps()};
  const State zero = unstressed(model.n);
  settled.state.ux = settled.state.uy = zero.ux;
  settled.state.vx = settled.state.vy = zero.vx;
  settled.state.plastic_strain = zero.plastic_strain;
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
    Cone& last = cones.emplace_back(cone == "paper" ? paper_cone(c, phi, psi)
                                                    : fit_plane_strain(c, phi, psi));
    if (const double cut_off = 3 * soil.tensile_strength / factor; cut_off * last.alpha < last.k)
      last.most_tension = cut_off;
  }
  return cones;
}

Trial run_trial(const SoilModel& model, const State& settled, std::vector<Cone> cones,
                double factor, Observer& observer)
{
  const Stopwatch watch;
  Trial trial;
  trial.factor = factor;
  const std::unique_ptr<SoilSolver> soil = model.solver(std::move(cones), settled);
  Verdict verdict;
  bool over = false;
  while (!over && !trial.interrupted)
  {
    trial.velocity_measure = run_window(*soil, model);
    trial.max_displacement = soil->max_displacement();
    const double time = soil->time() / model.T0;
    trial.history.push_back({soil->time(), trial.velocity_measure, trial.max_displacement});
    over = verdict.add_window(time, trial.velocity_measure, trial.max_displacement / model.d_ref);
    trial.interrupted = !over && observer.stop_requested();
    observer.progress(time / (time + 10), {}); // trials take some 10 to 40 T0
  }
  trial.outcome = verdict.outcome();
  trial.reason = trial.interrupted ? "stopped" : verdict.reason();
  trial.time = soil->time();
  trial.steps = soil->steps();
  trial.state = soil->state();
  trial.seconds = watch.elapsed();
  return trial;
}
} // namespace berm::sph
