// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"

#include <vector>

namespace berm::sph
{
/// @brief Fit points to the outline of the section: Lloyd's iteration.
/// In every pass each point goes to the centroid of its Voronoi cell, cut off at the outline, by a
/// fifth of the spacing at most; it stays where it is if that would take it outside. The cells
/// become even and round, at the surface and in corners as inside: docs/theory.md section 3,
/// packing. No walls or ghosts are needed: the outline itself holds the points half a spacing off.
/// Cost: some 5 us a point and pass. The result does not depend on the thread count.
/// @param[in] points   Inside the section, no two in the same place [m].
/// @param[in] spacing  dx: about the root of the area per point [m], > 0.
/// @param[in] passes   About 10 fit a lattice; 50 make even random points useful.
[[nodiscard]] std::vector<Vec2> relax(const meshes::Section& section, std::vector<Vec2> points,
                                      double spacing, int passes);

/// @brief Move relaxed points against the force that a constant stress leaves on them.
/// Lloyd's iteration ends in grains of hexagons whose borders keep a residual, and rows on the base
/// that shear too easily. Points deeper than 2 h under the ground follow
/// x_i -= 0.2 h^2 sum_j V_j grad W_ij - 0.1 (c_i - x_i), docs/theory.md eq. (3.11), with V and c
/// the areas and centroids of the cells, and images of the points behind base and sides, as the
/// soil has them (sph/walls.h); those nearer to the ground, where the sum is cut off, go on to
/// their centroids as in relax(). Cost as relax().
/// @param[in] points  Relaxed, as from relax(): two points in a pair would stay one.
[[nodiscard]] std::vector<Vec2> unload(const meshes::Section& section, std::vector<Vec2> points,
                                       double spacing, int passes);
} // namespace berm::sph
