// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <span>
#include <vector>

/// From one mesh to another. Internal to seepage/.
namespace berm::seepage
{
/// @brief Linear interpolation of a nodal field at points inside the mesh or on its boundary.
/// Walks from the triangle of one point to that of the next: fast if they follow each other in
/// space. A point outside takes the value extrapolated from the triangle that it is least outside
/// of.
[[nodiscard]] std::vector<double> transfer(const meshes::TriangleMesh& mesh,
                                           std::span<const double> nodal,
                                           std::span<const Vec2> points);
} // namespace berm::seepage
