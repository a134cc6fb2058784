// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/head_bounds.h"

#include <algorithm>
#include <limits>

namespace berm::seepage
{
namespace
{
constexpr double least_range = 1e-6; ///< over the height of the mesh; less is rounding [-]

struct Range
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double length() const { return high - low; }
};
} // namespace

double head_excess(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                   std::span<const double> p)
{
  Range allowed, taken, height;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const double y = mesh.nodes[i].y(), head = p[i] + y;
    height.include(y);
    taken.include(head);
    if (conditions.kind[i] == NodeKind::head)
      allowed.include(conditions.pressure_head[i] + y);
    if (conditions.kind[i] == NodeKind::face) // water leaves there at h = y, and enters nowhere
      allowed.low = std::min(allowed.low, y);
    if (conditions.load[i] != 0) // its own head nothing bounds beforehand
      allowed.include(head);
  }
  const double excess = std::max({allowed.low - taken.low, taken.high - allowed.high, 0.0});
  const double range =
      allowed.length() > least_range * height.length() ? allowed.length() : height.length();
  return excess / range;
}
} // namespace berm::seepage
