// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"

#include <optional>
#include <span>
#include <vector>

namespace berm::sph
{
/// Rigid walls of soil that moves far. The sides are as high as the soil comes.
struct MovingWalls
{
  Polyline base;                     ///< left to right, level beyond its ends; empty: none [m]
  std::optional<double> left, right; ///< x of the sides [m]
};

/// @brief Base of the section, and its sides where ground and base do not meet.
[[nodiscard]] MovingWalls moving_walls(const meshes::Section& section);

/// Line y = level + slope x under a particle.
struct BaseLine
{
  double level = 0; ///< [m]
  double slope = 0; ///< [-]

  [[nodiscard]] double at(double x) const { return level + slope * x; }
};
/// Pre: walls.base is not empty.
[[nodiscard]] BaseLine base_line(const MovingWalls& walls, double x);

/// Image of a particle whose place follows it: x' = x0 + sign_x x, y' = y0 + y_x x + sign_y y.
/// Conditions and signs as in sph/walls.h; docs/theory.md section 5.
struct MovingGhost
{
  Index source = 0;
  double x0 = 0, sign_x = 1;
  double y0 = 0, y_x = 0, sign_y = 1;
  double sign_vx = 1, sign_vy = 1;
  double sign_sxy = 1, sign_Bxy = 1;

  [[nodiscard]] double x(double x_source) const { return x0 + sign_x * x_source; }
  [[nodiscard]] double y(double x_source, double y_source) const
  {
    return y0 + y_x * x_source + sign_y * y_source;
  }
};

/// @brief Images of every particle within `reach` of a wall, ordered by source.
[[nodiscard]] std::vector<MovingGhost> moving_ghosts(const MovingWalls& walls,
                                                     std::span<const double> x,
                                                     std::span<const double> y, double reach);
} // namespace berm::sph
