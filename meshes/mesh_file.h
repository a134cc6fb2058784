// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/gmsh_drawing.h"

#include <filesystem>

namespace berm::meshes
{
/// @brief Read the drawing in a geometry (.geo) or mesh (.msh) of gmsh in the plane z = 0, in m:
/// the borders of its physical surfaces, and its physical curves. The elements themselves are not
/// kept. Curved borders come as the polygons of the mesh. Points that do nothing on a straight
/// border are left out. A .geo is a program; one with commands that reach outside (SystemCall,
/// Include, Save and the like) is refused unread, and gmsh reads in a sandbox (core/sandbox.h).
/// @throws InputError with key section.mesh_file: gmsh cannot read it, no or unnamed physical
/// surfaces, more than 100 MB, nodes beyond 1e5 m, a mesh not in the plane z = 0, surfaces that are
/// not one piece or leave a hole, a curve of several pieces. IoError if the file cannot be opened.
[[nodiscard]] GmshDrawing read_gmsh(const std::filesystem::path& path);
} // namespace berm::meshes
