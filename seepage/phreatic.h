// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/boundary.h"

#include <optional>
#include <span>
#include <vector>

/// The free surface, read off a pressure field. Internal to seepage/.
namespace berm::seepage
{
/// @brief The contour p = 0 through the triangles, as joined polylines.
/// A node is wet if p > 0, or if p = 0 and a neighbour has p > 0; the contour separates wet nodes
/// from the others. Along a wet seepage face, where p = 0 on the boundary itself, there is none: it
/// ends at the face's last wet node. Exact for a linear field.
/// @param[in] p  Pressure head at the nodes [m], shape (n).
/// @return From left to right each, the longest first; a closed contour repeats its first point.
[[nodiscard]] std::vector<Polyline> zero_contours(const meshes::TriangleMesh& mesh,
                                                  std::span<const double> p);

/// @brief Where the seepage face ends: the lower of the ends of the longest contour that lie on a
/// potential seepage face, moved into the last wet edge.
/// The last wet node A carries the outflow that its shape function sees on the last wet edge BA. If
/// the outflow per length is that of B up to the exit, at a distance x of A's edge from B, then
/// Q_A = q_B l x^2 / 2, x <= 1 (docs/theory.md eq. (2.11)). If B is not on the face: x = 1/2. The
/// contours that end at A end at the exit point instead.
/// @param[in]     entering  Water that enters at each node [m2/s], shape (n).
/// @param[in,out] contours  As from zero_contours.
/// @return Nothing if no contour ends on a seepage face.
[[nodiscard]] std::optional<Vec2> find_exit(const meshes::TriangleMesh& mesh,
                                            const NodeConditions& conditions,
                                            std::span<const double> entering,
                                            std::vector<Polyline>& contours);
} // namespace berm::seepage
