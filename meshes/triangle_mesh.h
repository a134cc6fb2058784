// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <array>
#include <cstdint>
#include <vector>

namespace berm::meshes
{
/// A triangulated section as plain arrays. Every node belongs to a triangle. Two nodes may
/// lie at one place: on the two sides of an inner line.
struct TriangleMesh
{
  std::vector<Vec2> nodes;                     ///< [m], shape (n)
  std::vector<std::array<Index, 3>> triangles; ///< nodes of each, counter-clockwise, shape (m)
  std::vector<Index> triangle_soil;            ///< soil index of each triangle, shape (m)
  std::vector<std::array<Index, 2>> boundary;  ///< edges with soil on one side only, on their left:
                                               ///< the outline, and both sides of every inner line,
                                               ///< shape (b)
  std::vector<Index> boundary_stretch;         ///< index into Section::stretches, shape (b)
};
} // namespace berm::meshes
