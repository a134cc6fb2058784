// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/section.h"

#include "core/error.h"
#include "meshes/drawing.h"
#include "meshes/marked_lines.h"
#include "meshes/outline.h"
#include "meshes/planar.h"
#include "meshes/pools.h"
#include "meshes/zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace berm::meshes
{
namespace
{
std::string name_of(StretchKind kind, Index marked_line)
{
  switch (kind)
  {
  case StretchKind::ground:
    return "ground";
  case StretchKind::left_pool:
    return "left_pool";
  case StretchKind::right_pool:
    return "right_pool";
  case StretchKind::overflow:
    return "overflow";
  case StretchKind::base:
    return "base";
  case StretchKind::left_side:
    return "left_side";
  case StretchKind::right_side:
    return "right_side";
  case StretchKind::marked:
    break;
  }
  return fmt::format("marked_{}", marked_line + 1);
}

/// @param[in] inner  Inner lines, with the marked line that each of them is.
void name_stretches(const Boundary& b, const std::vector<MarkedInside>& inner, Section& section)
{
  std::vector<std::pair<StretchKind, Index>> present;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    present.emplace_back(b.kind[i], b.marked_line[i]);
  const auto of_edge = present;
  for (const MarkedInside& line : inner)
    present.emplace_back(StretchKind::marked, line.marked_line);
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  for (const auto& [kind, line] : present)
    section.stretches.push_back({kind, line, name_of(kind, line)});
  const auto index_of = [&present](const std::pair<StretchKind, Index>& stretch)
  {
    return static_cast<Index>(std::lower_bound(present.begin(), present.end(), stretch) -
                              present.begin());
  };
  for (const auto& edge : of_edge)
    section.edge_stretch.push_back(index_of(edge));
  for (const MarkedInside& line : inner)
    section.inner_lines.push_back({line.points, index_of({StretchKind::marked, line.marked_line})});
}
} // namespace

Section build_section(const SectionInput& input)
{
  std::vector<Mistake> mistakes;
  std::vector<bool> zone_usable, line_usable;
  for (std::size_t z = 0; z < input.zones.size(); ++z)
  {
    const std::string key = fmt::format("section.zone[{}].polygon_m", z + 1);
    const Polyline polygon = opened(input.zones[z].polygon);
    const std::size_t before = mistakes.size();
    if (check_points(key, polygon, true, mistakes))
      check_simple(key, polygon, true, mistakes);
    zone_usable.push_back(mistakes.size() == before);
  }
  for (std::size_t l = 0; l < input.marked_lines.size(); ++l)
    line_usable.push_back(check_points(fmt::format("seepage.boundary[{}].line_m", l + 1),
                                       input.marked_lines[l], false, mistakes));

  std::optional<Boundary> boundary;
  if (!input.ground.empty())
    boundary = boundary_from_ground(input, mistakes);
  else if (!input.outline.empty())
    boundary = boundary_from_outline(input, mistakes);
  else
    mistakes.push_back({"section.ground_m", "", "the section is not drawn", "",
                        "give ground_m and base_m, or outline_m"});
  if (!boundary)
    throw InputError(std::move(mistakes));

  Section section;
  Boundary& b = *boundary;
  flood(b, input, section, mistakes);
  place_zones(b, input.zones, zone_usable, section, mistakes);
  const std::vector<MarkedInside> inner = mark_lines(b, input.marked_lines, line_usable, mistakes);
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));

  name_stretches(b, inner, section);
  const auto [x_min, x_max] = std::minmax_element(
      b.points.begin(), b.points.end(), [](const Vec2& p, const Vec2& q) { return p.x() < q.x(); });
  const auto [y_min, y_max] = std::minmax_element(
      b.points.begin(), b.points.end(), [](const Vec2& p, const Vec2& q) { return p.y() < q.y(); });
  section.x_min = x_min->x();
  section.x_max = x_max->x();
  section.y_min = y_min->y();
  section.y_max = y_max->y();
  section.left_side_top = b.ground.front().y();
  section.right_side_top = b.ground.back().y();
  section.single_valued = b.single_valued;
  section.outline = std::move(b.points);
  section.ground = std::move(b.ground);
  section.base = std::move(b.base);
  return section;
}

double ground_level(const Section& section, double x)
{
  assert(section.single_valued);
  return level_of(section.ground, x, true);
}

double base_level(const Section& section, double x)
{
  return level_of(section.base, x, false);
}

bool contains(const Section& section, const Vec2& point)
{
  const double size = std::max(section.x_max - section.x_min, section.y_max - section.y_min);
  return polygon_contains(section.outline, point) ||
         nearest_edge(section.outline, point).distance <= same_point * size;
}

Index soil_at(const Section& section, const Vec2& point)
{
  for (auto zone = section.zones.rbegin(); zone != section.zones.rend(); ++zone)
    if (polygon_contains(zone->polygon, point))
      return zone->soil;
  return 0;
}
} // namespace berm::meshes
