// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_doubts.h"

#include "app/toml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace berm::app
{
namespace
{
using coupling::PorePressureKind;

/// Whether the case names a key, be it by --set.
bool names(const TomlValue& document, const char* key)
{
  return find_value(document, key) != nullptr;
}

TomlValue document_of(const coupling::Case& input)
{
  KeyPlaces unused;
  TomlValue document = parse_toml(input.text, input.path, unused);
  static_cast<void>(apply_overrides(document, input.overrides, unused)); // no mistake: it was read
  return document;
}

void add_soil_doubts(const coupling::Case& input, std::vector<std::string>& list)
{
  constexpr double degrees = 180 / pi;
  for (const coupling::Soil& soil : input.soils)
  {
    const sph::Soil& m = soil.mechanical;
    const double reduced = std::atan(std::tan(m.friction_angle) / input.search.upper);
    if (m.cohesion == 0 && m.friction_angle == 0)
      list.push_back(fmt::format("soil.{}: cohesion_kPa and friction_angle_deg are 0: it has no "
                                 "strength, and can stand nowhere but level",
                                 soil.name));
    else if (m.dilation_angle > reduced)
      list.push_back(fmt::format(
          "soil.{}: dilation_angle_deg = {:.4g} is more than the friction angle reduced by F = "
          "{:.3g}, {:.3g} deg; where it is, the dilation is reduced to the friction",
          soil.name, m.dilation_angle * degrees, input.search.upper, reduced * degrees));
  }
}

void add_water_doubts(const coupling::Case& input, std::vector<std::string>& list)
{
  const TomlValue document = document_of(input);
  const PorePressureKind kind = input.water.pore_pressure;
  if (kind == PorePressureKind::none)
    for (const char* key : {"water.left_level_m", "water.right_level_m", "water.free_surface_m"})
      if (names(document, key))
        list.push_back(
            fmt::format("{} is left out of account: water.pore_pressure is \"none\"", key));
  if (kind != PorePressureKind::seepage)
    for (const char* key : {"seepage.boundary", "seepage.rain_m_s"})
      if (names(document, key))
        list.push_back(
            fmt::format("{} has no effect: water.pore_pressure is not \"seepage\"", key));
  const auto same = [&](const coupling::Soil& soil)
  {
    const auto &a = soil.conductivity, &b = input.soils.front().conductivity;
    return a && b && a->kx == b->kx && a->ky == b->ky && a->angle == b->angle &&
           a->retention.model == b->retention.model;
  };
  if (kind == PorePressureKind::seepage && input.soils.size() > 1 &&
      std::ranges::all_of(input.soils, same))
    list.push_back("conductivity_m_s is the same in all soils: the water does not see the zones");
}
} // namespace

std::vector<std::string> doubts(const coupling::Case& input)
{
  constexpr double least =
      10; // particles over the height: fewer than that are off by some per cent
  std::vector<std::string> list;
  const meshes::Section section = meshes::build_section(input.section);
  const double height = section.y_max - section.y_min;
  if (input.sph.spacing > 0 && input.stability && height / input.sph.spacing < least)
    list.push_back(fmt::format(
        "sph.spacing_m = {:.4g} leaves {:.0f} particles over the height of {:.4g} m, fewer than "
        "{:.0f}: the factor is a rough one",
        input.sph.spacing, std::floor(height / input.sph.spacing), height, least));
  add_soil_doubts(input, list);
  add_water_doubts(input, list);
  return list;
}

std::string doubt_of(const coupling::Analysis& analysis)
{
  if (!analysis.stability || analysis.stability->searches.empty())
    return {};
  const std::optional<double> fails = analysis.stability->governing().F.fails;
  return fails && *fails <= 1 ? "the factor of safety is below 1: the slope does not stand as it is"
                              : "";
}
} // namespace berm::app
