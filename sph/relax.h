// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "meshes/section.h"

#include <vector>

namespace berm::sph
{
/// @brief Even out points inside the section, up to its outline: Lloyd's iteration.
/// In every pass each point goes to the centroid of its Voronoi cell, cut off at the outline, by a
/// fifth of the spacing at most; it stays where it is if that would take it outside. The cells
/// become even and round, at the surface and in corners as inside, and the residual force of a
/// constant stress falls: docs/theory.md section 3, packing. No walls or ghosts are needed: the
/// outline itself holds the points half a spacing off.
/// Cost: some 10 us a point and pass. The result does not depend on the thread count.
/// @param[in] points   Inside the section, no two in the same place [m].
/// @param[in] spacing  dx: about the root of the area per point [m], > 0.
/// @param[in] passes   50 even out any seeding; about 10 fit a lattice to the outline.
[[nodiscard]] std::vector<Vec2> relax(const meshes::Section& section, std::vector<Vec2> points,
                                      double spacing, int passes);
} // namespace berm::sph
