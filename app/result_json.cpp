// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/result_json.h"

#include "app/inputs_json.h"
#include "app/json_points.h"
#include "app/readings_json.h"
#include "app/version.h"
#include "core/error.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace berm::app
{
namespace
{
Json polygons(const std::vector<Polyline>& list)
{
  Json json = Json::array();
  for (const Polyline& polygon : list)
    json.push_back(points(polygon));
  return json;
}

template <typename T>
Json or_null(const std::optional<T>& value)
{
  return value ? Json(*value) : Json(nullptr);
}

Json seconds(const Seconds& s)
{
  return {{"wall", s.wall}, {"cpu", s.cpu}};
}

Json section_json(const coupling::Case& input, const meshes::Section& s)
{
  Json inner = Json::array();
  for (const meshes::InnerLine& line : s.inner_lines)
  {
    const meshes::Stretch& stretch = s.stretches[static_cast<std::size_t>(line.stretch)];
    inner.push_back(
        {{"name", stretch.name},
         {"kind",
          kind_name(
              input.marked_boundaries.at(static_cast<std::size_t>(stretch.marked_line)).kind)},
         {"line_m", points(line.points)}});
  }
  return {{"x_min_m", s.x_min},
          {"x_max_m", s.x_max},
          {"y_min_m", s.y_min},
          {"y_max_m", s.y_max},
          {"area_m2", std::abs(meshes::polygon_area(s.outline))},
          {"outline_m", points(s.outline)},
          {"ground_m", points(s.ground)},
          {"left_level_m", or_null(s.left_pool_level)},
          {"right_level_m", or_null(s.right_pool_level)},
          {"overflow_crest_m", s.overflow ? point(s.overflow->crest) : Json(nullptr)},
          {"inner_lines", inner}};
}

/// What the numbers of the seepage are thought to be off by.
Json error_json(const seepage::ErrorEstimate& error)
{
  return {{"discharge_m2_s", or_null(error.discharge)},
          {"phreatic_line_m", or_null(error.phreatic_line)},
          {"exit_point_m", or_null(error.exit_point)},
          {"head_m", error.head.empty() ? Json(nullptr) : Json(std::ranges::max(error.head))},
          {"within_tolerance", error.within_tolerance}};
}

Json seepage_json(const coupling::Case& input, const coupling::Analysis& analysis)
{
  const seepage::Solution& s = *analysis.seepage;
  Json lines = Json::array(), probe_list = Json::array(), stretches = Json::array(),
       meshes = Json::array();
  for (const Polyline& line : s.phreatic_lines)
    lines.push_back(points(line));
  for (const Probe& p : probes(input, analysis))
    probe_list.push_back({{"x_m", p.at.x()},
                          {"y_m", p.at.y()},
                          {"head_m", p.head},
                          {"pore_pressure_kPa", p.pore_pressure / 1e3}});
  for (std::size_t i = 0; i < std::min(s.stretch_inflow.size(), analysis.section.stretches.size());
       ++i)
    stretches.push_back({{"name", analysis.section.stretches[i].name},
                         {"inflow_m2_s", s.stretch_inflow[i]},
                         {"runoff_m2_s", s.stretch_runoff[i]}});
  for (const seepage::SolveHistory& h : s.history)
    meshes.push_back({{"unknowns", h.unknowns},
                      {"strategy", h.strategy},
                      {"newton_steps", h.newton_steps},
                      {"active_set_changes", h.active_set_changes},
                      {"residual", h.residual},
                      {"discharge_m2_s", h.discharge},
                      {"seconds", {{"solve", h.seconds}, {"mesh", h.mesh_seconds}}}});
  Json json = {
      {"discharge_m2_s", s.discharge},
      {"discharge_over_k_m", or_null(discharge_over_k(input, analysis))},
      {"exit_point_m", s.exit_point ? point(*s.exit_point) : Json(nullptr)},
      {"phreatic_line_m", lines.empty() ? Json::array() : lines.front()},
      {"phreatic_lines_m", lines},
      {"inflow_m2_s", s.inflow},
      {"outflow_m2_s", s.outflow},
      {"balance", s.balance},
      {"rain_m2_s", s.rain},
      {"runoff_m2_s", std::accumulate(s.stretch_runoff.begin(), s.stretch_runoff.end(), 0.0)},
      {"estimated_error", error_json(s.error)},
      {"stretches", stretches},
      {"probes", probe_list},
      {"meshes", meshes},
      {"seconds", seconds(s.seconds)}};
  json.update(readings_json(input, analysis));
  return json;
}

Json fitted_json(const std::optional<sph::FittedCircle>& circle)
{
  if (!circle)
    return nullptr;
  return {{"centre_m", point(circle->centre)},
          {"radius_m", circle->radius},
          {"misfit_m", circle->misfit}};
}

Json mechanism_json(const std::optional<sph::Mechanism>& mechanism)
{
  if (!mechanism)
    return nullptr;
  return {{"kind", mechanism->kind},
          {"side", mechanism->side},
          {"entry_m", point(mechanism->entry)},
          {"exit_m", point(mechanism->exit)},
          {"depth_m", mechanism->depth},
          {"thickness_m", mechanism->thickness},
          {"length_m", mechanism->length},
          {"volume_m2", mechanism->volume},
          {"circle", fitted_json(mechanism->circle)},
          {"slip_line_m", points(mechanism->slip_line)}};
}

Json circle_json(const std::optional<coupling::SlipCircle>& circle)
{
  if (!circle)
    return nullptr;
  return {{"bishop", circle->bishop},
          {"spencer", or_null(circle->spencer)},
          {"centre_m", point(circle->centre)},
          {"radius_m", circle->radius},
          {"x_left_m", circle->x_left},
          {"x_right_m", circle->x_right},
          {"side", circle->moves_right ? "right" : "left"}};
}

Json history_json(const std::vector<sph::TrialWindow>& history)
{
  Json time = Json::array(), velocity = Json::array(), displacement = Json::array();
  for (const sph::TrialWindow& window : history)
  {
    time.push_back(window.time);
    velocity.push_back(window.velocity_measure);
    displacement.push_back(window.max_displacement);
  }
  return {{"time_s", time}, {"velocity_measure", velocity}, {"max_displacement_m", displacement}};
}

Json bracket_json(const coupling::Bracket& bracket)
{
  return {{"factor", bracket.factor()}, {"stands", bracket.stands}, {"fails", bracket.fails}};
}

Json spacings_json(const coupling::FoundFactor& found)
{
  Json list = Json::array();
  const auto add = [&](double spacing, const coupling::Bracket& bracket)
  {
    list.push_back(bracket_json(bracket));
    list.back()["spacing_m"] = spacing;
  };
  add(found.spacing, *found.bracket());
  for (const coupling::SpacingFactor& level : found.coarser)
    add(level.spacing, level.F);
  return list;
}

/// Null where the search found no factor.
Json uncertainty_json(const coupling::FoundFactor& found)
{
  const auto range = found.range();
  if (!range)
    return nullptr;
  Json json = {{"low", range->low},
               {"high", range->high},
               {"bracket", found.bracket()->half_width()},
               {"discretisation", nullptr},
               {"flow_rule", nullptr}};
  if (const auto error = found.discretisation())
    json["discretisation"] = {{"error", error->error},
                              {"order", or_null(error->order)},
                              {"extrapolated", or_null(error->extrapolated)},
                              {"spacings", spacings_json(found)}};
  if (found.flow_rule)
    json["flow_rule"] = {{"no_dilation", bracket_json(found.flow_rule->no_dilation)},
                         {"associated", bracket_json(found.flow_rule->associated)}};
  return json;
}

Json trials_json(const std::vector<sph::Trial>& trials)
{
  Json list = Json::array();
  for (const sph::Trial& t : trials)
    list.push_back({{"factor", t.factor},
                    {"outcome", sph::to_string(t.outcome)},
                    {"reason", t.reason},
                    {"interrupted", t.interrupted},
                    {"time_s", t.time},
                    {"steps", t.steps},
                    {"velocity_measure", t.velocity_measure},
                    {"max_displacement_m", t.max_displacement},
                    {"history", history_json(t.history)},
                    {"seconds", seconds(t.seconds)}});
  return list;
}

Json found_json(const coupling::FoundFactor& found)
{
  const sph::FactorOfSafety& F = found.F;
  return {{"region", found.region.name},
          {"min_depth_m", found.region.min_depth},
          {"factor", or_null(F.factor())},
          {"stands", or_null(F.stands)},
          {"fails", or_null(F.fails)},
          {"complete", F.complete},
          {"reason", F.reason},
          {"side", found.mechanism ? Json(found.mechanism->side) : Json(nullptr)},
          {"mechanism", mechanism_json(found.mechanism)},
          {"limit_equilibrium", circle_json(found.critical_circle)},
          {"uncertainty", uncertainty_json(found)},
          {"trials", trials_json(F.trials)}};
}

Json stability_json(const coupling::Case& input, const coupling::Analysis& analysis)
{
  const coupling::Stability& s = *analysis.stability;
  double wall = 0, cpu = 0;
  for (const coupling::StageSeconds& stage : analysis.stages)
    if (stage.stage != "seepage")
    {
      wall += stage.seconds.wall;
      cpu += stage.seconds.cpu;
    }
  Json json = found_json(s.searches.empty() ? coupling::FoundFactor{} : s.governing());
  json.update({{"pore_pressure", coupling::to_string(input.water.pore_pressure)},
               {"free_surface_m", points(s.free_surface)},
               {"cone", input.sph.cone},
               {"formulation", input.sph.formulation},
               {"packing", s.particles.packing},
               {"spacing_m", s.particles.spacing},
               {"particles", s.particles.size()},
               {"settlement_m", s.settlement},
               {"search_region_m", polygons(input.scope.inside)},
               {"exclude_region_m", polygons(input.scope.outside)},
               {"seconds", seconds({wall, cpu})}});
  if (s.searches.size() > 1)
  {
    json["searches"] = Json::array();
    for (const coupling::FoundFactor& found : s.searches)
      json["searches"].push_back(found_json(found));
  }
  return json;
}

Json energies_json(const std::vector<sph::Moment>& history)
{
  Json list = Json::array();
  for (const sph::Moment& m : history)
  {
    const sph::Energies& e = m.energies;
    list.push_back({{"time_s", m.time},
                    {"max_displacement_m", m.max_displacement},
                    {"kinetic_J_m", e.kinetic},
                    {"potential_J_m", e.potential},
                    {"elastic_J_m", e.elastic},
                    {"water_work_J_m", e.water},
                    {"shake_work_J_m", e.shake},
                    {"plastic_J_m", e.plastic},
                    {"viscous_J_m", e.viscous},
                    {"damping_J_m", e.damping},
                    {"error_J_m", e.total() - history.front().energies.total()}});
  }
  return list;
}

Json run_out_json(const coupling::RunOut& run_out, const meshes::Section& section, double spacing)
{
  const sph::RunOut& motion = run_out.motion;
  const sph::FinalShape& shape = run_out.shape;
  const auto or_null_point = [](const std::optional<Vec2>& p)
  { return p ? point(*p) : Json(nullptr); };
  return {{"factor", run_out.factor},
          {"from", run_out.from_trial ? "failing trial" : "settled state"},
          {"at_rest", motion.at_rest},
          {"time_to_rest_s", motion.at_rest ? Json(motion.time_to_rest) : Json(nullptr)},
          {"time_s", motion.time},
          {"steps", motion.steps},
          {"side", shape.side.empty() ? Json(nullptr) : Json(shape.side)},
          {"run_out_m", or_null(shape.run_out)},
          {"toe_m", or_null_point(shape.toe)},
          {"tip_m", or_null_point(shape.tip)},
          {"crest_settlement_m", shape.crest_settlement},
          {"freeboard_m", or_null(freeboard(run_out, section))},
          {"moved_volume_m2", shape.moved_volume},
          {"max_displacement_m", shape.max_displacement},
          {"closest_pair_over_spacing", motion.closest_pair / spacing},
          {"surface_m", points(shape.surface)},
          {"frames", motion.history.size()},
          {"history", energies_json(motion.history)},
          {"seconds", seconds(motion.seconds)}};
}

Json performance_json(const coupling::Analysis& analysis)
{
  Json stages = Json::array();
  for (const coupling::StageSeconds& stage : analysis.stages)
    stages.push_back(
        {{"stage", stage.stage}, {"wall_s", stage.seconds.wall}, {"cpu_s", stage.seconds.cpu}});
  Json json = {{"threads", omp_get_max_threads()}, {"stages", stages}};
  if (analysis.stability)
  {
    json["particle_steps"] = analysis.stability->particle_steps;
    json["particle_steps_per_cpu_second"] = or_null(particle_steps_per_cpu_second(analysis));
  }
  return json;
}
} // namespace

std::vector<Probe> probes(const coupling::Case& input, const coupling::Analysis& analysis)
{
  std::vector<Probe> list;
  if (!analysis.seepage)
    return list;
  const seepage::Solution& solution = *analysis.seepage;
  // Probes lie inside the section, checked on reading; the mesh may differ from it by rounding.
  const double shift = 1e-6 * (analysis.section.x_max - analysis.section.x_min);
  for (const Vec2& at : input.output.probes)
  {
    const auto head = seepage::value_at(solution, solution.head, at, shift);
    const auto p_w = seepage::value_at(solution, solution.pore_pressure, at, shift);
    if (!head || !p_w)
      throw NumericalError(
          fmt::format("probe ({}, {}) lies outside the seepage mesh", at.x(), at.y()));
    list.push_back({at, *head, *p_w});
  }
  return list;
}

std::optional<double> discharge_over_k(const coupling::Case& input,
                                       const coupling::Analysis& analysis)
{
  if (!analysis.seepage || input.soils.empty() || !input.soils.front().conductivity)
    return std::nullopt;
  const double k = input.soils.front().conductivity->kx;
  const bool one =
      std::all_of(input.soils.begin(), input.soils.end(),
                  [k](const coupling::Soil& s)
                  { return s.conductivity && s.conductivity->kx == k && s.conductivity->ky == k; });
  return one ? std::optional(analysis.seepage->discharge / k) : std::nullopt;
}

std::optional<double> particle_steps_per_cpu_second(const coupling::Analysis& analysis)
{
  double cpu = 0;
  for (const coupling::StageSeconds& stage : analysis.stages)
    if (stage.stage == "settling" || stage.stage.starts_with("coarse") ||
        stage.stage.starts_with("flow rules") || stage.stage.starts_with("strength reduction") ||
        stage.stage == "run-out")
      cpu += stage.seconds.cpu;
  if (!analysis.stability || analysis.stability->particle_steps <= 0 || cpu <= 0)
    return std::nullopt;
  return analysis.stability->particle_steps / cpu;
}

std::optional<double> freeboard(const coupling::RunOut& run_out, const meshes::Section& section)
{
  if (!section.left_pool_level && !section.right_pool_level)
    return std::nullopt;
  constexpr double none = -std::numeric_limits<double>::infinity();
  double highest = none;
  for (const Vec2& p : run_out.shape.surface)
    highest = std::max(highest, p.y());
  return highest -
         std::max(section.left_pool_level.value_or(none), section.right_pool_level.value_or(none));
}

bool complete(const coupling::Case& input, const coupling::Analysis& analysis)
{
  const bool factor_found =
      !input.stability ||
      (analysis.stability && !analysis.stability->searches.empty() &&
       std::all_of(analysis.stability->searches.begin(), analysis.stability->searches.end(),
                   [](const coupling::FoundFactor& found) { return found.F.complete; }));
  const bool at_rest = !input.run_out || (analysis.run_out && analysis.run_out->motion.at_rest);
  return factor_found && at_rest && !analysis.interrupted;
}

Json result_json(const coupling::Case& input, const coupling::Analysis& analysis,
                 std::span<const std::string> warnings)
{
  Json json = {{"berm", version()},
               {"format", 1},
               {"title", input.title},
               {"case", {{"path", input.path}, {"overrides", input.overrides}}},
               {"complete", complete(input, analysis)},
               {"interrupted", analysis.interrupted},
               {"warnings", std::vector<std::string>(warnings.begin(), warnings.end())},
               {"inputs", inputs_json(input, analysis.section)},
               {"section", section_json(input, analysis.section)}};
  if (analysis.seepage)
    json["seepage"] = seepage_json(input, analysis);
  if (analysis.stability)
    json["stability"] = stability_json(input, analysis);
  if (analysis.run_out)
    json["runout"] =
        run_out_json(*analysis.run_out, analysis.section, analysis.stability->particles.spacing);
  json["performance"] = performance_json(analysis);
  require_finite(json);
  return json;
}

std::string json_text(const Json& json, std::size_t indent)
{
  const std::string inner(indent + 2, ' ');
  const bool nested =
      std::any_of(json.begin(), json.end(),
                  [](const Json& element)
                  { return element.is_object() || (element.is_array() && element.size() > 2); });
  if (!json.is_structured() || json.empty() || (json.is_array() && !nested))
    // Points and lists of them stay on one line. A path need not be UTF-8.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  for (const auto& [key, value] : json.items())
    text +=
        fmt::format("{}{}{}{}", text.empty() ? "" : ",\n", inner,
                    json.is_object() ? Json(key).dump() + ": " : "", json_text(value, indent + 2));
  const char* brackets = json.is_object() ? "{}" : "[]";
  return fmt::format("{}\n{}\n{}{}", brackets[0], text, std::string(indent, ' '), brackets[1]);
}

void require_finite(const Json& json)
{
  const auto flat = json.flatten(); // "/stability/trials/0/factor"
  for (const auto& [path, value] : flat.items())
    if (value.is_number_float() && !std::isfinite(value.get<double>()))
      throw NumericalError(
          fmt::format("{} = {}: results are not written", path, value.get<double>()));
}
} // namespace berm::app
