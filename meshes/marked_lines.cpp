// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/marked_lines.h"

#include "meshes/drawing.h"

#include <fmt/format.h>

#include <algorithm>
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

/// Between two points on the outline, a line that the outline leaves by less than this share of its
/// length is a line along the outline with a corner forgotten; by more, a wall right through.
constexpr double chord = 0.1;

std::string key_of(std::size_t line)
{
  return fmt::format("seepage.boundary[{}].line_m", line + 1);
}

bool on_outline(const Boundary& b, const Vec2& p)
{
  return nearest_edge(b.points, p).distance <= marked_off * b.size;
}

/// Farthest vertex from segment p-q on the way along the outline from vertex i to vertex j [m].
double deviation(const Polyline& outline, std::size_t i, std::size_t j)
{
  double worst = 0;
  for (std::size_t k = i; k != j; k = next(k, outline.size()))
    worst = std::max(worst, distance(outline[k], outline[i], outline[j]));
  return worst;
}

double smaller_deviation(const Polyline& outline, std::size_t i, std::size_t j)
{
  return std::min(deviation(outline, i, j), deviation(outline, j, i));
}

/// A vertex of the outline at the line's point.
Vec2 laid_on_outline(Boundary& b, const Vec2& p, double line_extent)
{
  const double reach =
      std::min(marked_off * b.size, 0.05 * line_extent); // a short drain keeps both its ends
  const NearestEdge near = nearest_edge(b.points, p);
  return b.vertex_at(
      nearest_point(p, b.points[near.edge], b.points[next(near.edge, b.points.size())]), reach);
}

/// Whether all points lie in or on the section.
bool within_section(const Boundary& b, const Polyline& line, const std::string& key,
                    std::vector<Mistake>& mistakes)
{
  const std::size_t before = mistakes.size();
  for (const Vec2& p : line)
    if (!on_outline(b, p) && !polygon_contains(b.points, p))
      mistakes.push_back(
          {key, text(p),
           fmt::format("lies {:.4g} m outside the section", nearest_edge(b.points, p).distance),
           fmt::format("on the outline, within {:.2g} m, or inside it", marked_off * b.size), ""});
  return mistakes.size() == before;
}

/// Pre: the points lie in or on the section; those on it are vertices of the outline.
bool is_inner(const Boundary& b, const Polyline& line)
{
  if (std::any_of(line.begin(), line.end(), [&](const Vec2& p) { return !on_outline(b, p); }))
    return true;
  return line.size() == 2 && smaller_deviation(b.points, b.index_of(line[0]), b.index_of(line[1])) >
                                 chord * (line[1] - line[0]).norm();
}

/// An inner line meets the outline at its ends only, and itself nowhere.
void check_inner(const Boundary& b, const Polyline& line, const std::string& key,
                 std::vector<Mistake>& mistakes)
{
  check_simple(key, line, false, mistakes);
  for (std::size_t m = 1; m + 1 < line.size(); ++m)
    if (on_outline(b, line[m]))
      mistakes.push_back({key, text(line[m]), "a line through the soil meets the outline here",
                          "a line inside the section may meet the outline at its ends only",
                          "make two boundaries of it, one on the outline, one inside"});
  const double tolerance = same_point * b.size;
  for (std::size_t m = 0; m + 1 < line.size(); ++m)
  {
    const Vec2 &p = line[m], &q = line[m + 1];
    std::optional<Vec2> meets;
    for (std::size_t k = 0; k < b.points.size() && !meets; ++k)
    {
      const Vec2& a = b.points[k];
      if (distance(a, p, q) <= tolerance && (a - p).norm() > tolerance &&
          (a - q).norm() > tolerance)
        meets = a;
      else
        meets = crossing(p, q, a, b.points[next(k, b.points.size())]);
    }
    if (!meets && !polygon_contains(b.points, 0.5 * (p + q)))
      meets = 0.5 * (p + q);
    if (meets)
      mistakes.push_back({key, text(p, q),
                          fmt::format("leaves or touches the section at {}", text(*meets)),
                          "a line inside the section may meet the outline at its ends only", ""});
  }
}

/// Whether two segments share more than a point.
bool overlap(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double tolerance)
{
  Polyline shared;
  const auto add = [&](const Vec2& p, const Vec2& from, const Vec2& to)
  {
    if (distance(p, from, to) <= tolerance &&
        std::none_of(shared.begin(), shared.end(),
                     [&](const Vec2& q) { return (p - q).norm() <= tolerance; }))
      shared.push_back(p);
  };
  add(a, c, d);
  add(b, c, d);
  add(c, a, b);
  add(d, a, b);
  return shared.size() > 1;
}

void check_overlaps(const std::vector<MarkedInside>& inner, double tolerance,
                    std::vector<Mistake>& mistakes)
{
  for (std::size_t l = 1; l < inner.size(); ++l)
    for (std::size_t k = 0; k < l; ++k)
    {
      const Polyline &line = inner[l].points, &other = inner[k].points;
      for (std::size_t m = 0; m + 1 < line.size(); ++m)
        for (std::size_t i = 0; i + 1 < other.size(); ++i)
          if (overlap(line[m], line[m + 1], other[i], other[i + 1], tolerance))
            mistakes.push_back({key_of(static_cast<std::size_t>(inner[l].marked_line)),
                                text(line[m], line[m + 1]),
                                fmt::format("runs along {}, {}",
                                            key_of(static_cast<std::size_t>(inner[k].marked_line)),
                                            text(other[i], other[i + 1])),
                                "lines inside the section may meet at points only", ""});
    }
}

/// Edges of the outline along the line become those of marked line l.
void mark_along_outline(Boundary& b, const Polyline& line, std::size_t l,
                        std::vector<Mistake>& mistakes)
{
  for (std::size_t m = 0; m + 1 < line.size(); ++m)
  {
    std::size_t i = b.index_of(line[m]), j = b.index_of(line[m + 1]);
    if (deviation(b.points, j, i) < deviation(b.points, i, j))
      std::swap(i, j);
    const double off = deviation(b.points, i, j);
    if (off > marked_off * b.size)
      mistakes.push_back({key_of(l), text(line[m], line[m + 1]),
                          fmt::format("the outline leaves this line by {:.4g} m", off),
                          "a line along the outline, or one inside the section",
                          "give every corner of the outline on it; a wall right through that runs "
                          "so near to the outline needs a point inside"});
    else
      for (std::size_t k = i; k != j; k = next(k, b.points.size()))
      {
        b.kind[k] = StretchKind::marked;
        b.marked_line[k] = static_cast<Index>(l);
      }
  }
}
} // namespace

std::vector<MarkedInside> mark_lines(Boundary& b, const std::vector<Polyline>& lines,
                                     const std::vector<bool>& usable,
                                     std::vector<Mistake>& mistakes)
{
  // All vertices first: they must not split an edge that is marked already.
  std::vector<Polyline> laid(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l)
    if (usable[l] && within_section(b, lines[l], key_of(l), mistakes))
      for (const Vec2& p : lines[l])
        laid[l].push_back(on_outline(b, p) ? laid_on_outline(b, p, extent(lines[l])) : p);

  std::vector<MarkedInside> inner;
  for (std::size_t l = 0; l < lines.size(); ++l)
  {
    if (laid[l].empty())
      continue;
    if (is_inner(b, laid[l]))
    {
      check_inner(b, laid[l], key_of(l), mistakes);
      inner.push_back({laid[l], static_cast<Index>(l)});
    }
    else
      mark_along_outline(b, laid[l], l, mistakes);
  }
  check_overlaps(inner, same_point * b.size, mistakes);
  return inner;
}
} // namespace berm::meshes
