// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/triangle_locator.h"

#include "meshes/planar.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::meshes
{
namespace
{
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
  const Vec2 extent = upper - lower_;
  bin_size_ = std::sqrt(extent.x() * extent.y() / static_cast<double>(mesh.triangles.size()));
  nx_ = static_cast<Index>(extent.x() / bin_size_) + 1;
  ny_ = static_cast<Index>(extent.y() / bin_size_) + 1;

  // Count, scan, place.
  const auto for_bins_of = [&](Index t, auto&& visit)
  {
    const std::array<Vec2, 3> c = corners(mesh_, t);
    const auto low = bin_at(c[0].cwiseMin(c[1]).cwiseMin(c[2]));
    const auto high = bin_at(c[0].cwiseMax(c[1]).cwiseMax(c[2]));
    for (Index bx = low[0]; bx <= high[0]; ++bx)
      for (Index by = low[1]; by <= high[1]; ++by)
        visit(static_cast<std::size_t>(bx * ny_ + by));
  };
  const auto m = static_cast<Index>(mesh.triangles.size());
  start_.assign(static_cast<std::size_t>(nx_ * ny_) + 1, 0);
  for (Index t = 0; t < m; ++t)
    for_bins_of(t, [&](std::size_t bin) { ++start_[bin + 1]; });
  for (std::size_t bin = 1; bin < start_.size(); ++bin)
    start_[bin] += start_[bin - 1];
  triangle_.resize(static_cast<std::size_t>(start_.back()));
  std::vector<Index> next(start_.begin(), start_.end() - 1);
  for (Index t = 0; t < m; ++t)
    for_bins_of(t, [&](std::size_t bin) { triangle_[static_cast<std::size_t>(next[bin]++)] = t; });
}

std::array<Index, 2> TriangleLocator::bin_at(const Vec2& point) const
{
  const Vec2 scaled = (point - lower_) / bin_size_;
  const auto clamp = [](double value, Index n)
  { return static_cast<Index>(std::clamp(std::floor(value), 0.0, static_cast<double>(n - 1))); };
  return {clamp(scaled.x(), nx_), clamp(scaled.y(), ny_)};
}

std::span<const Index> TriangleLocator::triangles_in(Index bx, Index by) const
{
  const auto bin = static_cast<std::size_t>(bx * ny_ + by);
  return {triangle_.data() + start_[bin], triangle_.data() + start_[bin + 1]};
}

TriangleLocator::Location TriangleLocator::locate(const Vec2& point, double max_shift) const
{
  const auto [px, py] = bin_at(point);
  for (const Index t : triangles_in(px, py))
  {
    const std::array<double, 3> w = barycentric(corners(mesh_, t), point);
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0)
      return {.triangle = t, .weight = w, .shift = 0};
  }

  // Outside: the nearest point of all triangles in the bins that max_shift can reach.
  Location best;
  best.shift = max_shift;
  const Vec2 reach{max_shift, max_shift};
  const auto low = bin_at(point - reach), high = bin_at(point + reach);
  for (Index bx = low[0]; bx <= high[0]; ++bx)
    for (Index by = low[1]; by <= high[1]; ++by)
      for (const Index t : triangles_in(bx, by))
      {
        const Location near = nearest_on_rim(corners(mesh_, t), point, t);
        if (near.shift <= best.shift)
          best = near;
      }
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
