// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// The free surface, read off a pressure field. Internal to seepage/.
namespace berm::seepage
{
/// @brief The contour p = 0 through the triangles, as joined polylines.
/// Nodes with p >= 0 are wet; the contour separates them from the dry ones, so along an active
/// seepage face, where p = 0 up to the boundary, there is none: it ends at the face's last wet
/// node. Exact for a linear field. @param[in] p  Pressure head at the nodes [m], shape (n).
/// @return From left to right each, the longest first; a closed contour repeats its first point.
[[nodiscard]] std::vector<Polyline> zero_contours(const meshes::TriangleMesh& mesh,
                                                  std::span<const double> p);
} // namespace berm::seepage
