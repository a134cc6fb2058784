// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/gmsh_drawing.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace berm::meshes
{
/// A physical group of a mesh: its elements, each as the tags of its corners, around.
struct MeshGroup
{
  std::string name;
  int tag = 0; ///< by which a group without a name is told
  std::vector<std::vector<std::size_t>> elements;
};

/// What a mesh of gmsh holds of a section.
struct MeshGroups
{
  std::map<std::size_t, Vec2> nodes; ///< by their tags; all finite [m]
  std::vector<MeshGroup> surfaces, curves;
};

/// @throws InputError with key section.mesh_file, always.
[[noreturn]] void refuse_mesh(std::string problem, std::string allowed, std::string hint);

/// @brief The borders of the surfaces and of all together, and the curves as lines.
/// Points that do nothing on a straight border are left out; curves without a name too.
/// @throws InputError without a value: no surface or one without a name, elements with nodes
/// that are not there, surfaces that overlap, are not one piece together or leave a hole, a curve
/// that is not one line.
[[nodiscard]] GmshDrawing drawing_of(const MeshGroups& groups);
} // namespace berm::meshes
