// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/readings_json.h"

#include "app/json_points.h"
#include "app/reading_files.h"

namespace berm::app
{
namespace
{
Json line_json(const coupling::OutputLine& line, const seepage::LineReading& reading)
{
  const seepage::WaterForce& water = reading.water;
  const bool pushed = water.pressure > 0;
  return {{"name", line.name},
          {"file", line_path(line).generic_string()},
          {"length_m", reading.length},
          {"points_m", points(line.line.points)},
          {"discharge_m2_s", reading.discharge},
          {"discharge_from", reading.by_stream_function ? "stream function" : "flux"},
          {"water_force",
           {{"force_kN_m", point(water.force / 1e3)},
            {"pressure_kN_m", water.pressure / 1e3},
            {"moment_kNm_m", water.moment / 1e3},
            {"distance_m", pushed ? Json(water.distance) : Json(nullptr)},
            {"at_m", pushed ? point(water.at) : Json(nullptr)}}}};
}

Json outlet_json(const seepage::Outlet& outlet, const coupling::Analysis& analysis)
{
  Json json = {
      {"stretch", analysis.section.stretches.at(static_cast<std::size_t>(outlet.stretch)).name},
      {"from_m", point(outlet.points.front().at)},
      {"to_m", point(outlet.points.back().at)},
      {"outflow_m2_s", outlet.outflow},
      {"gradient", nullptr},
      {"at_m", nullptr},
      {"upward_gradient", nullptr},
      {"critical_gradient", nullptr},
      {"unbounded_at_m", points(outlet.unbounded)},
      {"kept_away_m", outlet.kept_away}};
  if (outlet.steepest)
  {
    const seepage::ExitPoint& p = outlet.points[*outlet.steepest];
    json["gradient"] = p.normal;
    json["at_m"] = point(p.at);
    json["upward_gradient"] = p.upward;
    json["critical_gradient"] =
        analysis.readings.critical_gradient.at(static_cast<std::size_t>(p.soil));
  }
  return json;
}

Json heave_json(const seepage::Heave& heave)
{
  Json json = {{"factor", heave.factor() ? Json(*heave.factor()) : Json(nullptr)},
               {"surface", nullptr},
               {"column", nullptr}};
  if (const auto& surface = heave.surface)
    json["surface"] = {{"factor", surface->factor},
                       {"at_m", point(surface->at)},
                       {"gradient", surface->gradient},
                       {"critical_gradient", surface->critical_gradient}};
  if (const auto& column = heave.column)
    json["column"] = {{"factor", column->factor},
                      {"at_m", point(column->at)},
                      {"depth_m", column->depth},
                      {"excess_head_m", column->excess_head}};
  return json;
}
} // namespace

Json readings_json(const coupling::Case& input, const coupling::Analysis& analysis)
{
  const coupling::Readings& readings = analysis.readings;
  Json lines = Json::array(), outlets = Json::array();
  for (std::size_t i = 0; i < readings.lines.size(); ++i)
    lines.push_back(line_json(input.output.lines.at(i), readings.lines[i]));
  for (const seepage::Outlet& outlet : readings.outlets)
    outlets.push_back(outlet_json(outlet, analysis));
  return {{"lines", lines}, {"exit_gradients", outlets}, {"heave", heave_json(readings.heave)}};
}
} // namespace berm::app
