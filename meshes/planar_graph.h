// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"

#include <cstddef>
#include <vector>

namespace berm::meshes
{
/// Part of a zone border or of an inner line.
struct InsideEdge
{
  std::size_t from = 0, to = 0; ///< indices into PlanarGraph::points
  Index stretch = -1;           ///< of the inner line; -1 for a zone border alone
};

/// What a mesh conforms to: edges that meet only at their ends. The outline's vertices are the
/// first points, in order.
struct PlanarGraph
{
  Polyline points;
  std::vector<InsideEdge> inside; ///< in the order of their points
};

/// @brief Zone borders that can be seen, and inner lines, cut wherever they meet each other or the
/// outline. A whole inner line has two edges at least. Zones that miss each other by less than 1e-5
/// of the section are joined: the edge bends to the vertex. O(edges^2).
[[nodiscard]] PlanarGraph planar_graph(const Section& section);
} // namespace berm::meshes
