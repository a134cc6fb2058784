// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace berm::meshes
{
/// @brief Rows of mesh.boundary, one closed line after the other, each in the direction of its
/// edges from its first row on; in the order of their first rows.
/// The outline and every inner line that begins on it are one line, a wall right through makes two,
/// and an inner line in the soil is one of its own.
[[nodiscard]] std::vector<std::vector<std::size_t>> boundary_loops(const TriangleMesh& mesh);

/// @brief Which piece of the mesh each node belongs to, from 0: walls right through the section cut
/// it into pieces that no water connects.
/// @return shape (n), numbered in the order of their first nodes.
[[nodiscard]] std::vector<std::size_t> pieces(const TriangleMesh& mesh);
} // namespace berm::meshes
