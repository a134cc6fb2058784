// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

/// Plane geometry that the section and its mesher share.
namespace berm::meshes
{
/// Points closer than this, relative to the larger extent of the section, are one point.
inline constexpr double same_point = 1e-9;

/// The next vertex of a closed polygon with n vertices.
[[nodiscard]] inline std::size_t next(std::size_t i, std::size_t n)
{
  return i + 1 < n ? i + 1 : 0;
}

/// z component of a x b [m2]: positive if b points to the left of a.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// Position of the point of segment a-b that is nearest to p, 0 at a, 1 at b.
[[nodiscard]] inline double nearest_parameter(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

[[nodiscard]] inline Vec2 nearest_point(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const double t = nearest_parameter(p, a, b);
  return t < 1 ? Vec2(a + t * (b - a)) : b;
}

/// Distance of p from segment a-b [m].
[[nodiscard]] inline double distance(const Vec2& p, const Vec2& a, const Vec2& b)
{
  return (p - nearest_point(p, a, b)).norm();
}

/// Distance of p from an open line [m]; infinite if the line has no segment.
[[nodiscard]] inline double distance(const Vec2& p, const Polyline& line)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < line.size(); ++k)
    least = std::min(least, distance(p, line[k - 1], line[k]));
  return least;
}

/// Where segments a-b and c-d cross at a point inside both; nothing if they only touch or are
/// parallel.
[[nodiscard]] inline std::optional<Vec2> crossing(const Vec2& a, const Vec2& b, const Vec2& c,
                                                  const Vec2& d)
{
  const double at_a = cross(d - c, a - c), at_b = cross(d - c, b - c);
  const double at_c = cross(b - a, c - a), at_d = cross(b - a, d - a);
  if (!((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) ||
      !((at_c > 0 && at_d < 0) || (at_c < 0 && at_d > 0)))
    return std::nullopt;
  return a + at_a / (at_a - at_b) * (b - a);
}

/// Distance between segments a-b and c-d [m]; 0 if they cross.
[[nodiscard]] inline double distance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
  if (crossing(a, b, c, d))
    return 0;
  return std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
}

/// The edge of a closed polygon that is nearest to a point.
struct NearestEdge
{
  std::size_t edge = 0;                                      ///< edge k joins vertices k and k+1
  double distance = std::numeric_limits<double>::infinity(); ///< [m]
};

[[nodiscard]] inline NearestEdge nearest_edge(const Polyline& polygon, const Vec2& p)
{
  NearestEdge best;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const double d = distance(p, polygon[k], polygon[next(k, polygon.size())]);
    if (d < best.distance)
      best = {k, d};
  }
  return best;
}

/// Length of the shortest edge of a closed polygon [m].
[[nodiscard]] inline double shortest_edge(const Polyline& polygon)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    shortest = std::min(shortest, (polygon[next(i, polygon.size())] - polygon[i]).norm());
  return shortest;
}

/// How far off a zone's border may be drawn and still be moved to a vertex or an edge nearby [m].
/// Drawings are rounded to millimetres on a hundred metres, but a thin zone keeps its thickness.
[[nodiscard]] inline double healing_reach(const Polyline& zone, double section_size)
{
  return std::max(same_point * section_size,
                  std::min(1e-5 * section_size, 0.1 * shortest_edge(zone)));
}
} // namespace berm::meshes
