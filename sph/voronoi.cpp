// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/voronoi.h"

#include "meshes/planar.h"
#include "sph/neighbours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace berm::sph
{
namespace
{
/// Keep the part of a polygon where normal . p <= bound (Sutherland-Hodgman). `spare` is
/// overwritten.
void cut(Polyline& polygon, const Vec2& normal, double bound, Polyline& spare)
{
  spare.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vec2 &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double out_a = normal.dot(a) - bound, out_b = normal.dot(b) - bound;
    if (out_a <= 0)
      spare.push_back(a);
    if ((out_a < 0 && out_b > 0) || (out_a > 0 && out_b < 0))
      spare.push_back(a + out_a / (out_a - out_b) * (b - a));
  }
  polygon.swap(spare);
}

double reach2(const Polyline& polygon, const Vec2& centre)
{
  double largest = 0;
  for (const Vec2& p : polygon)
    largest = std::max(largest, (p - centre).squaredNorm());
  return largest;
}

VoronoiCell measure(const Polyline& polygon, const Vec2& origin)
{
  VoronoiCell cell{.area = 0, .centroid = origin};
  Vec2 moment = Vec2::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vec2 a = polygon[k] - origin;
    const Vec2 b = polygon[k + 1 < polygon.size() ? k + 1 : 0] - origin;
    const double twice = a.x() * b.y() - a.y() * b.x();
    cell.area += 0.5 * twice;
    moment += twice / 6 * (a + b);
  }
  if (cell.area > 0)
    cell.centroid += moment / cell.area;
  return cell;
}

/// Cuts one cell after another, with its working space.
class Cutter
{
public:
  Cutter(const meshes::Section& section, std::span<const Vec2> points)
      : section_(section), points_(points),
        diagonal_(std::hypot(section.x_max - section.x_min, section.y_max - section.y_min))
  {
  }

  /// Cut a box by the bisectors with the candidates; then, if the cell may reach the outline, the
  /// section by the same bisectors.
  void cut_cell(std::size_t i, std::span<const Index> candidates)
  {
    const Vec2& p = points_[i];
    by_distance_.clear();
    for (const Index j : candidates)
      by_distance_.emplace_back((points_[static_cast<std::size_t>(j)] - p).squaredNorm(), j);
    std::sort(by_distance_.begin(), by_distance_.end());
    const double d = diagonal_;
    polygon_ = {p + Vec2{-d, -d}, p + Vec2{d, -d}, p + Vec2{d, d}, p + Vec2{-d, d}};
    std::size_t near = 0;
    for (; near < by_distance_.size(); ++near)
    {
      if (by_distance_[near].first > 4 * reach2(polygon_, p))
        break;
      cut_by_bisector(p, by_distance_[near].second);
    }
    const double edge = meshes::nearest_edge(section_.outline, p).distance;
    if (edge * edge >= reach2(polygon_, p))
      return;
    polygon_ = section_.outline;
    for (std::size_t k = 0; k < near && !polygon_.empty(); ++k)
      cut_by_bisector(p, by_distance_[k].second);
  }

  [[nodiscard]] const Polyline& cell() const { return polygon_; }

private:
  void cut_by_bisector(const Vec2& p, Index j)
  {
    const Vec2& q = points_[static_cast<std::size_t>(j)];
    cut(polygon_, q - p, 0.5 * (q - p).dot(q + p), spare_);
  }

  const meshes::Section& section_;
  std::span<const Vec2> points_;
  double diagonal_;
  std::vector<std::pair<double, Index>> by_distance_;
  Polyline polygon_, spare_;
};
} // namespace

std::vector<VoronoiCell> voronoi_cells(const meshes::Section& section, std::span<const Vec2> points,
                                       double spacing)
{
  const double near = 3.5 * spacing;
  const auto n = static_cast<Index>(points.size());
  std::vector<double> x, y;
  std::vector<Index> all;
  for (Index i = 0; i < n; ++i)
  {
    x.push_back(points[static_cast<std::size_t>(i)].x());
    y.push_back(points[static_cast<std::size_t>(i)].y());
    all.push_back(i);
  }
  const NeighbourList neighbours = find_neighbours(x, y, n, near);
  std::vector<VoronoiCell> cells(points.size());
#pragma omp parallel
  {
    Cutter cutter(section, points);
    std::vector<Index> others;
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i)
    {
      const auto ii = static_cast<std::size_t>(i);
      cutter.cut_cell(ii, neighbours.of(i));
      if (4 * reach2(cutter.cell(), points[ii]) > near * near) // the list may be too short
      {
        others = all;
        others.erase(others.begin() + i);
        cutter.cut_cell(ii, others);
      }
      cells[ii] = measure(cutter.cell(), points[ii]);
    }
  }
  return cells;
}
} // namespace berm::sph
