// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/boundary.h"

#include <span>

/// Whether a discrete field can be one of water. Internal to seepage/.
namespace berm::seepage
{
/// @brief How far heads leave the range that the boundary allows them, docs/theory.md eq. (2.52),
/// over that range [-]; 0 inside. A range of nothing but rounding counts as the height of the mesh.
/// @param[in] p  Pressure head [m], shape (n).
[[nodiscard]] double head_excess(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                                 std::span<const double> p);
} // namespace berm::seepage
