// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/comparison_files.h"

#include "app/report.h"
#include "app/run_writer.h"

#include <fmt/format.h>

#include <iterator>

namespace berm::app
{
namespace
{
Json difference_json(const std::optional<coupling::PressureDifference>& d)
{
  if (!d)
    return nullptr;
  return {{"mean_kPa", d->mean / 1e3},
          {"rms_kPa", d->rms / 1e3},
          {"smallest_kPa", d->smallest / 1e3},
          {"largest_kPa", d->largest / 1e3}};
}

/// The governing search of a water; nothing if there was none.
const coupling::FoundFactor* governing(const coupling::ComparedWater& water)
{
  const auto& stability = water.analysis.stability;
  return stability && !stability->searches.empty() ? &stability->governing() : nullptr;
}

Json water_json(const coupling::ComparedWater& water)
{
  Json json = {{"name", water.name},
               {"title", water.title},
               {"pore_pressure", coupling::to_string(water.input.water.pore_pressure)},
               {"directory", water.name},
               {"factor", nullptr},
               {"low", nullptr},
               {"high", nullptr},
               {"complete", false}};
  if (const coupling::FoundFactor* found = governing(water))
  {
    if (const auto factor = found->F.factor())
      json["factor"] = *factor;
    if (const auto range = found->range())
    {
      json["low"] = range->low;
      json["high"] = range->high;
    }
    json["complete"] = found->F.complete;
  }
  json["seepage_minus_this"] = {{"soil", difference_json(water.over_soil)},
                                {"slip_line", difference_json(water.along_slip_line)}};
  return json;
}
} // namespace

Json comparison_json(const coupling::Comparison& comparison)
{
  Json json = {{"format", 1}, {"title", comparison.waters.front().input.title}};
  json["waters"] = Json::array();
  for (const coupling::ComparedWater& water : comparison.waters)
    json["waters"].push_back(water_json(water));
  json["phreatic_line_above_assumed_line"] = nullptr;
  if (comparison.line)
    json["phreatic_line_above_assumed_line"] = {{"mean_m", comparison.line->mean},
                                                {"largest_m", comparison.line->largest},
                                                {"at_x_m", comparison.line->at_x}};
  return json;
}

void write_comparison(const std::filesystem::path& directory,
                      const coupling::Comparison& comparison)
{
  const Json json = comparison_json(comparison);
  require_finite(json);
  write_aside(directory / "comparison.json", json_text(json) + "\n");
}

std::string comparison_report(const coupling::Comparison& comparison)
{
  std::string text =
      fmt::format("\nThe same soil, other waters: {}\n\n  {:<36} {:<34} {:>9} {:>9}\n",
                  comparison.waters.front().input.title, "", "", "soil", "slip line");
  const auto mean = [](const std::optional<coupling::PressureDifference>& d)
  { return d ? fmt::format("{:+.2f}", d->mean / 1e3) : std::string(); };
  for (const coupling::ComparedWater& water : comparison.waters)
  {
    const coupling::FoundFactor* found = governing(water);
    std::string line = fmt::format("  {:<36} {:<34} {:>9} {:>9}", water.title,
                                   found ? factor_text(found->F) : "no factor asked for",
                                   mean(water.over_soil), mean(water.along_slip_line));
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  text += "\n  Right: mean of the seepage pressure minus this pressure [kPa], over the soil and "
          "along the slip line under seepage.\n";
  if (comparison.line)
    fmt::format_to(std::back_inserter(text),
                   "  The phreatic line lies above the assumed line by {:.2f} m in the mean, at "
                   "most by {:.2f} m, at x = {:.2f} m.\n",
                   comparison.line->mean, comparison.line->largest, comparison.line->at_x);
  return text;
}
} // namespace berm::app
