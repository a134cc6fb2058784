// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace berm::meshes
{
/// A mesh and where its new nodes come from.
struct RefinedMesh
{
  /// The nodes of the mesh before keep their numbers; new ones follow.
  TriangleMesh mesh;
  /// The two nodes that each new node lies midway between, shape (new, 2).
  std::vector<std::array<Index, 2>> parents;
  std::vector<Index> origin; ///< the triangle that each one is a part of, shape (new m)
};

/// @brief Cut the marked triangles into four of the same shape, and as many of the others as it
/// takes to keep the mesh conforming.
/// A triangle with a cut side has its longest side cut, too, and is halved from there to the
/// opposite corner (the partition of Rivara 1984, Plaza and Carey 2000): however often a mesh is
/// refined, its smallest angle does not fall below half of what it was. Two triangles share a side
/// if they share both its nodes, so that the two sides of a slit are cut apart from each other.
/// Soils and stretches are inherited. Cost O(m log m).
/// @param[in] marked  Nonzero where the triangle is to be cut, shape (m).
[[nodiscard]] RefinedMesh refined(const TriangleMesh& mesh, std::span<const std::uint8_t> marked);

/// @brief The nodal field on the refined mesh: linear on the mesh before, hence exact.
/// @param[in,out] nodal  Shape (n), then (n + new).
void prolong(const RefinedMesh& refined, std::vector<double>& nodal);
} // namespace berm::meshes
