// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_lines.h"

#include "meshes/drawing.h"
#include "meshes/planar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace berm::app
{
namespace
{
std::string key_of(std::size_t i, const char* key)
{
  return fmt::format("output.line[{}].{}", i + 1, key);
}

/// The middle of the first part of segment a-b that lies outside the section, if there is one.
std::optional<Vec2> first_outside(const meshes::Section& section, const Vec2& a, const Vec2& b)
{
  const Polyline& outline = section.outline;
  std::vector<double> at{0, 1};
  for (std::size_t k = 0; k < outline.size(); ++k)
  {
    const Vec2& c = outline[k];
    if (const auto point = meshes::crossing(a, b, c, outline[meshes::next(k, outline.size())]))
      at.push_back(meshes::nearest_parameter(*point, a, b));
    at.push_back(meshes::nearest_parameter(c, a, b)); // where the line touches a corner
  }
  std::ranges::sort(at);
  for (std::size_t k = 1; k < at.size(); ++k)
    if (const Vec2 middle = a + (at[k - 1] + at[k]) / 2 * (b - a);
        at[k] > at[k - 1] && !meshes::contains(section, middle))
      return middle;
  return std::nullopt;
}
} // namespace

std::vector<coupling::OutputLine> assemble_lines(const CheckedValues& values,
                                                 std::vector<Mistake>& mistakes)
{
  std::vector<coupling::OutputLine> lines;
  std::map<std::string, std::size_t> line_of_file;
  for (std::size_t i = 0; i < values.count("output.line"); ++i)
  {
    coupling::OutputLine& line = lines.emplace_back();
    line.name = values.get<std::string>(key_of(i, "name")).value_or(fmt::format("line_{}", i + 1));
    line.line.samples =
        static_cast<int>(values.get<std::int64_t>(key_of(i, "samples")).value_or(101));
    if (const auto points = values.get<Polyline>(key_of(i, "points_m")))
      if (meshes::check_points(key_of(i, "points_m"), *points, false, mistakes))
        line.line.points = *points;
    const auto [other, is_new] = line_of_file.try_emplace(file_name(line.name), i);
    if (!is_new)
      mistakes.push_back({.key = key_of(i, "name"),
                          .value = "\"" + line.name + "\"",
                          .problem = fmt::format("the same file, lines/{}.csv, as that of line {}",
                                                 other->first, other->second + 1),
                          .allowed = {},
                          .hint = "names have to differ in letters or digits"});
  }
  return lines;
}

void check_lines(const std::vector<coupling::OutputLine>& lines, const meshes::Section& section,
                 std::vector<Mistake>& mistakes)
{
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const Polyline& points = lines[i].line.points;
    const auto add = [&](const Vec2& value, const std::string& problem)
    {
      mistakes.push_back({.key = key_of(i, "points_m"),
                          .value = meshes::text(value),
                          .problem = problem,
                          .allowed = "points and lines inside the section or on its outline",
                          .hint = {}});
    };
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const bool inside = meshes::contains(section, points[k]);
      if (!inside)
        add(points[k], fmt::format("point {} lies outside the section", k + 1));
      else if (k > 0 && meshes::contains(section, points[k - 1]))
        if (const auto outside = first_outside(section, points[k - 1], points[k]))
          add(*outside,
              fmt::format("the line from point {} to point {} leaves the section here", k, k + 1));
    }
  }
}

std::string file_name(std::string_view line_name)
{
  constexpr std::size_t most = 64;
  std::string name(line_name.substr(0, most));
  for (char& c : name)
  {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-';
    if (!kept)
      c = '_';
  }
  return name.empty() ? "_" : name;
}
} // namespace berm::app
