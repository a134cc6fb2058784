// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "core/tensor.h"

#include <string>
#include <vector>

/// Checks of what the user drew, one polyline at a time.
namespace berm::meshes
{
/// A point, or an edge, as messages show it.
[[nodiscard]] std::string text(const Vec2& p);
[[nodiscard]] std::string text(const Vec2& a, const Vec2& b);

/// Larger side of the bounding box [m].
[[nodiscard]] double extent(const Polyline& points);

/// @brief Number of points, finite numbers, repeated points.
/// @return Whether the polyline can be worked with.
[[nodiscard]] bool check_points(const std::string& key, const Polyline& points, bool closed,
                                std::vector<Mistake>& mistakes);

/// @brief Edges that cross, touch or run back on themselves.
void check_simple(const std::string& key, const Polyline& points, bool closed,
                  std::vector<Mistake>& mistakes);

/// @brief x must not fall.
void check_left_to_right(const std::string& key, const Polyline& points,
                         std::vector<Mistake>& mistakes);

/// The polygon without a last point that repeats the first.
[[nodiscard]] Polyline opened(Polyline polygon);

[[nodiscard]] Polyline counter_clockwise(Polyline polygon);

/// Highest or lowest level of a chain that runs from left to right, at x, which is clamped to it
/// [m].
[[nodiscard]] double level_of(const Polyline& chain, double x, bool highest);
} // namespace berm::meshes
