// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/relax.h"

#include "meshes/planar.h"
#include "sph/kernel.h"
#include "sph/neighbours.h"
#include "sph/voronoi.h"

namespace berm::sph
{
namespace
{
/// Move a point by a fifth of the spacing at most, unless it would leave the section.
void move(Vec2& point, Vec2 step, const meshes::Section& section, double spacing)
{
  const double longest = 0.2 * spacing;
  if (const double length = step.norm(); length > longest)
    step *= longest / length;
  if (meshes::polygon_contains(section.outline, point + step))
    point += step;
}

/// -0.2 h^2 sum_j dx^2 grad_i W_ij for every point [m]
std::vector<Vec2> shifts(const std::vector<Vec2>& points, const CubicSpline& W, double spacing)
{
  std::vector<double> x, y;
  for (const Vec2& p : points)
  {
    x.push_back(p.x());
    y.push_back(p.y());
  }
  const NeighbourList near = find_neighbours(x, y, static_cast<Index>(points.size()), W.radius());
  const double gain = 0.2 * W.h * W.h * spacing * spacing;
  std::vector<Vec2> shift(points.size(), Vec2::Zero());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const Index j : near.of(static_cast<Index>(i)))
    {
      const Vec2 apart = points[i] - points[static_cast<std::size_t>(j)];
      const double r = apart.norm();
      shift[i] -= gain * W.dW(r) / r * apart;
    }
  return shift;
}
} // namespace

std::vector<Vec2> relax(const meshes::Section& section, std::vector<Vec2> points, double spacing,
                        int passes)
{
  for (int pass = 0; pass < passes; ++pass)
  {
    const std::vector<VoronoiCell> cells = voronoi_cells(section, points, spacing);
    for (std::size_t i = 0; i < points.size(); ++i)
      move(points[i], cells[i].centroid - points[i], section, spacing);
  }
  return points;
}

std::vector<Vec2> unload(const meshes::Section& section, std::vector<Vec2> points, double spacing,
                         int passes)
{
  const CubicSpline W{1.2 * spacing};
  std::vector<bool> deep;
  for (const Vec2& p : points)
    deep.push_back(meshes::nearest_edge(section.outline, p).distance >= W.radius());
  for (int pass = 0; pass < passes; ++pass)
  {
    const std::vector<VoronoiCell> cells = voronoi_cells(section, points, spacing);
    const std::vector<Vec2> shift = shifts(points, W, spacing);
    for (std::size_t i = 0; i < points.size(); ++i)
      move(points[i], deep[i] ? shift[i] : Vec2(cells[i].centroid - points[i]), section, spacing);
  }
  return points;
}
} // namespace berm::sph
