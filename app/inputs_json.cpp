// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/inputs_json.h"

#include "app/json_points.h"

#include <cmath>
#include <numbers>

namespace berm::app
{
namespace
{
/// Null where the case leaves it open.
Json in_unit(double value, double unit)
{
  return std::isfinite(value) ? Json(value / unit) : Json(nullptr);
}

const char* retention_name(seepage::RetentionModel model)
{
  switch (model)
  {
  case seepage::RetentionModel::sharp:
    return "sharp";
  case seepage::RetentionModel::gardner:
    return "gardner";
  case seepage::RetentionModel::van_genuchten:
    break;
  }
  return "van_genuchten";
}

Json soil_json(const coupling::Soil& soil)
{
  constexpr double kilo = 1e3, degree = std::numbers::pi / 180;
  const sph::Soil& m = soil.mechanical;
  Json json = {{"name", soil.name},
               {"unit_weight_kN_m3", in_unit(m.density, kilo / gravity)},
               {"saturated_unit_weight_kN_m3", in_unit(m.saturated_density, kilo / gravity)},
               {"cohesion_kPa", in_unit(m.cohesion, kilo)},
               {"friction_angle_deg", in_unit(m.friction_angle, degree)},
               {"dilation_angle_deg", in_unit(m.dilation_angle, degree)},
               {"young_modulus_kPa", in_unit(m.young_modulus, kilo)},
               {"poisson_ratio", in_unit(m.poisson_ratio, 1)},
               {"tensile_strength_kPa", in_unit(m.tensile_strength, kilo)},
               {"conductivity_m_s", nullptr},
               {"conductivity_angle_deg", nullptr},
               {"retention", nullptr}};
  if (const auto& k = soil.conductivity)
  {
    json["conductivity_m_s"] = {k->kx, k->ky};
    json["conductivity_angle_deg"] = k->angle / degree;
    json["retention"] = retention_name(k->retention.model);
  }
  return json;
}
} // namespace

const char* kind_name(seepage::BoundaryKind kind)
{
  switch (kind)
  {
  case seepage::BoundaryKind::impervious:
    return "impervious";
  case seepage::BoundaryKind::head:
    return "head";
  case seepage::BoundaryKind::seepage_face:
    return "seepage_face";
  case seepage::BoundaryKind::inflow:
    return "inflow";
  case seepage::BoundaryKind::rain:
    return "rain";
  case seepage::BoundaryKind::overflow:
    break;
  }
  return "overflow";
}

Json inputs_json(const coupling::Case& input, const meshes::Section& section)
{
  Json json = {{"pore_pressure", coupling::to_string(input.water.pore_pressure)},
               {"rain_m_s", input.rain},
               {"soils", Json::array()},
               {"zones", Json::array()},
               {"boundaries", Json::array()}};
  for (const coupling::Soil& soil : input.soils)
    json["soils"].push_back(soil_json(soil));
  for (const meshes::Zone& zone : section.zones)
    json["zones"].push_back({{"soil", input.soils.at(static_cast<std::size_t>(zone.soil)).name},
                             {"polygon_m", points(zone.polygon)}});
  for (std::size_t i = 0; i < input.marked_boundaries.size(); ++i)
    json["boundaries"].push_back({{"kind", kind_name(input.marked_boundaries[i].kind)},
                                  {"value", input.marked_boundaries[i].value},
                                  {"line_m", points(input.section.marked_lines.at(i))}});
  return json;
}
} // namespace berm::app
