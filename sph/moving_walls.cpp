// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/moving_walls.h"

namespace berm::sph
{
namespace
{
/// The image, in a vertical wall, of a particle or of its image in the base.
MovingGhost behind_side(MovingGhost g, double wall)
{
  g.x0 = 2 * wall - g.x0;
  g.sign_x = -g.sign_x;
  g.sign_vx = -g.sign_vx;
  g.sign_sxy = -g.sign_sxy;
  g.sign_Bxy = -g.sign_Bxy;
  return g;
}
} // namespace

MovingWalls moving_walls(const meshes::Section& section)
{
  MovingWalls walls{.base = section.base, .left = {}, .right = {}};
  if (section.left_side_top > section.base.front().y())
    walls.left = section.x_min;
  if (section.right_side_top > section.base.back().y())
    walls.right = section.x_max;
  return walls;
}

BaseLine base_line(const MovingWalls& walls, double x)
{
  const Polyline& base = walls.base;
  if (x <= base.front().x())
    return {.level = base.front().y()};
  for (std::size_t k = 1; k < base.size(); ++k)
    if (x < base[k].x())
    {
      const double slope = (base[k].y() - base[k - 1].y()) / (base[k].x() - base[k - 1].x());
      return {.level = base[k].y() - slope * base[k].x(), .slope = slope};
    }
  return {.level = base.back().y()};
}

std::vector<MovingGhost> moving_ghosts(const MovingWalls& walls, std::span<const double> x,
                                       std::span<const double> y, double reach)
{
  std::vector<MovingGhost> ghosts;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const MovingGhost self{.source = static_cast<Index>(i)};
    std::optional<MovingGhost> below;
    if (!walls.base.empty())
    {
      const BaseLine line = base_line(walls, x[i]);
      if (y[i] - line.at(x[i]) < reach)
      {
        below = self;
        below->y0 = 2 * line.level;
        below->y_x = 2 * line.slope;
        below->sign_y = below->sign_vx = below->sign_vy = below->sign_Bxy = -1;
        ghosts.push_back(*below);
      }
    }
    for (const auto& [wall, inward] : {std::pair{walls.left, 1.0}, std::pair{walls.right, -1.0}})
    {
      if (!wall || inward * (x[i] - *wall) >= reach)
        continue;
      ghosts.push_back(behind_side(self, *wall));
      if (below)
        ghosts.push_back(behind_side(*below, *wall));
    }
  }
  return ghosts;
}
} // namespace berm::sph
