// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace berm::meshes
{
/// The sides of all triangles of a mesh, each once, in the order of their nodes' numbers.
struct Sides
{
  std::vector<std::array<Index, 2>> ends;          ///< the smaller node first, shape (s)
  std::vector<std::array<std::size_t, 3>> of;      ///< side a of a triangle joins its corners a and
                                                   ///< a + 1, shape (m)
  std::vector<std::array<std::size_t, 2>> touches; ///< triangles at each; on the boundary twice the
                                                   ///< same, shape (s)

  /// Cost O(m log m).
  explicit Sides(const TriangleMesh& mesh);

  /// Which side joins these nodes. Pre: there is one. Cost O(log s).
  [[nodiscard]] std::size_t between(Index i, Index j) const;
};
} // namespace berm::meshes
