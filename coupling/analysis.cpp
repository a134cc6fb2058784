// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/analysis.h"

#include "core/error.h"
#include "coupling/body.h"
#include "coupling/pore_pressure.h"
#include "sph/fill.h"
#include "sph/packing_check.h"
#include "sph/run_out.h"
#include "sph/trial.h"
#include "sph/trial_bytes.h"
#include "sph/updated_lagrangian.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <optional>
#include <type_traits>
#include <utility>

namespace berm::coupling
{
namespace
{
/// Runs one stage: tells the observer, and keeps the time.
template <class Stage>
auto timed(Analysis& analysis, Observer& observer, const std::string& name, Stage&& stage)
{
  observer.stage(name);
  const Stopwatch watch;
  if constexpr (std::is_void_v<decltype(stage())>)
  {
    stage();
    analysis.stages.push_back({name, watch.elapsed()});
  }
  else
  {
    auto result = stage();
    analysis.stages.push_back({name, watch.elapsed()});
    return result;
  }
}

#ifdef BERM_WITH_SEEPAGE
seepage::Solution solve_seepage(const Case& input, const meshes::Section& section,
                                Observer& observer)
{
  std::vector<seepage::Conductivity> conductivity;
  for (const Soil& soil : input.soils)
    conductivity.push_back(soil.conductivity.value());
  return seepage::solve(section, conductivity,
                        seepage::boundary_conditions(section, input.marked_boundaries, input.rain),
                        input.seepage, observer);
}
#endif

Polyline hydrostatic_surface(const Case& input, const meshes::Section& section)
{
  if (input.water.pore_pressure != PorePressureKind::hydrostatic)
    return {};
  if (!input.water.free_surface.empty())
    return input.water.free_surface;
  Polyline line = straight_free_surface(section);
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
  result.reserve(soils.size());
  for (const Soil& soil : soils)
    result.push_back(soil.mechanical);
  return result;
}

/// Letters and digits of a text, '_' for all else.
std::string file_name(std::string text)
{
  for (char& c : text)
    c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return text;
}

/// @param[in] name  Of the search among those of the run, for the store.
sph::FactorOfSafety factor_of_safety(const Body& body, const Scene& scene,
                                     const sph::SearchSettings& search, const std::string& name,
                                     Observer& observer)
{
  const sph::SoilModel model = body.model();
  const auto trial = [&](double factor, Observer& trial_observer)
  {
    const std::string piece =
        fmt::format("trial_{}_{:a}_{:a}", file_name(name), body.particles.spacing, factor);
    if (const std::optional<std::string> kept = scene.work.kept(piece))
      return sph::from_bytes<sph::Trial>(*kept);
    sph::Trial done = sph::run_trial(model, body.settled.state,
                                     cones_in_region(scene.soils, factor, scene.input.sph.cone),
                                     factor, trial_observer);
    if (!done.interrupted)
      scene.work.keep(piece, sph::to_bytes(done));
    return done;
  };
  return sph::reduce_strength(trial, search, observer, scene.team);
}

double steps_of(const sph::FactorOfSafety& F)
{
  double steps = 0;
  for (const sph::Trial& t : F.trials)
    steps += static_cast<double>(t.steps);
  return steps;
}

std::optional<Bracket> closed_bracket(const sph::FactorOfSafety& F)
{
  if (!F.complete)
    return std::nullopt;
  return Bracket{F.stands.value(), F.fails.value()};
}

/// The critical circle to the side to which the slope fails; to the weaker one if that is not
/// known. Soil that the search held is held here too.
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

/// On ever finer particles, each search beginning where the one before ended.
void search_on_coarser(FoundFactor& found, const Scene& scene, std::vector<Body>& coarser,
                       sph::SearchSettings& search, Stability& stability, Observer& observer)
{
  for (auto body = coarser.rbegin(); body != coarser.rend(); ++body)
  {
    if (!holds_particles(found.region, body->particles))
      continue;
    body->reduce_in(found.region, scene.soils.size());
    const sph::FactorOfSafety F =
        factor_of_safety(*body, scene, search, found.region.name, observer);
    stability.particle_steps += body->particle_steps(steps_of(F));
    const std::optional<Bracket> bracket = closed_bracket(F);
    if (!bracket)
    {
      found.coarser.clear(); // each spacing is to be twice the one before
      continue;
    }
    found.coarser.insert(found.coarser.begin(), {body->particles.spacing, *bracket});
    search.guess = bracket->factor();
  }
}

/// The factor with psi = 0 and with psi = phi. Nothing if one of the two stays open.
std::optional<FlowRuleSpread> flow_rule_spread(const Body& body, const Scene& scene,
                                               const FoundFactor& found, Stability& stability,
                                               Observer& observer)
{
  const sph::FactorOfSafety& F = found.F;
  sph::SearchSettings search = scene.input.search;
  search.guess = F.factor();
  const auto with_dilation = [&](bool associated)
  {
    std::vector<sph::Soil> soils = scene.soils;
    bool changed = false;
    for (sph::Soil& soil : soils)
    {
      const double psi = associated ? soil.friction_angle : 0;
      changed = changed || soil.dilation_angle != psi;
      soil.dilation_angle = psi;
    }
    if (!changed)
      return closed_bracket(F);
    const Scene dilating{scene.input, scene.section, soils, scene.p_w, scene.team, scene.work};
    const sph::FactorOfSafety F_psi =
        factor_of_safety(body, dilating, search,
                         found.region.name + (associated ? " psi = phi" : " psi = 0"), observer);
    stability.particle_steps += body.particle_steps(steps_of(F_psi));
    return closed_bracket(F_psi);
  };
  const std::optional<Bracket> none = with_dilation(false), associated = with_dilation(true);
  if (!none || !associated)
    return std::nullopt;
  return FlowRuleSpread{*none, *associated};
}

/// One search: where the strength in a region is reduced, when does the slope fail, and how?
/// @param[in]     suffix    Of the stages' names.
/// @param[in,out] analysis  Gains the stages and their cost.
FoundFactor find_factor(const Scene& scene, const Region& region, Body& body,
                        std::vector<Body>& coarser, const std::string& suffix, Analysis& analysis,
                        Observer& observer)
{
  FoundFactor found;
  found.region = region;
  found.spacing = scene.input.sph.spacing;
  Stability& stability = *analysis.stability;
  sph::SearchSettings search = scene.input.search;

  // Step 1: on coarse particles, to know where to look.
  if (!coarser.empty())
    timed(analysis, observer, "coarse search" + suffix,
          [&] { search_on_coarser(found, scene, coarser, search, stability, observer); });

  // Step 2: the factor.
  body.reduce_in(region, scene.soils.size());
  found.F = timed(analysis, observer, "strength reduction" + suffix,
                  [&] { return factor_of_safety(body, scene, search, region.name, observer); });
  stability.particle_steps += body.particle_steps(steps_of(found.F));
  if (scene.input.flow_rule_spread && found.F.complete)
  {
    found.flow_rule =
        timed(analysis, observer, "flow rules" + suffix,
              [&] { return flow_rule_spread(body, scene, found, stability, observer); });
    if (!found.flow_rule && !observer.stop_requested())
      observer.warn("no spread over the flow rules: one of its searches found no factor");
  }

  // Step 3: the mechanism, and the circle beside it.
  if (const sph::Trial* failing = found.F.failing_trial())
    found.mechanism = sph::find_mechanism(body.particles, failing->state, scene.section);
  if (!observer.stop_requested())
    found.critical_circle =
        timed(analysis, observer, "limit equilibrium" + suffix,
              [&]
              {
                return find_critical_circle({scene.section, scene.soils, scene.p_w, &region},
                                            found.mechanism);
              });
  return found;
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

/// Goes on from the governing failing trial, in whose region the strength stays reduced, or starts
/// from the settled state with the strength reduced wherever the case allows it. Nothing if it was
/// to go on and no trial failed.
std::optional<RunOut> run_out(const Scene& scene, const Stability& stability, RunOutStore& frames,
                              Observer& observer)
{
  const Case& input = scene.input;
  const meshes::Section& section = scene.section;
  const sph::Trial* failing =
      stability.searches.empty() ? nullptr : stability.governing().F.failing_trial();
  if (!input.run_out->factor && !failing)
  {
    observer.warn("no run-out: no trial failed, and runout.factor is not given");
    return std::nullopt;
  }
  RunOut result;
  result.from_trial = !input.run_out->factor;
  result.factor = input.run_out->factor ? *input.run_out->factor : failing->factor;
  const bool wet = input.water.pore_pressure != PorePressureKind::none;
  sph::MovingBody body = sph::moving_body(stability.particles, with_held(scene.soils),
                                          wet ? stability.pore_pressure : std::vector<double>{},
                                          section, run_out_terms(input.sph));
  body.particles.soil = strength_index(result.from_trial ? stability.governing().region
                                                         : allowed_region(input.scope, section),
                                       stability.particles, scene.soils.size());
  if (wet)
    body.reread_pressure = input.water.pore_pressure == PorePressureKind::seepage
                               ? pore_pressure_in_space(scene.p_w, section)
                               : scene.p_w;
  const sph::Frame first =
      sph::first_frame(body, result.from_trial ? failing->state : stability.settled);
  for (const Soil& soil : input.soils)
    if (soil.mechanical.dilation_angle > 0)
      observer.warn("soil." + soil.name +
                    " dilates as long as it flows; dilation_angle_deg = 0 is usual for a run-out");
  frames.open(stability.particles, result.factor, input.run_out->motion);
  result.motion =
      sph::run_out(body, cones_in_region(scene.soils, result.factor, input.sph.cone), first,
                   section.y_max - section.y_min, input.run_out->motion, frames, observer);
  result.shape = sph::final_shape(stability.particles, result.motion.last.state, section);
  return result;
}
} // namespace

const FoundFactor& Stability::governing() const
{
  const auto least_possible = [](const FoundFactor& found)
  { return found.F.complete ? found.F.fails.value() : found.F.stands.value_or(0); };
  return *std::min_element(searches.begin(), searches.end(),
                           [&](const FoundFactor& a, const FoundFactor& b)
                           { return least_possible(a) < least_possible(b); });
}

std::optional<Bracket> FoundFactor::bracket() const
{
  if (!F.stands || !F.fails)
    return std::nullopt;
  return Bracket{*F.stands, *F.fails};
}

std::optional<DiscretisationError> FoundFactor::discretisation() const
{
  if (!F.complete)
    return std::nullopt;
  std::vector<SpacingFactor> finest_first = {{spacing, *bracket()}};
  finest_first.insert(finest_first.end(), coarser.begin(), coarser.end());
  return discretisation_error(finest_first);
}

std::optional<FactorRange> FoundFactor::range() const
{
  if (!F.complete)
    return std::nullopt;
  return factor_range(*bracket(), discretisation(), flow_rule);
}

Analysis analyse(const Case& input, Observer& observer)
{
  RunOutStore none;
  return analyse(input, observer, none);
}

Analysis analyse(const Case& input, Observer& observer, RunOutStore& frames)
{
  Team alone;
  WorkStore none;
  return analyse(input, observer, frames, none, alone);
}

Analysis analyse(const Case& given, Observer& observer, RunOutStore& frames, WorkStore& work,
                 Team& team)
{
  Case input = given;
  Analysis analysis;
  analysis.section = meshes::build_section(input.section);
  const meshes::Section& section = analysis.section;
  for (const std::string& text : section.warnings)
    observer.warn(text);

#ifdef BERM_WITH_SEEPAGE
  if (input.water.pore_pressure == PorePressureKind::seepage)
  {
    analysis.seepage = timed(analysis, observer, "seepage",
                             [&] { return solve_seepage(input, section, observer); });
    analysis.readings = read_solution(input, section, *analysis.seepage);
  }
#endif
  // A stop is asked of all ranks or of none: they wait for each other in what follows.
  analysis.interrupted = team.any(observer.stop_requested());
  if ((!input.stability && !input.run_out) || analysis.interrupted)
    return analysis;

  if (input.sph.spacing <= 0)
    input.sph.spacing = sph::default_spacing(section);
  const std::vector<sph::Soil> soils = mechanical(input.soils);
  Stability& stability = analysis.stability.emplace();

  stability.free_surface = hydrostatic_surface(input, section);
  const PorePressure p_w = make_pore_pressure(input, analysis, stability.free_surface);
  const Scene scene{input, section, soils, p_w, team, work};
  const std::vector<Region> wanted =
      input.stability ? regions(input.scope, section) : std::vector<Region>{};

  Body body =
      timed(analysis, observer, "particles", [&] { return make_body(scene, input.sph.spacing); });
  stability.particles = body.particles;
  stability.pore_pressure = body.pore_pressure;
  std::vector<Body> coarser;
  try
  {
    timed(analysis, observer, "settling", [&] { settle(body, scene, observer); });
    stability.settled = body.settled.state;
    stability.settlement = body.settled.settlement;
    stability.particle_steps = body.particle_steps(static_cast<double>(body.settled.steps));
    if (!body.moving) // without gradient correction every packing settles too far
      sph::require_sound_settlement(stability.settlement, body.discretisation, stability.particles);
    for (const Region& region : wanted)
      require_particles(region, stability.particles);
    if (!wanted.empty() && !body.moving)
      coarser = timed(analysis, observer, "coarse settling",
                      [&] { return coarser_bodies(scene, observer); });
  }
  catch (const NotConverged&)
  {
    if (!observer.stop_requested())
      throw;
  }
  analysis.interrupted = team.any(observer.stop_requested());
  if (analysis.interrupted)
  {
    analysis.stability.reset(); // soil that does not stand yet says nothing; the seepage stays
    return analysis;
  }
  for (const Body& c : coarser)
    stability.particle_steps += c.particle_steps(static_cast<double>(c.settled.steps));
  for (const Region& region : wanted)
    if (stability.searches.empty() || !team.any(observer.stop_requested()))
      stability.searches.push_back(find_factor(scene, region, body, coarser,
                                               wanted.size() > 1 ? ", " + region.name : "",
                                               analysis, observer));
  analysis.interrupted = team.any(observer.stop_requested());

  if (input.run_out && !analysis.interrupted && team.rank() == 0)
    analysis.run_out = timed(analysis, observer, "run-out",
                             [&] { return run_out(scene, stability, frames, observer); });
  if (analysis.run_out)
  {
    stability.particle_steps +=
        body.particle_steps(static_cast<double>(analysis.run_out->motion.steps));
    analysis.interrupted = analysis.run_out->motion.interrupted;
  }
  return analysis;
}
} // namespace berm::coupling
