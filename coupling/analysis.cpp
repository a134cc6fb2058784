// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/analysis.h"

#include "core/error.h"
#include "coupling/pore_pressure.h"
#ifdef BERM_WITH_SEEPAGE
#include "meshes/mesher.h"
#endif
#include "sph/discretisation.h"
#include "sph/fill.h"
#include "sph/packing_check.h"
#include "sph/run_out.h"
#include "sph/seeds.h"
#include "sph/trial.h"
#include "sph/updated_lagrangian.h"

#include <fmt/core.h>
#include <optional>
#include <utility>

namespace berm::coupling
{
namespace
{
/// Runs one stage: tells the observer, and keeps the time.
template <class Stage>
auto timed(Analysis& analysis, Observer& observer, const char* name, Stage&& stage)
{
  observer.stage(name);
  const Stopwatch watch;
  auto result = stage();
  analysis.stages.push_back({name, watch.elapsed()});
  return result;
}

#ifdef BERM_WITH_SEEPAGE
seepage::Solution solve_seepage(const Case& input, const meshes::Section& section,
                                Observer& observer)
{
  std::vector<seepage::Conductivity> conductivity;
  for (const Soil& soil : input.soils)
    conductivity.push_back(soil.conductivity.value());
  return seepage::solve(section, conductivity,
                        seepage::boundary_conditions(section, input.marked_boundaries),
                        input.seepage, observer);
}
#endif

Polyline hydrostatic_surface(const Case& input, const meshes::Section& section)
{
  if (input.water.pore_pressure != PorePressureKind::hydrostatic)
    return {};
  if (!input.water.free_surface.empty())
    return input.water.free_surface;
  const Polyline line = straight_free_surface(section);
  if (line.empty())
    throw InputError({{.key = "water.free_surface_m",
                       .value = {},
                       .problem = "hydrostatic pore pressure needs a free surface or a pool",
                       .allowed = {},
                       .hint = "give free_surface_m, left_level_m or right_level_m"}});
  return line;
}

PorePressure make_pore_pressure(const Case& input, const Analysis& analysis,
                                const Polyline& free_surface)
{
  switch (input.water.pore_pressure)
  {
  case PorePressureKind::hydrostatic:
    return hydrostatic_pore_pressure(free_surface);
  case PorePressureKind::seepage:
    return seepage_pore_pressure(analysis.seepage.value(), input.sph.spacing);
  case PorePressureKind::none:
    break;
  }
  return no_pore_pressure();
}

std::vector<sph::Soil> mechanical(const std::vector<Soil>& soils)
{
  std::vector<sph::Soil> result;
  for (const Soil& soil : soils)
    result.push_back(soil.mechanical);
  return result;
}

/// The mesh is one of its own, as fine as the particles.
sph::Particles fill(const meshes::Section& section, const SphSettings& settings)
{
  if (settings.packing != "mesh")
    return sph::fill(section, settings.spacing, settings.packing);
#ifdef BERM_WITH_SEEPAGE
  meshes::ElementSize size;
  size.coarse = sph::mesh_size(settings.spacing);
  const meshes::TriangleMesh mesh = meshes::triangulate(section, size);
  return sph::fill_from_seeds(section, sph::mesh_seeds(mesh), settings.spacing, "mesh");
#else
  throw InputError({{.key = "sph.packing",
                     .value = "mesh",
                     .problem = "this berm was built without its mesher",
                     .allowed = "auto, columns, lattice, hexagonal",
                     .hint = "build with BERM_WITH_SEEPAGE, or leave sph.packing out"}});
#endif
}

/// Particles with the water in their pores, ready to settle.
struct Body
{
  sph::Particles particles;
  std::vector<double> pore_pressure; ///< [Pa]
  sph::Discretisation discretisation;
};

/// @throws InputError if the packing would lie.
Body make_body(const meshes::Section& section, const SphSettings& settings,
               const std::vector<sph::Soil>& soils, const PorePressure& p_w)
{
  Body body;
  sph::Particles& particles = body.particles = fill(section, settings);
  body.pore_pressure = p_w(particles.x, particles.y);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const sph::Soil& soil = soils[static_cast<std::size_t>(particles.soil[i])];
    particles.density[i] = body.pore_pressure[i] > 0 ? soil.saturated_density : soil.density;
  }
  body.discretisation = sph::discretise(particles, soils, body.pore_pressure, section);
  sph::require_sound_packing(sph::measure_packing(particles, body.discretisation, section),
                             particles);
  return body;
}

sph::FactorOfSafety factor_of_safety(const sph::SoilModel& model, const sph::State& settled,
                                     const std::vector<sph::Soil>& soils, const Case& input,
                                     Observer& observer)
{
  const auto trial = [&](double factor, Observer& trial_observer)
  {
    return sph::run_trial(model, settled, sph::reduced_cones(soils, factor, input.sph.cone), factor,
                          trial_observer);
  };
  return sph::reduce_strength(trial, input.search, observer);
}

/// Of settling and all trials.
double particle_steps(const sph::Settled& settled, const sph::FactorOfSafety& factor,
                      std::size_t particles)
{
  double steps = static_cast<double>(settled.steps);
  for (const sph::Trial& t : factor.trials)
    steps += static_cast<double>(t.steps);
  return steps * static_cast<double>(particles);
}

constexpr std::size_t worth_a_coarse_search = 6000; // particles; below, all of it takes a second

/// Nothing where the section is too coarse for it, or where the search found no answer.
std::optional<CoarseFactor> coarse_factor(const Case& input, const meshes::Section& section,
                                          const std::vector<sph::Soil>& soils,
                                          const PorePressure& p_w, Observer& observer)
try
{
  SphSettings settings = input.sph;
  settings.spacing *= 2;
  const Body body = make_body(section, settings, soils, p_w);
  const sph::Settled settled = sph::settle(body.discretisation, observer);
  const sph::FactorOfSafety F =
      factor_of_safety(body.discretisation, settled.state, soils, input, observer);
  if (!F.complete)
    return std::nullopt;
  return CoarseFactor{.spacing = settings.spacing,
                      .stands = F.stands.value(),
                      .fails = F.fails.value(),
                      .particle_steps = particle_steps(settled, F, body.particles.size())};
}
catch (const InputError&) // its packing is refused
{
  return std::nullopt;
}

/// The critical circle on the side to which the slope fails; on the weaker side if that is not
/// known.
std::optional<SlipCircle> find_critical_circle(const LimitEquilibriumModel& model,
                                               const std::optional<sph::Mechanism>& mechanism)
{
  if (!model.section.single_valued)
    return std::nullopt;
  if (mechanism)
    return critical_circle(model, mechanism->side == "right", 0);
  const auto left = critical_circle(model, false, 0), right = critical_circle(model, true, 0);
  return !left || (right && right->bishop < left->bishop) ? right : left;
}
/// Undamped but for viscosity; in the terms of the formulation that the trials used.
sph::UpdatedLagrangianSettings run_out_terms(const SphSettings& settings)
{
  if (settings.formulation != "paper")
    return {.gradient_correction = true};
  sph::UpdatedLagrangianSettings terms = sph::paper_settings();
  terms.local_damping = 0;
  return terms;
}

/// Nothing if it was to go on from a failing trial and there is none.
std::optional<RunOut> run_out(const Case& input, const meshes::Section& section,
                              const std::vector<sph::Soil>& soils, const PorePressure& p_w,
                              const Stability& stability, RunOutStore& frames, Observer& observer)
{
  const sph::Trial* failing = stability.factor_of_safety.failing_trial();
  if (!input.run_out->factor && !failing)
  {
    observer.warn("no run-out: no trial failed, and runout.factor is not given");
    return std::nullopt;
  }
  RunOut result;
  result.from_trial = !input.run_out->factor;
  result.factor = input.run_out->factor ? *input.run_out->factor : failing->factor;
  const bool wet = input.water.pore_pressure != PorePressureKind::none;
  sph::MovingBody body = sph::moving_body(stability.particles, soils,
                                          wet ? stability.pore_pressure : std::vector<double>{},
                                          section, run_out_terms(input.sph));
  if (wet)
    body.reread_pressure = input.water.pore_pressure == PorePressureKind::seepage
                               ? pore_pressure_in_space(p_w, section)
                               : p_w;
  const sph::Frame first =
      sph::first_frame(body, result.from_trial ? failing->state : stability.settled);
  for (const Soil& soil : input.soils)
    if (soil.mechanical.dilation_angle > 0)
      observer.warn("soil." + soil.name +
                    " dilates as long as it flows; dilation_angle_deg = 0 is usual for a run-out");
  frames.open(stability.particles, result.factor, input.run_out->motion);
  result.motion =
      sph::run_out(body, sph::reduced_cones(soils, result.factor, input.sph.cone), first,
                   section.y_max - section.y_min, input.run_out->motion, frames, observer);
  result.shape = sph::final_shape(stability.particles, result.motion.last.state, section);
  return result;
}
} // namespace

Analysis analyse(const Case& input, Observer& observer)
{
  RunOutStore none;
  return analyse(input, observer, none);
}

Analysis analyse(const Case& given, Observer& observer, RunOutStore& frames)
{
  Case input = given;
  Analysis analysis;
  analysis.section = meshes::build_section(input.section);
  const meshes::Section& section = analysis.section;

#ifdef BERM_WITH_SEEPAGE
  if (input.water.pore_pressure == PorePressureKind::seepage)
    analysis.seepage = timed(analysis, observer, "seepage",
                             [&] { return solve_seepage(input, section, observer); });
#endif
  if ((!input.stability && !input.run_out) || observer.stop_requested())
  {
    analysis.interrupted = observer.stop_requested();
    return analysis;
  }

  if (input.sph.spacing <= 0)
    input.sph.spacing = sph::default_spacing(section);
  const std::vector<sph::Soil> soils = mechanical(input.soils);
  Stability& stability = analysis.stability.emplace();

  stability.free_surface = hydrostatic_surface(input, section);
  const PorePressure p_w = make_pore_pressure(input, analysis, stability.free_surface);
  Body body = timed(analysis, observer, "particles",
                    [&] { return make_body(section, input.sph, soils, p_w); });
  stability.particles = std::move(body.particles);
  stability.pore_pressure = std::move(body.pore_pressure);

  std::optional<sph::MovingBody> moving;
  if (input.sph.formulation == "paper")
    moving = sph::moving_body(stability.particles, soils, stability.pore_pressure, section,
                              sph::paper_settings());
  const sph::SoilModel model =
      moving ? sph::SoilModel(*moving) : sph::SoilModel(body.discretisation);

  // The paper's soil is elastoplastic from the start; elastic settling also serves below F = 1.
  std::vector<sph::Cone> settling_cones;
  if (moving)
    settling_cones = sph::reduced_cones(soils, 1, input.sph.cone);
  const sph::Settled settled = timed(analysis, observer, "settling",
                                     [&] { return sph::settle(model, observer, settling_cones); });
  stability.settled = settled.state;
  stability.settlement = settled.settlement;
  if (!moving) // without gradient correction every packing settles too far
    sph::require_sound_settlement(settled.settlement, body.discretisation, stability.particles);

  if (input.stability && !moving && stability.particles.size() >= worth_a_coarse_search)
    stability.coarse = timed(analysis, observer, "coarse search",
                             [&] { return coarse_factor(input, section, soils, p_w, observer); });
  if (stability.coarse)
    input.search.guess = stability.coarse->factor();
  if (input.stability)
    stability.factor_of_safety =
        timed(analysis, observer, "strength reduction",
              [&] { return factor_of_safety(model, settled.state, soils, input, observer); });
  analysis.interrupted = observer.stop_requested();

  stability.particle_steps =
      particle_steps(settled, stability.factor_of_safety, stability.particles.size()) +
      (stability.coarse ? stability.coarse->particle_steps : 0);
  if (const sph::Trial* failing = stability.factor_of_safety.failing_trial())
    stability.mechanism = sph::find_mechanism(stability.particles, failing->state, section);
  if (input.stability && !analysis.interrupted)
    stability.critical_circle =
        timed(analysis, observer, "limit equilibrium",
              [&] {
                return find_critical_circle({section, soils, p_w}, stability.mechanism);
              });
  if (input.run_out && !analysis.interrupted)
    analysis.run_out =
        timed(analysis, observer, "run-out",
              [&] { return run_out(input, section, soils, p_w, stability, frames, observer); });
  if (analysis.run_out)
  {
    stability.particle_steps += static_cast<double>(analysis.run_out->motion.steps) *
                                static_cast<double>(stability.particles.size());
    analysis.interrupted = analysis.run_out->motion.interrupted;
  }
  return analysis;
}
} // namespace berm::coupling
