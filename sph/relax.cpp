// SPDX-License-Identifier: GPL-2.0-or-later
#include "sph/relax.h"

#include "sph/voronoi.h"

namespace berm::sph
{
std::vector<Vec2> relax(const meshes::Section& section, std::vector<Vec2> points, double spacing,
                        int passes)
{
  const double longest = 0.2 * spacing;
  for (int pass = 0; pass < passes; ++pass)
  {
    const std::vector<VoronoiCell> cells = voronoi_cells(section, points, spacing);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      Vec2 step = cells[i].centroid - points[i];
      if (const double length = step.norm(); length > longest)
        step *= longest / length;
      if (meshes::polygon_contains(section.outline, points[i] + step))
        points[i] += step;
    }
  }
  return points;
}
} // namespace berm::sph
