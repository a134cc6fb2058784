// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/solution.h"

#include <algorithm>
#include <array>
#include <limits>

namespace berm::seepage
{
namespace
{
/// A point counts as inside a triangle if no barycentric coordinate is below minus this: rounding.
constexpr double inside_tolerance = 1e-12;

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}
} // namespace

std::optional<double> value_at(const Solution& solution, const std::vector<double>& nodal,
                               const Vec2& point, double max_shift)
{
  const meshes::TriangleMesh& mesh = solution.mesh;
  const auto node = [&](Index i) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(i)]; };
  const auto value = [&](Index i) { return nodal[static_cast<std::size_t>(i)]; };

  for (const auto& [i, j, k] : mesh.triangles)
  {
    const double area = cross(node(j) - node(i), node(k) - node(i));
    const double s_i = cross(node(j) - point, node(k) - point) / area;
    const double s_j = cross(node(k) - point, node(i) - point) / area;
    const double s_k = 1 - s_i - s_j;
    if (std::min({s_i, s_j, s_k}) >= -inside_tolerance)
      return s_i * value(i) + s_j * value(j) + s_k * value(k);
  }

  double nearest = std::numeric_limits<double>::infinity(), nearest_value = 0;
  for (const auto& [i, j] : mesh.boundary)
  {
    const Vec2 edge = node(j) - node(i);
    const double t = std::clamp((point - node(i)).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const double distance = (point - node(i) - t * edge).norm();
    if (distance < nearest)
    {
      nearest = distance;
      nearest_value = (1 - t) * value(i) + t * value(j);
    }
  }
  if (nearest <= max_shift)
    return nearest_value;
  return std::nullopt;
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
