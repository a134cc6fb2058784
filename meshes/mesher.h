// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "meshes/triangle_mesh.h"

namespace berm::meshes
{
/// @brief Triangulate the section with gmsh, in process, conforming to its outline and zone
/// borders. Every outline vertex and every zone corner that no later zone covers becomes a node;
/// each outer edge knows its stretch. Along inner lines the mesh is cut open (meshes/slit.h): nodes
/// there lie twice at one place, and both sides are rows of the boundary. Where parts of the
/// drawing come close to each other (thin zones, short edges) the triangles are finer than asked
/// for, down to a tenth. From about 12 000 nodes on, gmsh meshes more coarsely and edges are halved
/// once or twice: the shapes stay, the time drops tenfold. Deterministic, serial. The only user of
/// gmsh; starts it and shuts it down on every call, silently; gmsh leaves LC_NUMERIC at "C".
/// @param[in] edge_length  Wanted [m], > 0.
/// @throws InputError for an edge length that is not positive; NotConverged if gmsh fails or its
/// mesh
///         does not cover the section to 1e-9, with the reason.
[[nodiscard]] TriangleMesh triangulate(const Section& section, double edge_length);
} // namespace berm::meshes
