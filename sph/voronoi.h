// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"

#include <span>
#include <vector>

namespace berm::sph
{
/// The part of the section that lies nearer to a point than to any other.
struct VoronoiCell
{
  double area = 0;              ///< [m2]
  Vec2 centroid = Vec2::Zero(); ///< [m]; may lie outside the section where that is not convex
};

/// @brief Exact Voronoi cells of points, cut off at the outline: their areas sum to the section's.
/// Each cell is a box cut by the bisectors with the neighbours, nearest first, until those left are
/// too far to touch it; near the outline the section is cut by the same bisectors. Where an
/// overhang comes close to the soil below it, a cell may hold soil from across the gap. A point
/// whose cell lies outside the section has no area, and itself as centroid. The result does not
/// depend on the thread count.
/// @param[in] points   Inside the section, no two in the same place [m].
/// @param[in] spacing  About how far apart they are [m], > 0; decides the cost only.
[[nodiscard]] std::vector<VoronoiCell> voronoi_cells(const meshes::Section& section,
                                                     std::span<const Vec2> points, double spacing);
} // namespace berm::sph
