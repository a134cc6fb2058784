// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "meshes/triangle_mesh.h"

#include <vector>

namespace berm::meshes
{
/// How fine the triangles are: `fine` within `inner` of the polylines, `coarse` beyond `outer`,
/// linear between. Without polylines, `coarse` everywhere.
struct ElementSize
{
  double coarse = 0;           ///< edge length [m], > 0
  double fine = 0;             ///< edge length near the polylines [m]; 0 means as coarse
  double inner = 0, outer = 0; ///< distances [m]
  std::vector<Polyline> near;  ///< where to refine [m]
};

/// @brief Triangulate the section with gmsh, in process, conforming to its outline and zone
/// borders. Every outline vertex and zone corner becomes a node; each outer edge knows its stretch.
/// Deterministic. The only user of gmsh; starts it and shuts it down on every call, silently.
/// @throws InputError if the zones cannot be meshed; NotConverged if gmsh fails, with its message.
[[nodiscard]] TriangleMesh triangulate(const Section& section, const ElementSize& size);
} // namespace berm::meshes
