// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/section.h"

#include "core/error.h"
#include "meshes/drawing.h"
#include "meshes/outline.h"
#include "meshes/planar.h"
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
/// How far a marked line may be drawn from the outline, relative to the larger extent of the
/// section.
constexpr double marked_off = 1e-4;

//------------------------------------------------------------------------------------------------
// Pools
//------------------------------------------------------------------------------------------------

enum class Reach
{
  absent,       ///< no water on the ground
  partial,      ///< up to `end`
  whole,        ///< over all the ground
  below_ground, ///< the level is below the ground at the pool's own end
};

struct Pool
{
  Reach reach = Reach::absent;
  Vec2 end = Vec2::Zero(); ///< the waterline
};

/// Follow the ground from the pool's end until it comes up to the level.
Pool pool_on(const Polyline& ground, double level, double tolerance)
{
  if (ground.front().y() > level + tolerance)
    return {Reach::below_ground};
  bool wet = false;
  for (std::size_t i = 0; i < ground.size(); ++i)
  {
    const Vec2& p = ground[i];
    if (p.y() < level - tolerance)
      wet = true;
    else if (!wet && p.y() > level + tolerance)
      return {Reach::absent};
    else if (wet && p.y() <= level + tolerance)
      return {Reach::partial, p};
    else if (wet)
    {
      const Vec2& below = ground[i - 1];
      const double t = (level - below.y()) / (p.y() - below.y());
      return {Reach::partial, Vec2(below.x() + t * (p.x() - below.x()), level)};
    }
  }
  return {wet ? Reach::whole : Reach::absent};
}

void flood(Boundary& b, const SectionInput& input, Section& section, std::vector<Mistake>& mistakes)
{
  const std::string keys[] = {"water.left_level_m", "water.right_level_m"};
  const std::optional<double> levels[] = {input.left_pool_level, input.right_pool_level};
  const double tolerance = same_point * b.size;
  const std::size_t before = mistakes.size();
  Pool pools[2];
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (!levels[side])
      continue;
    const std::string value = fmt::format("{:.10g}", *levels[side]);
    if (!std::isfinite(*levels[side]))
    {
      mistakes.push_back({keys[side], value, "is not a number", "a finite level", ""});
      continue;
    }
    Polyline ground = b.ground;
    if (side == 1)
      std::reverse(ground.begin(), ground.end());
    pools[side] = pool_on(ground, *levels[side], tolerance);
    if (pools[side].reach == Reach::below_ground)
      mistakes.push_back({keys[side], value,
                          fmt::format("the pool is below the ground at its end of the section, {}",
                                      text(ground.front())),
                          fmt::format("at least {:.10g}", ground.front().y()),
                          "a water table inside the soil is a head on the side: "
                          "[[seepage.boundary]]"});
  }
  const bool same_level = levels[0] && levels[1] && std::abs(*levels[0] - *levels[1]) <= tolerance;
  for (std::size_t side = 0; side < 2; ++side)
    if (pools[side].reach == Reach::whole && levels[1 - side] && !same_level)
      mistakes.push_back({keys[side], fmt::format("{:.10g}", *levels[side]),
                          fmt::format("the pool overtops the section, and {} = {:.10g} is another "
                                      "level",
                                      keys[1 - side], *levels[1 - side]),
                          "a level below the highest ground, or the same level on both sides", ""});
  if (mistakes.size() > before)
    return;
  if (pools[0].reach == Reach::whole)
    pools[1] = {}; // all of it is the left pool

  const bool present[] = {pools[0].reach != Reach::absent, pools[1].reach != Reach::absent};
  if (present[0])
    section.left_pool_level = levels[0];
  if (present[1])
    section.right_pool_level = levels[1];
  for (Pool& pool : pools)
    if (pool.reach == Reach::partial)
      pool.end = b.vertex_at(pool.end, tolerance);
  // The outline runs along the ground from right to left.
  const std::size_t n = b.points.size();
  bool in_pool = present[1];
  for (std::size_t i = 0; i < n && in_pool; ++i)
  {
    if (b.kind[i] != StretchKind::ground)
      continue;
    in_pool = pools[1].reach == Reach::whole || b.points[i] != pools[1].end;
    if (in_pool)
      b.kind[i] = StretchKind::right_pool;
  }
  in_pool = present[0];
  for (std::size_t i = n; i-- > 0 && in_pool;)
  {
    if (b.kind[i] != StretchKind::ground)
      continue;
    in_pool = pools[0].reach == Reach::whole || b.points[next(i, n)] != pools[0].end;
    if (in_pool)
      b.kind[i] = StretchKind::left_pool;
  }
}

//------------------------------------------------------------------------------------------------
// Marked lines
//------------------------------------------------------------------------------------------------

/// Farthest vertex from segment p-q on the way along the outline from vertex i to vertex j [m].
double deviation(const Polyline& outline, std::size_t i, std::size_t j)
{
  double worst = 0;
  for (std::size_t k = i; k != j; k = next(k, outline.size()))
    worst = std::max(worst, distance(outline[k], outline[i], outline[j]));
  return worst;
}

/// Put vertices of the outline at the line's points. Nothing if one of them is off the outline.
std::optional<Polyline> lay_on_outline(Boundary& b, const Polyline& line, const std::string& key,
                                       std::vector<Mistake>& mistakes)
{
  const double allowed = marked_off * b.size;
  const double reach = std::min(allowed, 0.05 * extent(line)); // a short drain keeps both its ends
  const std::size_t before = mistakes.size();
  Polyline on;
  for (const Vec2& p : line)
  {
    const NearestEdge near = nearest_edge(b.points, p);
    if (near.distance > allowed)
      mistakes.push_back({key, text(p),
                          fmt::format("lies {:.4g} m away from the outline", near.distance),
                          fmt::format("within {:.2g} m", allowed), ""});
    else
      on.push_back(b.vertex_at(
          nearest_point(p, b.points[near.edge], b.points[next(near.edge, b.points.size())]),
          reach));
  }
  if (mistakes.size() > before)
    return std::nullopt;
  return on;
}

void mark_lines(Boundary& b, const std::vector<Polyline>& lines, const std::vector<bool>& usable,
                std::vector<Mistake>& mistakes)
{
  const auto key = [](std::size_t l) { return fmt::format("seepage.boundary[{}].line_m", l + 1); };
  // All vertices first: they must not split an edge that is marked already.
  std::vector<Polyline> laid(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    if (usable[l])
      laid[l] = lay_on_outline(b, lines[l], key(l), mistakes).value_or(Polyline{});
  const std::size_t n = b.points.size();
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t m = 0; m + 1 < laid[l].size(); ++m)
    {
      std::size_t i = b.index_of(laid[l][m]), j = b.index_of(laid[l][m + 1]);
      const double forwards = deviation(b.points, i, j), backwards = deviation(b.points, j, i);
      if (backwards < forwards)
        std::swap(i, j);
      const double off = std::min(forwards, backwards);
      if (off > marked_off * b.size)
        mistakes.push_back({key(l), text(lines[l][m], lines[l][m + 1]),
                            fmt::format("the outline leaves this line by {:.4g} m", off),
                            "a line along the outline", "give every corner of the outline on it"});
      else
        for (std::size_t k = i; k != j; k = next(k, n))
        {
          b.kind[k] = StretchKind::marked;
          b.marked_line[k] = static_cast<Index>(l);
        }
    }
}

//------------------------------------------------------------------------------------------------

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

void name_stretches(const Boundary& b, Section& section)
{
  std::vector<std::pair<StretchKind, Index>> present;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    present.emplace_back(b.kind[i], b.marked_line[i]);
  const auto of_edge = present;
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  for (const auto& [kind, line] : present)
    section.stretches.push_back({kind, line, name_of(kind, line)});
  for (const auto& edge : of_edge)
    section.edge_stretch.push_back(static_cast<Index>(
        std::lower_bound(present.begin(), present.end(), edge) - present.begin()));
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
  mark_lines(b, input.marked_lines, line_usable, mistakes);
  if (!mistakes.empty())
    throw InputError(std::move(mistakes));

  name_stretches(b, section);
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
