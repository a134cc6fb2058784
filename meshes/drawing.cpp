// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/drawing.h"

#include "meshes/planar.h"
#include "meshes/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::meshes
{
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
} // namespace berm::meshes
