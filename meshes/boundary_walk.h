// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace berm::meshes
{
/// @brief Rows of mesh.boundary one after the other, counter-clockwise from row 0.
/// Pre: the boundary is one closed line that meets itself nowhere.
[[nodiscard]] std::vector<std::size_t> edges_along(const meshes::TriangleMesh& mesh);
} // namespace berm::meshes
