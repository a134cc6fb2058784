// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/first_mesh.h"

#include "meshes/planar.h"
#include "seepage/boundary.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace berm::seepage
{
namespace
{
// The smaller extent over so many, the drop of the water over so many, but the area not in more
// squares than this.
constexpr double elements_over_extent = 20, elements_over_drop = 12, largest_default_mesh = 4000;
constexpr int samples = 60; ///< of the soils, along each axis

/// Index of the soil that covers the largest part of the section, as far as samples tell.
std::size_t most_widespread_soil(const meshes::Section& section, std::size_t soils)
{
  std::vector<int> count(soils, 0);
  const Vec2 low(section.x_min, section.y_min);
  const Vec2 cell(Vec2(section.x_max, section.y_max) - low);
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j)
    {
      const Vec2 x = low + cell.cwiseProduct(Vec2(i + 0.5, j + 0.5)) / samples;
      if (const auto soil = static_cast<std::size_t>(meshes::soil_at(section, x));
          soil < soils && meshes::polygon_contains(section.outline, x))
        ++count[soil];
    }
  return static_cast<std::size_t>(std::ranges::max_element(count) - count.begin());
}

/// The line with a point where it crosses a level.
Polyline with_level(const Polyline& line, double level, double tolerance)
{
  Polyline result{line.front()};
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const Vec2 &a = line[k - 1], &b = line[k];
    if (std::min(a.y(), b.y()) < level - tolerance && std::max(a.y(), b.y()) > level + tolerance)
      result.emplace_back(a.x() + (level - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), level);
    result.push_back(b);
  }
  return result;
}

void map(Polyline& line, const Eigen::Matrix2d& m)
{
  for (Vec2& x : line)
    x = m * x;
}
} // namespace

Stretching::Stretching(const meshes::Section& section,
                       const std::vector<Conductivity>& conductivity)
{
  if (std::ranges::all_of(conductivity, [](const Conductivity& k) { return k.kx == k.ky; }))
    return;
  const Conductivity& k = conductivity[most_widespread_soil(section, conductivity.size())];
  const double ratio = k.ky / k.kx;
  if (ratio == 1 || !(ratio > 0) ||
      !std::isfinite(ratio)) // the solve names a conductivity that is none
    return;
  none_ = false;
  const double s = std::pow(ratio, 0.25);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(k.angle).toRotationMatrix();
  m_ = turn * Vec2(s, 1 / s).asDiagonal() * turn.transpose();
  inverse_ = turn * Vec2(1 / s, s).asDiagonal() * turn.transpose();
}

meshes::Section Stretching::stretched(meshes::Section section) const
{
  map(section.outline, m_);
  for (meshes::Zone& zone : section.zones)
    map(zone.polygon, m_);
  for (meshes::InnerLine& line : section.inner_lines)
    map(line.points, m_);
  map(section.ground, m_);
  map(section.base, m_);
  const auto [x_min, x_max] =
      std::ranges::minmax(section.outline, {}, [](const Vec2& p) { return p.x(); });
  const auto [y_min, y_max] =
      std::ranges::minmax(section.outline, {}, [](const Vec2& p) { return p.y(); });
  section.x_min = x_min.x();
  section.x_max = x_max.x();
  section.y_min = y_min.y();
  section.y_max = y_max.y();
  return section;
}

meshes::TriangleMesh Stretching::stretched(meshes::TriangleMesh mesh) const
{
  map(mesh.nodes, m_);
  return mesh;
}

meshes::TriangleMesh Stretching::unstretched(meshes::TriangleMesh mesh) const
{
  map(mesh.nodes, inverse_);
  return mesh;
}

meshes::Section with_head_levels(const meshes::Section& section,
                                 const std::vector<Boundary>& boundary)
{
  meshes::Section result = section;
  result.outline.clear();
  result.edge_stretch.clear();
  const double tolerance =
      1e-9 * std::max(section.x_max - section.x_min, section.y_max - section.y_min);
  for (std::size_t k = 0; k < section.outline.size(); ++k)
  {
    const Vec2 &a = section.outline[k],
               &b = section.outline[meshes::next(k, section.outline.size())];
    const Index stretch = section.edge_stretch[k];
    const Boundary& condition = boundary[static_cast<std::size_t>(stretch)];
    result.outline.push_back(a);
    result.edge_stretch.push_back(stretch);
    const double level = condition.value;
    if (condition.kind == BoundaryKind::head && std::min(a.y(), b.y()) < level - tolerance &&
        std::max(a.y(), b.y()) > level + tolerance)
    {
      result.outline.push_back(a + (level - a.y()) / (b.y() - a.y()) * (b - a));
      result.outline.back().y() = level;
      result.edge_stretch.push_back(stretch);
    }
  }
  for (meshes::InnerLine& line : result.inner_lines)
    if (const Boundary& condition = boundary[static_cast<std::size_t>(line.stretch)];
        condition.kind == BoundaryKind::head)
      line.points = with_level(line.points, condition.value, tolerance);
  return result;
}

double default_element_size(const meshes::Section& section, const std::vector<Boundary>& boundary,
                            const meshes::Section& stretched)
{
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  const auto see = [&](const Boundary& condition, const Vec2& a, const Vec2& b)
  {
    if (condition.kind == BoundaryKind::head)
    {
      highest = std::max(highest, condition.value);
      lowest = std::min(lowest, condition.value);
    }
    else if (may_hold_pressure(condition.kind))
      lowest = std::min({lowest, a.y(), b.y()});
  };
  for (std::size_t k = 0; k < section.outline.size(); ++k)
    see(boundary[static_cast<std::size_t>(section.edge_stretch[k])], section.outline[k],
        section.outline[meshes::next(k, section.outline.size())]);
  for (const meshes::InnerLine& line : section.inner_lines)
    for (std::size_t k = 1; k < line.points.size(); ++k)
      see(boundary[static_cast<std::size_t>(line.stretch)], line.points[k - 1], line.points[k]);
  const double by_extent =
      std::min(stretched.x_max - stretched.x_min, stretched.y_max - stretched.y_min) /
      elements_over_extent;
  const double by_drop = highest > lowest ? (highest - lowest) / elements_over_drop : by_extent;
  const double by_area = std::sqrt(meshes::polygon_area(section.outline) / largest_default_mesh);
  return std::max(std::min(by_extent, by_drop), by_area);
}
} // namespace berm::seepage
