// SPDX-License-Identifier: GPL-2.0-or-later
#include "meshes/section.h"

#include "core/error.h"
#include "meshes/planar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace berm::meshes
{
namespace
{
/// How far a marked line may be drawn from the outline, relative to the larger extent of the
/// section.
constexpr double marked_off = 1e-4;

std::string text(const Vec2& p)
{
  return fmt::format("({:.10g}, {:.10g})", p.x(), p.y());
}
std::string text(const Vec2& a, const Vec2& b)
{
  return text(a) + " - " + text(b);
}

double extent(const Polyline& points)
{
  if (points.empty())
    return 0;
  Vec2 lower = points.front(), upper = lower;
  for (const Vec2& p : points)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  return (upper - lower).maxCoeff();
}

//------------------------------------------------------------------------------------------------
// Checks of one polyline
//------------------------------------------------------------------------------------------------

/// Number of points, finite numbers, repeated points. True if the polyline can be worked with.
bool check_points(const std::string& key, const Polyline& points, bool closed,
                  std::vector<Mistake>& mistakes)
{
  const std::size_t before = mistakes.size();
  const std::size_t least = closed ? 3 : 2;
  if (points.size() < least)
    mistakes.push_back({key, fmt::format("{} points", points.size()), "too few points",
                        fmt::format("at least {} points", least), ""});
  bool finite = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].allFinite())
      continue;
    finite = false;
    mistakes.push_back({key, text(points[i]), fmt::format("point {} is not a number", i + 1),
                        "finite numbers", ""});
  }
  if (!finite)
    return false;
  const double tolerance = same_point * extent(points);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
  {
    const std::size_t j = next(i, points.size());
    if (i != j && (points[i] - points[j]).norm() <= tolerance)
      mistakes.push_back({key, text(points[i]),
                          fmt::format("points {} and {} are the same", i + 1, j + 1), "",
                          "leave one of them out"});
  }
  return mistakes.size() == before;
}

/// Edges that cross, touch or fold back on each other; one mistake for each edge is enough.
void check_simple(const std::string& key, const Polyline& points, bool closed,
                  std::vector<Mistake>& mistakes)
{
  const std::size_t n = points.size(), edges = closed ? n : n - 1;
  const double tolerance = same_point * extent(points);
  for (std::size_t i = 0; i < edges; ++i)
    for (std::size_t j = i + 1; j < edges; ++j)
    {
      const Vec2 &a = points[i], &b = points[next(i, n)];
      const Vec2 &c = points[j], &d = points[next(j, n)];
      bool bad = false;
      if (j == i + 1) // b == c
        bad = distance(d, a, b) <= tolerance || distance(a, c, d) <= tolerance;
      if (closed && i == 0 && j == n - 1) // d == a
        bad = bad || distance(c, a, b) <= tolerance || distance(b, c, d) <= tolerance;
      else if (j != i + 1)
        bad = distance(a, b, c, d) <= tolerance;
      if (!bad)
        continue;
      mistakes.push_back(
          {key, text(a, b),
           fmt::format("edge {} {} edge {}, {}", i + 1,
                       crossing(a, b, c, d) ? "crosses" : "touches", j + 1, text(c, d)),
           "edges that meet only at their common ends", ""});
      break;
    }
}

void check_left_to_right(const std::string& key, const Polyline& points,
                         std::vector<Mistake>& mistakes)
{
  const double tolerance = same_point * extent(points);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if (points[i + 1].x() < points[i].x() - tolerance)
      mistakes.push_back({key, text(points[i + 1]),
                          fmt::format("x falls from point {} to point {}", i + 1, i + 2),
                          "points from left to right; vertical steps are allowed",
                          "draw an overhang with section.outline_m"});
}

/// The polygon without a repeated last point, counter-clockwise.
Polyline opened(Polyline polygon)
{
  if (polygon.size() > 1 && polygon.front() == polygon.back())
    polygon.pop_back();
  return polygon;
}

Polyline counter_clockwise(Polyline polygon)
{
  if (polygon_area(polygon) < 0)
    std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// Highest or lowest level of a chain that runs from left to right, at x, which is clamped to it.
double level_of(const Polyline& chain, double x, bool highest)
{
  x = std::clamp(x, chain.front().x(), chain.back().x());
  const double none = std::numeric_limits<double>::infinity();
  double level = highest ? -none : none;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
  {
    const Vec2 &a = chain[i], &b = chain[i + 1];
    if (x < a.x() || x > b.x())
      continue;
    const double width = b.x() - a.x();
    const double t = width > 0 ? (x - a.x()) / width : 0;
    const double y = t < 1 ? a.y() + t * (b.y() - a.y()) : b.y();
    const double other = width > 0 ? y : b.y();
    level = highest ? std::max({level, y, other}) : std::min({level, y, other});
  }
  return level;
}

//------------------------------------------------------------------------------------------------
// The outline and what each of its edges is
//------------------------------------------------------------------------------------------------

/// The outline while it is being cut into stretches.
struct Boundary
{
  Polyline points;               ///< counter-clockwise, from the left end of the base
  std::vector<StretchKind> kind; ///< of the edge that starts at each point
  std::vector<Index> marked_line;
  Polyline ground, base; ///< left to right, as drawn
  bool single_valued = true;
  double size = 0; ///< larger extent [m]

  void add(const Vec2& point, StretchKind edge)
  {
    points.push_back(point);
    kind.push_back(edge);
    marked_line.push_back(-1);
  }

  /// A vertex at p: an existing one within `reach`, else a new one on the nearest edge.
  Vec2 vertex_at(const Vec2& p, double reach)
  {
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const Vec2& a, const Vec2& b) {
                                            return (a - p).squaredNorm() < (b - p).squaredNorm();
                                          });
    if ((*nearest - p).norm() <= reach)
      return *nearest;
    const auto k = static_cast<std::ptrdiff_t>(nearest_edge(points, p).edge);
    points.insert(points.begin() + k + 1, p);
    kind.insert(kind.begin() + k, kind[static_cast<std::size_t>(k)]);
    marked_line.insert(marked_line.begin() + k, marked_line[static_cast<std::size_t>(k)]);
    return p;
  }

  [[nodiscard]] std::size_t index_of(const Vec2& vertex) const
  {
    const auto found = std::find(points.begin(), points.end(), vertex);
    assert(found != points.end());
    return static_cast<std::size_t>(found - points.begin());
  }
};

Boundary join(Polyline ground, Polyline base)
{
  Boundary b;
  b.size = std::max(extent(ground), extent(base));
  const double tolerance = same_point * b.size;
  base.front().x() = ground.front().x();
  base.back().x() = ground.back().x();
  const bool left_side = (ground.front() - base.front()).norm() > tolerance;
  const bool right_side = (ground.back() - base.back()).norm() > tolerance;
  if (!left_side)
    base.front() = ground.front();
  if (!right_side)
    base.back() = ground.back();
  for (std::size_t i = 0; i + 1 < base.size(); ++i)
    b.add(base[i], StretchKind::base);
  if (right_side)
    b.add(base.back(), StretchKind::right_side);
  for (std::size_t i = ground.size() - 1; i > 0; --i)
    b.add(ground[i], StretchKind::ground);
  if (left_side)
    b.add(ground.front(), StretchKind::left_side);
  b.ground = std::move(ground);
  b.base = std::move(base);
  return b;
}

std::optional<Boundary> boundary_from_ground(const SectionInput& input,
                                             std::vector<Mistake>& mistakes)
{
  const std::string ground_key = "section.ground_m", base_key = "section.base_m";
  const std::size_t before = mistakes.size();
  Polyline base = input.base;
  const Polyline& ground = input.ground;
  const bool ground_usable = check_points(ground_key, ground, false, mistakes);
  const bool base_usable = check_points(base_key, base, false, mistakes);
  if (ground_usable)
  {
    check_left_to_right(ground_key, ground, mistakes);
    check_simple(ground_key, ground, false, mistakes);
  }
  if (base_usable)
  {
    check_left_to_right(base_key, base, mistakes);
    check_simple(base_key, base, false, mistakes);
  }
  if (mistakes.size() > before)
    return std::nullopt;

  const double tolerance = same_point * std::max(extent(ground), extent(base));
  const double left = ground.front().x(), right = ground.back().x();
  if (right - left <= tolerance)
  {
    mistakes.push_back({ground_key, text(ground.front(), ground.back()), "has no width", "", ""});
    return std::nullopt;
  }
  const bool covers = base.front().x() <= left + tolerance && base.back().x() >= right - tolerance;
  const bool fits = base.front().x() >= left - tolerance && base.back().x() <= right + tolerance;
  const bool level = base.size() == 2 && base.front().y() == base.back().y();
  if (!covers || (!fits && !level))
  {
    mistakes.push_back({base_key, text(base.front(), base.back()),
                        "the base does not end where the ground ends",
                        fmt::format("from x = {:.10g} to x = {:.10g}", left, right), ""});
    return std::nullopt;
  }
  base.front().x() = left; // a wider level is cut to the ground
  base.back().x() = right;

  // Where the base lies above the ground; steps that only overlap show up as touching edges below.
  double excess = tolerance, worst_x = 0;
  for (const bool of_ground : {true, false})
    for (const Vec2& p : of_ground ? ground : base)
    {
      const double above =
          of_ground ? level_of(base, p.x(), false) - p.y() : p.y() - level_of(ground, p.x(), true);
      if (above > excess)
      {
        excess = above;
        worst_x = p.x();
      }
    }
  if (excess > tolerance)
  {
    mistakes.push_back(
        {base_key, fmt::format("{:.10g}", level_of(base, worst_x, false)),
         fmt::format("the base is {:.4g} m above the ground at x = {:.10g}", excess, worst_x),
         "a base below the ground everywhere", ""});
    return std::nullopt;
  }
  Boundary b = join(ground, std::move(base));
  if (b.points.size() < 3 || std::abs(polygon_area(b.points)) <= tolerance * b.size)
    mistakes.push_back({ground_key, "", "there is no soil between ground and base", "", ""});
  else
    check_simple(ground_key, b.points, true, mistakes);
  if (mistakes.size() > before)
    return std::nullopt;
  return b;
}

std::optional<Boundary> boundary_from_outline(const SectionInput& input,
                                              std::vector<Mistake>& mistakes)
{
  const std::string key = "section.outline_m";
  const std::size_t before = mistakes.size();
  Polyline points = opened(input.outline);
  if (!check_points(key, points, true, mistakes))
    return std::nullopt;
  Boundary b;
  b.size = extent(points);
  const double tolerance = same_point * b.size;
  if (std::abs(polygon_area(points)) <= tolerance * b.size)
    mistakes.push_back({key, "", "encloses no area", "", ""});
  else
    check_simple(key, points, true, mistakes);
  if (mistakes.size() > before)
    return std::nullopt;
  points = counter_clockwise(std::move(points));

  // The four corners where base, right side, ground and left side meet, counter-clockwise.
  const auto by_x = [](const Vec2& p, const Vec2& q) { return p.x() < q.x(); };
  const double x_min = std::min_element(points.begin(), points.end(), by_x)->x();
  const double x_max = std::max_element(points.begin(), points.end(), by_x)->x();
  const auto corner = [&](double x, double sign)
  {
    auto best = points.end();
    for (auto p = points.begin(); p != points.end(); ++p)
      if (std::abs(p->x() - x) <= tolerance &&
          (best == points.end() || sign * p->y() > sign * best->y()))
        best = p;
    return best;
  };
  std::rotate(points.begin(), corner(x_min, -1), points.end());
  const auto right_low = corner(x_max, -1), right_high = corner(x_max, 1);
  const auto left_high = corner(x_min, 1) == points.begin() ? points.end() : corner(x_min, 1);
  for (auto p = points.begin(); p != points.end(); ++p)
    b.add(*p, p < right_low    ? StretchKind::base
              : p < right_high ? StretchKind::right_side
              : p < left_high  ? StretchKind::ground
                               : StretchKind::left_side);
  b.base.assign(points.begin(), right_low + 1);
  b.ground.assign(right_high, left_high);
  b.ground.push_back(left_high == points.end() ? points.front() : *left_high);
  std::reverse(b.ground.begin(), b.ground.end());
  for (const Polyline* chain : {&b.base, &b.ground})
    for (std::size_t i = 0; i + 1 < chain->size(); ++i)
      b.single_valued = b.single_valued && (*chain)[i + 1].x() >= (*chain)[i].x() - tolerance;
  for (std::size_t i = 0; i < b.points.size(); ++i) // a notch in the end of the section
    if (b.kind[i] == StretchKind::left_side || b.kind[i] == StretchKind::right_side)
      b.single_valued =
          b.single_valued &&
          std::abs(b.points[i].x() - b.points[next(i, b.points.size())].x()) <= tolerance;
  return b;
}

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
// Zones
//------------------------------------------------------------------------------------------------

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
  assert(section.single_valued);
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

double polygon_area(const Polyline& polygon)
{
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

bool polygon_contains(const Polyline& polygon, const Vec2& point)
{
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2 &a = polygon[i], &b = polygon[next(i, polygon.size())];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

Polyline clip_to_box(const Polyline& polygon, const Vec2& lower, const Vec2& upper)
{
  Polyline clipped = polygon, source;
  for (const Eigen::Index axis : {0, 1})
    for (const double sign : {1.0, -1.0}) // sign * (p - bound) >= 0 stays
    {
      const double bound = sign > 0 ? lower[axis] : upper[axis];
      source.swap(clipped);
      clipped.clear();
      for (std::size_t i = 0; i < source.size(); ++i)
      {
        const Vec2 &a = source[i], &b = source[next(i, source.size())];
        const double in_a = sign * (a[axis] - bound), in_b = sign * (b[axis] - bound);
        if (in_a >= 0)
          clipped.push_back(a);
        if ((in_a > 0 && in_b < 0) || (in_a < 0 && in_b > 0))
        {
          Vec2 cut = a + in_a / (in_a - in_b) * (b - a);
          cut[axis] = bound;
          clipped.push_back(cut);
        }
      }
    }
  return clipped;
}
} // namespace berm::meshes
