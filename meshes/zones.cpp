// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/zones.h"

#include "meshes/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace berm::meshes
{
namespace
{
/// A point in the interior of a simple polygon, as far from its corners' levels as can be.
Vec2 interior_point(const Polyline& polygon)
{
  std::vector<double> levels;
  for (const Vec2& p : polygon)
    levels.push_back(p.y());
  std::sort(levels.begin(), levels.end());
  double y = 0, gap = -1;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i)
    if (levels[i + 1] - levels[i] > gap)
    {
      gap = levels[i + 1] - levels[i];
      y = 0.5 * (levels[i + 1] + levels[i]);
    }
  std::vector<double> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2 &a = polygon[i], &b = polygon[next(i, polygon.size())];
    if ((a.y() > y) != (b.y() > y))
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(crossings.begin(), crossings.end());
  return {0.5 * (crossings[0] + crossings[1]), y};
}

/// Points where the outline is met by the edges of a zone, corners of the zone included.
Polyline meeting_points(const Polyline& outline, const Polyline& zone, double tolerance)
{
  Polyline points;
  for (std::size_t i = 0; i < zone.size(); ++i)
  {
    const Vec2 &a = zone[i], &b = zone[next(i, zone.size())];
    if (nearest_edge(outline, a).distance <= tolerance)
      points.push_back(a);
    for (std::size_t k = 0; k < outline.size(); ++k)
      if (const auto p = crossing(outline[k], outline[next(k, outline.size())], a, b))
        points.push_back(*p);
  }
  return points;
}

/// Whether zone and section share an area.
bool overlaps(const Polyline& outline, const Polyline& zone, double tolerance)
{
  const auto inside = [&](const Vec2& p)
  { return polygon_contains(outline, p) && nearest_edge(outline, p).distance > tolerance; };
  for (std::size_t i = 0; i < zone.size(); ++i)
  {
    const Vec2 &a = zone[i], &b = zone[next(i, zone.size())];
    std::vector<double> cuts = {0, 1};
    for (std::size_t k = 0; k < outline.size(); ++k)
    {
      const Vec2& c = outline[k];
      if (const auto p = crossing(c, outline[next(k, outline.size())], a, b))
        cuts.push_back(nearest_parameter(*p, a, b));
      if (distance(c, a, b) <= tolerance)
        cuts.push_back(nearest_parameter(c, a, b));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t m = 0; m + 1 < cuts.size(); ++m)
      if (inside(a + 0.5 * (cuts[m] + cuts[m + 1]) * (b - a)))
        return true;
  }
  // No edge of the zone runs inside the section: the zone holds all of it or nothing.
  return polygon_contains(zone, interior_point(outline));
}

/// Move corners that were meant to lie on the outline or on another zone onto them.
/// A polygon that would not survive it is left alone.
Polyline heal(const Polyline& zone, const Polyline& outline, const std::vector<Zone>& others,
              double reach)
{
  std::vector<const Polyline*> targets = {&outline};
  for (const Zone& other : others)
    targets.push_back(&other.polygon);
  Polyline moved;
  for (const Vec2& p : zone)
  {
    Vec2 best = p;
    double best_distance = reach;
    bool at_vertex = false;
    for (const Polyline* target : targets)
    {
      for (const Vec2& q : *target)
        if ((p - q).norm() <= (at_vertex ? best_distance : reach))
        {
          at_vertex = true;
          best_distance = (p - q).norm();
          best = q;
        }
      if (at_vertex)
        continue;
      const NearestEdge near = nearest_edge(*target, p);
      if (near.distance <= best_distance)
      {
        best_distance = near.distance;
        best = nearest_point(p, (*target)[near.edge], (*target)[next(near.edge, target->size())]);
      }
    }
    if (moved.empty() || moved.back() != best)
      moved.push_back(best);
  }
  moved = opened(std::move(moved));
  std::vector<Mistake> mistakes;
  if (!check_points("", moved, true, mistakes))
    return zone;
  check_simple("", moved, true, mistakes);
  return mistakes.empty() && polygon_area(moved) > 0 ? moved : zone;
}
} // namespace

void place_zones(Boundary& b, const std::vector<Zone>& drawn, const std::vector<bool>& usable,
                 Section& section, std::vector<Mistake>& mistakes)
{
  const double tolerance = same_point * b.size;
  for (std::size_t z = 0; z < drawn.size(); ++z)
  {
    if (!usable[z])
      continue;
    Zone zone = {drawn[z].soil, counter_clockwise(opened(drawn[z].polygon))};
    const double reach = healing_reach(zone.polygon, b.size);
    zone.polygon = heal(zone.polygon, b.points, section.zones, reach);
    if (!overlaps(b.points, zone.polygon, tolerance))
    {
      mistakes.push_back({fmt::format("section.zone[{}].polygon_m", z + 1),
                          text(zone.polygon.front()), "the zone lies outside the section",
                          "a polygon that covers a part of the section", ""});
      continue;
    }
    for (const Vec2& p : meeting_points(b.points, zone.polygon, tolerance))
      b.vertex_at(p, reach);
    section.zones.push_back(std::move(zone));
  }
}
} // namespace berm::meshes
