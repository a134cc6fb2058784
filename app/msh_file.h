// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/case.h"
#include "meshes/section.h"
#include "meshes/triangle_mesh.h"

#include <string>

namespace berm::app
{
/// @brief The seepage mesh as text of gmsh's format 2.2: triangles in physical surfaces named after
/// soils, boundary edges in physical curves named after stretches. Coordinates in m, to the bit.
[[nodiscard]] std::string msh_text(const coupling::Case& input, const meshes::Section& section,
                                   const meshes::TriangleMesh& mesh);
} // namespace berm::app
