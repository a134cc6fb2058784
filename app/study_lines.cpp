// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study_lines.h"

#include "app/packed_array.h"
#include "app/text_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

using Point = std::array<double, 2>;
using Line = std::vector<Point>;

/// What is drawn of a member.
struct Drawn
{
  Json section;
  std::vector<Line> lines;
};

/// At least two points. @throws Json::exception if it is something else.
Line line_in(const Json& json)
{
  Line line;
  for (const Json& point : json)
    line.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
  (void)json.at(1);
  return line;
}

Json number_or_null(const Json& json)
{
  return json.is_null() ? json : Json(json.get<double>());
}

/// The section's part that a view draws, each value of its type. @throws Json::exception.
Json section_in(const Json& json)
{
  Json section = Json::object();
  for (const char* key : {"x_min_m", "x_max_m", "y_min_m", "y_max_m"})
    section[key] = json.at(key).get<double>();
  for (const char* key : {"left_level_m", "right_level_m"})
    section[key] = number_or_null(json.at(key));
  for (const char* key : {"outline_m", "ground_m"})
    section[key] = line_in(json.at(key));
  const Json& crest = json.at("overflow_crest_m");
  section["overflow_crest_m"] = crest.is_null() ? crest : Json(crest.get<Point>());
  section["inner_lines"] = Json::array();
  for (const Json& line : json.at("inner_lines"))
    section["inner_lines"].push_back(
        {{"kind", line.at("kind").get<std::string>()}, {"line_m", line_in(line.at("line_m"))}});
  return section;
}

/// What a member's folder holds to be drawn; nothing if it holds no result as berm writes it.
std::optional<Drawn> drawn_in(const fs::path& folder)
try
{
  const std::optional<std::string> text = text_of(folder / "result.json");
  if (!text)
    return std::nullopt;
  const Json result = Json::parse(*text);
  Drawn drawn{.section = section_in(result.at("section")), .lines = {}};
  for (const Json& line : result.at("seepage").at("phreatic_lines_m"))
    drawn.lines.push_back(line_in(line));
  return drawn.lines.empty() ? std::nullopt : std::optional(std::move(drawn));
}
catch (const Json::exception&)
{
  return std::nullopt;
}

/// The folder inside the study, whatever its path says.
std::optional<fs::path> folder_of(const fs::path& directory, const Json& member)
{
  if (!member.is_object() || !member.value("discharge_m2_s", Json()).is_number() ||
      !member.value("directory", Json()).is_string())
    return std::nullopt;
  return directory / "members" / name_inside(member.at("directory").get<std::string>());
}

Json packed_line(const Line& line)
{
  std::vector<double> flat;
  for (const Point& point : line)
    flat.insert(flat.end(), point.begin(), point.end());
  return {{"x", packed_column(flat, 0, 2)}, {"y", packed_column(flat, 1, 2)}};
}

/// Pools and inner lines that differ are no one's.
void keep_what_both_have(Json& section, const Json& other)
{
  for (const char* side : {"left_level_m", "right_level_m"})
    if (section[side] != other.at(side))
      section[side] = nullptr;
  if (section["inner_lines"] != other.at("inner_lines"))
    section["inner_lines"] = Json::array();
}
} // namespace

Json study_lines(const fs::path& directory, const Json& study)
{
  Json section, members = Json::array();
  std::vector<std::vector<Line>> seen;
  std::size_t index = 0;
  for (const Json& member : study.at("members"))
  {
    const std::size_t m = index++;
    const std::optional<fs::path> folder = folder_of(directory, member);
    const std::optional<Drawn> drawn = folder ? drawn_in(*folder) : std::nullopt;
    if (!drawn || std::ranges::find(seen, drawn->lines) != seen.end())
      continue;
    if (seen.empty())
      section = drawn->section;
    else
      keep_what_both_have(section, drawn->section);
    Json lines = Json::array();
    for (const Line& line : drawn->lines)
      lines.push_back(packed_line(line));
    members.push_back({{"index", m}, {"lines", std::move(lines)}});
    seen.push_back(drawn->lines);
  }
  return seen.empty() ? Json() : Json({{"section", section}, {"members", members}});
}
} // namespace berm::app
