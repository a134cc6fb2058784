// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/triangle_locator.h"

#include "meshes/planar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace berm::meshes
{
namespace
{
// Of the tree: a leaf holds at most so many triangles, unless it lies so deep, or splitting it
// would make more than so many times as many.
constexpr std::size_t few = 8;
constexpr int deepest = 30;
constexpr double worth_it = 2.5;

/// Quarter q of a square: 1 to the right, 2 above.
Box quarter(const Vec2& lower, double size, int q)
{
  const Vec2 corner = lower + size / 2 * Vec2(q % 2, q / 2);
  return {corner, corner + Vec2(size / 2, size / 2)};
}

std::array<Vec2, 3> corners(const TriangleMesh& mesh, Index t)
{
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(t)];
  return {mesh.nodes[static_cast<std::size_t>(nodes[0])],
          mesh.nodes[static_cast<std::size_t>(nodes[1])],
          mesh.nodes[static_cast<std::size_t>(nodes[2])]};
}

std::array<double, 3> barycentric(const std::array<Vec2, 3>& c, const Vec2& p)
{
  const double area = cross(c[1] - c[0], c[2] - c[0]);
  const double w1 = cross(p - c[0], c[2] - c[0]) / area;
  const double w2 = cross(c[1] - c[0], p - c[0]) / area;
  return {1 - w1 - w2, w1, w2};
}

/// The point of a triangle's rim nearest to p, as weights and distance.
TriangleLocator::Location nearest_on_rim(const std::array<Vec2, 3>& c, const Vec2& p, Index t)
{
  TriangleLocator::Location best;
  best.shift = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t b = (a + 1) % 3;
    const Vec2 edge = c[b] - c[a];
    const double s = std::clamp((p - c[a]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const double distance = (p - c[a] - s * edge).norm();
    if (distance < best.shift)
    {
      best = {.triangle = t, .weight = {}, .shift = distance};
      best.weight[a] = 1 - s;
      best.weight[b] = s;
    }
  }
  return best;
}
} // namespace

TriangleLocator::TriangleLocator(const TriangleMesh& mesh) : mesh_(mesh)
{
  Vec2 upper = mesh.nodes.front();
  lower_ = upper;
  for (const Vec2& node : mesh.nodes)
  {
    lower_ = lower_.cwiseMin(node);
    upper = upper.cwiseMax(node);
  }
  size_ = (upper - lower_).maxCoeff();
  box_.reserve(mesh.triangles.size());
  Cell root;
  for (Index t = 0; t < static_cast<Index>(mesh.triangles.size()); ++t)
  {
    const std::array<Vec2, 3> c = corners(mesh_, t);
    box_.push_back({c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])});
    root.triangle.push_back(t);
  }
  cells_.push_back(std::move(root));
  split(0, lower_, size_, 0);
}

void TriangleLocator::split(Index cell, const Vec2& lower, double size, int depth)
{
  const std::vector<Index> all = std::move(cells_[static_cast<std::size_t>(cell)].triangle);
  std::array<Cell, 4> quarters;
  std::size_t sum = 0;
  if (all.size() > few && depth < deepest)
    for (int q = 0; q < 4; ++q)
    {
      const Box box = quarter(lower, size, q);
      for (const Index t : all)
        if (box_[static_cast<std::size_t>(t)].touches(box))
          quarters[static_cast<std::size_t>(q)].triangle.push_back(t);
      sum += quarters[static_cast<std::size_t>(q)].triangle.size();
    }
  if (sum == 0 || static_cast<double>(sum) > worth_it * static_cast<double>(all.size()))
  {
    cells_[static_cast<std::size_t>(cell)].triangle = all;
    return;
  }
  const auto first = static_cast<Index>(cells_.size());
  cells_[static_cast<std::size_t>(cell)].children = first;
  for (Cell& q : quarters)
    cells_.push_back(std::move(q));
  for (int q = 0; q < 4; ++q)
    split(first + q, quarter(lower, size, q).lower, size / 2, depth + 1);
}

const TriangleLocator::Cell& TriangleLocator::leaf_at(const Vec2& point) const
{
  const Cell* cell = &cells_.front();
  Vec2 lower = lower_;
  for (double half = size_ / 2; cell->children >= 0; half /= 2)
  {
    const int right = point.x() >= lower.x() + half ? 1 : 0;
    const int above = point.y() >= lower.y() + half ? 1 : 0;
    lower += half * Vec2(right, above);
    cell = &cells_[static_cast<std::size_t>(cell->children + right + 2 * above)];
  }
  return *cell;
}

void TriangleLocator::find_nearest(const Vec2& point, Index cell, const Vec2& lower, double size,
                                   Location& best) const
{
  const Cell& here = cells_[static_cast<std::size_t>(cell)];
  for (const Index t : here.triangle)
    if (box_[static_cast<std::size_t>(t)].distance(point) <= best.shift)
      if (const Location near = nearest_on_rim(corners(mesh_, t), point, t);
          near.shift < best.shift || (best.triangle < 0 && near.shift == best.shift))
        best = near;
  if (here.children < 0)
    return;
  std::array<std::pair<double, int>, 4> order; // the nearest quarter first: it rules others out
  for (int q = 0; q < 4; ++q)
    order[static_cast<std::size_t>(q)] = {quarter(lower, size, q).distance(point), q};
  std::ranges::sort(order);
  for (const auto& [distance, q] : order)
    if (distance <= best.shift)
      find_nearest(point, here.children + q, quarter(lower, size, q).lower, size / 2, best);
}

TriangleLocator::Location TriangleLocator::locate(const Vec2& point, double max_shift) const
{
  for (const Index t : leaf_at(point).triangle)
    if (box_[static_cast<std::size_t>(t)].touches({point, point}))
    {
      const std::array<double, 3> w = barycentric(corners(mesh_, t), point);
      if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0)
        return {.triangle = t, .weight = w, .shift = 0};
    }

  Location best; // outside
  best.shift = max_shift;
  find_nearest(point, 0, lower_, size_, best);
  return best;
}

double interpolated(const TriangleMesh& mesh, std::span<const double> nodal,
                    const TriangleLocator::Location& at)
{
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(at.triangle)];
  double value = 0;
  for (std::size_t a = 0; a < 3; ++a)
    value += at.weight[a] * nodal[static_cast<std::size_t>(nodes[a])];
  return value;
}
} // namespace berm::meshes
