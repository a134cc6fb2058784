// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/readings_report.h"

#include <fmt/format.h>

namespace berm::app
{
std::string point_text(const Vec2& p)
{
  return fmt::format("({:.2f}, {:.2f})", p.x(), p.y());
}

namespace
{
/// The flow through a line and the push of the water on its right side.
void add_line(std::vector<ReportRow>& rows, const coupling::OutputLine& line,
              const seepage::LineReading& reading)
{
  rows.push_back({"line", fmt::format("{}, {:.4g} m: {:.4g} m2/s to its left", line.name,
                                      reading.length, reading.discharge)});
  const seepage::WaterForce& water = reading.water;
  if (water.pressure > 0)
    rows.push_back({"", fmt::format("water pushes with {:.1f} kN/m = ({:.1f}, {:.1f}), centre {} "
                                    "after {:.2f} m",
                                    water.force.norm() / 1e3, water.force.x() / 1e3,
                                    water.force.y() / 1e3, point_text(water.at), water.distance)});
  else
    rows.push_back({"", "no water pressure on it"});
}

void add_outlet(std::vector<ReportRow>& rows, const seepage::Outlet& outlet,
                const std::string& stretch)
{
  std::string text = stretch + ": all of it beside where it has no bound";
  if (outlet.steepest)
  {
    const seepage::ExitPoint& p = outlet.points[*outlet.steepest];
    text = fmt::format("{}: {:.3f} at {}", stretch, p.normal, point_text(p.at));
  }
  rows.push_back({"exit gradient", text});
  std::string places;
  for (const Vec2& place : outlet.unbounded)
    places += (places.empty() ? "" : ", ") + point_text(place);
  if (!places.empty())
    rows.push_back({"", fmt::format("without bound at {}; what is nearer than {:.2g} m does not "
                                    "count",
                                    places, outlet.kept_away)});
}

void add_heave(std::vector<ReportRow>& rows, const seepage::Heave& heave)
{
  if (!heave.factor())
  {
    rows.push_back({"heave", "none: no upward flow"});
    return;
  }
  if (const auto& surface = heave.surface)
    rows.push_back(
        {"heave",
         fmt::format("factor {:.3f} at the surface {}: gradient {:.3f} of {:.3f}", surface->factor,
                     point_text(surface->at), surface->gradient, surface->critical_gradient)});
  if (const auto& column = heave.column)
    rows.push_back(
        {heave.surface ? "" : "heave",
         fmt::format("factor {:.3f} of the column {:.2f} m deep below {}: {:.3f} m of "
                     "excess head",
                     column->factor, column->depth, point_text(column->at), column->excess_head)});
}
} // namespace

std::vector<ReportRow> reading_rows(const coupling::Case& input, const coupling::Analysis& analysis)
{
  std::vector<ReportRow> rows;
  const coupling::Readings& readings = analysis.readings;
  for (std::size_t i = 0; i < readings.lines.size(); ++i)
    add_line(rows, input.output.lines.at(i), readings.lines[i]);
  for (const seepage::Outlet& outlet : readings.outlets)
    add_outlet(rows, outlet,
               analysis.section.stretches.at(static_cast<std::size_t>(outlet.stretch)).name);
  add_heave(rows, readings.heave);
  return rows;
}
} // namespace berm::app
