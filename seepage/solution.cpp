// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/solution.h"

#include "meshes/triangle_locator.h"

#include <algorithm>

namespace berm::seepage
{
std::optional<double> value_at(const Solution& solution, const std::vector<double>& nodal,
                               const Vec2& point, double max_shift)
{
  const auto at = meshes::TriangleLocator(solution.mesh).locate(point, max_shift);
  if (at.triangle < 0)
    return std::nullopt;
  return meshes::interpolated(solution.mesh, nodal, at);
}

std::optional<double> phreatic_level(const Solution& solution, double x)
{
  std::optional<double> level;
  for (const Polyline& line : solution.phreatic_lines)
    for (std::size_t k = 1; k < line.size(); ++k)
    {
      const Vec2 &a = line[k - 1], &b = line[k];
      if (x < std::min(a.x(), b.x()) || x > std::max(a.x(), b.x()))
        continue;
      const double y = a.x() == b.x() ? std::max(a.y(), b.y())
                                      : a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      level = std::max(level.value_or(y), y);
    }
  return level;
}
} // namespace berm::seepage
