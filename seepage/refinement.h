// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"
#include "seepage/strategies.h"

#include <cstddef>
#include <vector>

/// The next mesh of an adaptive solve. Internal to seepage/.
namespace berm::seepage
{
/// A mesh, and the solution before on it: the first nodes are those of the mesh before.
struct NextMesh
{
  meshes::TriangleMesh mesh;
  CoarserField coarser;
};

/// Share of the indicators' sum that is expected to be left on the next mesh.
inline constexpr double indicator_share_left = 0.25;

/// @brief Cut the triangles with the largest indicators, again and again, until the sum is to be
/// expected to have fallen to indicator_share_left, docs/theory.md eq. (2.16).
/// @param[in] indicator  Of each triangle, shape (m).
/// @param[in] solution   On the mesh.
/// @param[in] most       No cut begins once the mesh has so many nodes.
[[nodiscard]] NextMesh next_mesh(meshes::TriangleMesh mesh, std::vector<double> indicator,
                                 CoarserField solution, std::size_t most);
} // namespace berm::seepage
