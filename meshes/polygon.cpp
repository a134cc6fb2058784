// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/planar.h"
#include "meshes/section.h"

namespace berm::meshes
{
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
