// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "meshes/planar.h"
#include "meshes/section.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <vector>

namespace berm::meshes
{
/// The outline while it is being cut into stretches.
struct Boundary
{
  Polyline points;               ///< counter-clockwise, from the left end of the base
  std::vector<StretchKind> kind; ///< of the edge that starts at each point
  std::vector<Index> marked_line;
  Polyline ground, base; ///< left to right, as drawn
  bool single_valued = true;
  double size = 0; ///< larger extent [m]

  void add(const Vec2& point, StretchKind edge)
  {
    points.push_back(point);
    kind.push_back(edge);
    marked_line.push_back(-1);
  }

  /// A vertex at p: an existing one within `reach`, else a new one on the nearest edge.
  Vec2 vertex_at(const Vec2& p, double reach)
  {
    const auto nearest = std::min_element(points.begin(), points.end(),
                                          [&](const Vec2& a, const Vec2& b) {
                                            return (a - p).squaredNorm() < (b - p).squaredNorm();
                                          });
    if ((*nearest - p).norm() <= reach)
      return *nearest;
    const auto k = static_cast<std::ptrdiff_t>(nearest_edge(points, p).edge);
    points.insert(points.begin() + k + 1, p);
    kind.insert(kind.begin() + k, kind[static_cast<std::size_t>(k)]);
    marked_line.insert(marked_line.begin() + k, marked_line[static_cast<std::size_t>(k)]);
    return p;
  }

  [[nodiscard]] std::size_t index_of(const Vec2& vertex) const
  {
    const auto found = std::find(points.begin(), points.end(), vertex);
    assert(found != points.end());
    return static_cast<std::size_t>(found - points.begin());
  }
};

/// @brief The outline from ground and base, or from the outline as drawn.
/// @return Nothing if there were mistakes, which are added to the list.
[[nodiscard]] std::optional<Boundary> boundary_from_ground(const SectionInput& input,
                                                           std::vector<Mistake>& mistakes);
[[nodiscard]] std::optional<Boundary> boundary_from_outline(const SectionInput& input,
                                                            std::vector<Mistake>& mistakes);
} // namespace berm::meshes
