// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "meshes/triangle_mesh.h"

#include <cstdint>
#include <vector>

/// Where particles are put before they are relaxed: about one for every dx^2, inside the section
/// and not on its outline.
namespace berm::sph
{
/// @brief Square lattice of width dx, fitted to the ends of the section.
[[nodiscard]] std::vector<Vec2> square_seeds(const meshes::Section& section, double spacing);

/// @brief Hexagonal lattice with level rows and dx^2 per point.
[[nodiscard]] std::vector<Vec2> hexagonal_seeds(const meshes::Section& section, double spacing);

/// @brief The nodes of a triangle mesh that are not on its boundary.
/// An edge length of mesh_size(dx) gives one node for every dx^2.
[[nodiscard]] std::vector<Vec2> mesh_seeds(const meshes::TriangleMesh& mesh);

/// @brief Edge length of equilateral triangles with one node for every dx^2 [m].
[[nodiscard]] double mesh_size(double spacing);

/// @brief Move each point by a random vector, uniform in a square; those that would leave stay.
/// For studies of disorder. The same seed gives the same points on every machine.
/// @param[in] width  Of the square [m], >= 0.
[[nodiscard]] std::vector<Vec2> jittered(const meshes::Section& section, std::vector<Vec2> points,
                                         double width, std::uint64_t seed);
} // namespace berm::sph
