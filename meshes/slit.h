// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/triangle_mesh.h"

#include <array>
#include <vector>

namespace berm::meshes
{
/// An edge of the mesh that lies on an inner line.
struct SlitEdge
{
  std::array<Index, 2> nodes{}; ///< in either order
  Index stretch = 0;            ///< index into Section::stretches
};

/// @brief Cut the mesh open along edges inside it: docs/theory.md, inner lines.
/// The triangles around a node of the line fall into fans between the edges that are cut and the
/// boundary. The first fan keeps the node, every other one gets a copy of it: so a tip in the soil
/// stays one node, a point of the line becomes two, a crossing four, and an end on the outline two.
/// Both sides of every edge are appended to the boundary, the soil on their left.
/// Pre: the mesh is conforming, its triangles counter-clockwise; no connected set of edges is a
/// single edge between two tips, whose sides would have the same two nodes.
void cut_open(TriangleMesh& mesh, const std::vector<SlitEdge>& edges);
} // namespace berm::meshes
