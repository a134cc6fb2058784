// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/relax.h"

#include "meshes/planar.h"
#include "sph/kernel.h"
#include "sph/neighbours.h"
#include "sph/particles.h"
#include "sph/voronoi.h"
#include "sph/walls.h"

namespace berm::sph
{
namespace
{
/// Of the way to its centroid that an unloaded point goes in a pass: without it some end in pairs.
constexpr double apart = 0.1;

/// Move a point by a fifth of the spacing at most, unless it would leave the section.
void move(Vec2& point, Vec2 step, const meshes::Section& section, double spacing)
{
  const double longest = 0.2 * spacing;
  if (const double length = step.norm(); length > longest)
    step *= longest / length;
  if (meshes::polygon_contains(section.outline, point + step))
    point += step;
}

/// -0.2 h^2 sum_j V_j grad_i W_ij for every point, over points and their images behind walls [m]
std::vector<Vec2> shifts(const meshes::Section& section, const std::vector<Vec2>& points,
                         const std::vector<VoronoiCell>& cells, const CubicSpline& W)
{
  Particles all;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    all.x.push_back(points[i].x());
    all.y.push_back(points[i].y());
    all.volume.push_back(cells[i].area);
  }
  for (const Ghost& g : mirror_ghosts(all, section, W.radius()))
  {
    all.x.push_back(g.x);
    all.y.push_back(g.y);
    all.volume.push_back(cells[static_cast<std::size_t>(g.source)].area);
  }
  const NeighbourList near =
      find_neighbours(all.x, all.y, static_cast<Index>(points.size()), W.radius());
  const double gain = 0.2 * W.h * W.h;
  std::vector<Vec2> shift(points.size(), Vec2::Zero());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const Index k : near.of(static_cast<Index>(i)))
    {
      const auto j = static_cast<std::size_t>(k);
      const Vec2 r_ij = points[i] - Vec2{all.x[j], all.y[j]};
      const double r = r_ij.norm();
      shift[i] -= gain * all.volume[j] * W.dW(r) / r * r_ij;
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
    deep.push_back(meshes::distance(p, section.ground) >= W.radius());
  for (int pass = 0; pass < passes; ++pass)
  {
    const std::vector<VoronoiCell> cells = voronoi_cells(section, points, spacing);
    const std::vector<Vec2> shift = shifts(section, points, cells, W);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vec2 to_centroid = cells[i].centroid - points[i];
      move(points[i], deep[i] ? Vec2(shift[i] + apart * to_centroid) : to_centroid, section,
           spacing);
    }
  }
  return points;
}
} // namespace berm::sph
