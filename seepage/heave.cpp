// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/heave.h"

#include "core/tensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double least_gradient = 1e-6; ///< below, water flows up by rounding only

/// The part of a column in one triangle; head and pressure are linear in it.
struct Segment
{
  double top = 0, bottom = 0;           ///< [m]
  double head_top = 0, head_bottom = 0; ///< [m]
  Index soil = 0;
};

struct Column
{
  Vec2 at{0, 0};
  double head = 0; ///< at the top [m]
  std::vector<Segment> segments;
};

/// Where a vertical line cuts a triangle: nothing if it only touches a corner.
std::optional<Segment> cut(const Solution& solution, std::size_t t, double x)
{
  Segment segment{.top = -std::numeric_limits<double>::infinity(),
                  .bottom = std::numeric_limits<double>::infinity()};
  const auto add = [&](double y, double head)
  {
    if (y > segment.top)
      std::tie(segment.top, segment.head_top) = std::pair{y, head};
    if (y < segment.bottom)
      std::tie(segment.bottom, segment.head_bottom) = std::pair{y, head};
  };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto i = static_cast<std::size_t>(solution.mesh.triangles[t][k]),
               j = static_cast<std::size_t>(solution.mesh.triangles[t][(k + 1) % 3]);
    const Vec2 &a = solution.mesh.nodes[i], &b = solution.mesh.nodes[j];
    if (a.x() == x)
      add(a.y(), solution.head[i]);
    if ((a.x() < x && b.x() > x) || (a.x() > x && b.x() < x))
    {
      const double s = (x - a.x()) / (b.x() - a.x());
      add(a.y() + s * (b.y() - a.y()),
          solution.head[i] + s * (solution.head[j] - solution.head[i]));
    }
  }
  segment.soil = solution.mesh.triangle_soil[t];
  return segment.top > segment.bottom ? std::optional(segment) : std::nullopt;
}

/// @param[in,out] columns  Sorted by x; gain their segments.
void cut_columns(const Solution& solution, std::vector<Column>& columns)
{
  for (std::size_t t = 0; t < solution.mesh.triangles.size(); ++t)
  {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (const Index i : solution.mesh.triangles[t])
    {
      left = std::min(left, solution.mesh.nodes[static_cast<std::size_t>(i)].x());
      right = std::max(right, solution.mesh.nodes[static_cast<std::size_t>(i)].x());
    }
    auto column =
        std::ranges::lower_bound(columns, left, {}, [](const Column& c) { return c.at.x(); });
    for (; column != columns.end() && column->at.x() <= right; ++column)
      if (const auto segment = cut(solution, t, column->at.x()))
        column->segments.push_back(*segment);
  }
}

/// docs/theory.md eq. (2.25). In a triangle weight and excess head are linear in depth and their
/// ratio is monotonic: the least one is at an end of a segment.
void descend(Column& column, std::span<const double> buoyant_weight, double tolerance, Heave& heave)
{
  std::ranges::stable_sort(column.segments, std::ranges::greater{}, &Segment::top);
  double y = column.at.y(), head = column.head, weight = 0;
  for (std::size_t k = 0; k < column.segments.size(); ++k)
  {
    // A column along an edge is cut from the triangles on both sides; what lies above an overhang
    // does not belong to it.
    if (column.segments[k].bottom > y - tolerance)
      continue;
    if (column.segments[k].top < y - tolerance) // a gap
      return;
    // Along a wall the sides differ in head: the column goes on where it began.
    const Segment* next = &column.segments[k];
    for (std::size_t other = k + 1;
         other < column.segments.size() && column.segments[other].top > next->top - tolerance;
         ++other)
      if (const Segment& s = column.segments[other];
          s.bottom <= y - tolerance &&
          std::abs(s.head_top - head) < std::abs(next->head_top - head))
        next = &s;
    const Segment& s = *next;
    if (s.head_bottom < s.bottom)
      return;
    head = s.head_bottom;
    weight += buoyant_weight[static_cast<std::size_t>(s.soil)] * (y - s.bottom);
    y = s.bottom;
    const double depth = column.at.y() - y, excess = s.head_bottom - column.head;
    if (excess <= least_gradient * depth)
      continue;
    const double factor = weight / (water_unit_weight * excess);
    if (!heave.column || factor < heave.column->factor)
      heave.column = {.factor = factor, .depth = depth, .excess_head = excess, .at = column.at};
  }
}
} // namespace

std::optional<double> Heave::factor() const
{
  if (surface && column)
    return std::min(surface->factor, column->factor);
  if (surface)
    return surface->factor;
  return column ? std::optional(column->factor) : std::nullopt;
}

Heave heave(const Solution& solution, std::span<const Outlet> outlets,
            std::span<const double> buoyant_weight)
{
  Heave result;
  std::vector<Column> columns;
  for (const Outlet& outlet : outlets)
    for (const ExitPoint& point : outlet.points)
    {
      if (!point.faces_up || point.beside_singularity)
        continue;
      columns.push_back({.at = point.at, .head = point.head, .segments = {}});
      if (point.upward <= least_gradient)
        continue;
      const double critical =
          buoyant_weight[static_cast<std::size_t>(point.soil)] / water_unit_weight;
      const double factor = critical / point.upward; // eq. (2.24)
      if (!result.surface || factor < result.surface->factor)
        result.surface = {factor, point.upward, critical, point.at};
    }
  std::ranges::stable_sort(columns, {}, [](const Column& c) { return c.at.x(); });
  cut_columns(solution, columns);
  double size = 0;
  for (const Vec2& x : solution.mesh.nodes)
    size = std::max(size, x.cwiseAbs().maxCoeff());
  for (Column& column : columns)
    descend(column, buoyant_weight, 1e-9 * size, result);
  return result;
}
} // namespace berm::seepage
