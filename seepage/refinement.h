// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <cstddef>
#include <vector>

/// The next mesh of an adaptive solve. Internal to seepage/.
namespace berm::seepage
{
/// A mesh, and the pressure head of the solution before on it.
struct NextMesh
{
  meshes::TriangleMesh mesh;
  std::vector<double> p; ///< [m], shape (n); the first are those of the mesh before
};

/// Share of the indicators' sum that is expected to be left on the next mesh.
inline constexpr double indicator_share_left = 0.25;

/// @brief Cut the triangles with the largest indicators, again and again, until the sum is to be
/// expected to have fallen to indicator_share_left, docs/theory.md eq. (2.16).
/// @param[in] indicator  Of each triangle, shape (m).
/// @param[in] p          Pressure head [m], shape (n).
/// @param[in] most       No cut begins once the mesh has so many nodes.
[[nodiscard]] NextMesh next_mesh(meshes::TriangleMesh mesh, std::vector<double> indicator,
                                 std::vector<double> p, std::size_t most);
} // namespace berm::seepage
