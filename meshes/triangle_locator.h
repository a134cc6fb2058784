// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/triangle_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace berm::meshes
{
/// An axis-parallel rectangle.
struct Box
{
  Vec2 lower{0, 0}, upper{0, 0}; ///< [m]

  [[nodiscard]] double distance(const Vec2& p) const
  {
    return (p - p.cwiseMax(lower).cwiseMin(upper)).norm();
  }
  [[nodiscard]] bool touches(const Box& other) const
  {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
};

/// Finds the triangle at a point through a quadtree: meshes are up to 1e4 times finer in one place
/// than in another. It never loses a point on the boundary.
class TriangleLocator
{
public:
  /// @param[in] mesh  Must outlive the locator. Cost O(m log m).
  explicit TriangleLocator(const TriangleMesh& mesh);

  /// Where a point lies: a triangle and barycentric weights, each in [0, 1], of sum 1.
  struct Location
  {
    Index triangle = -1;
    std::array<double, 3> weight{};
    double shift = 0; ///< distance by which the point was moved to the mesh; 0 inside [m]
  };

  /// @brief The triangle that holds the point, or the nearest point of the mesh if none does.
  /// Of several triangles that hold it the first. Farther than `max_shift` from the mesh the
  /// triangle is -1. Cost O(log m).
  [[nodiscard]] Location locate(const Vec2& point, double max_shift) const;

private:
  /// A square of the tree: four of half the size, or the triangles whose bounding boxes touch it.
  struct Cell
  {
    Index children = -1;         ///< the first of four, -1: none
    std::vector<Index> triangle; ///< ascending
  };

  void split(Index cell, const Vec2& lower, double size, int depth);
  [[nodiscard]] const Cell& leaf_at(const Vec2& point) const;
  void find_nearest(const Vec2& point, Index cell, const Vec2& lower, double size,
                    Location& best) const;

  const TriangleMesh& mesh_;
  std::vector<Box> box_; ///< of each triangle
  Vec2 lower_{0, 0};
  double size_ = 1;
  std::vector<Cell> cells_;
};

/// @brief The linear field with these values at the nodes, at a place.
/// @param[in] nodal  Shape (n).
/// Pre: at.triangle >= 0.
[[nodiscard]] double interpolated(const TriangleMesh& mesh, std::span<const double> nodal,
                                  const TriangleLocator::Location& at);
} // namespace berm::meshes
