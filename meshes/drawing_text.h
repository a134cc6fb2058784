// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/gmsh_drawing.h"

#include <string>

namespace berm::meshes
{
/// @brief A drawing as text, and the same drawing from it, to the last bit: how it comes out of the
/// process that read it.
[[nodiscard]] std::string drawing_text(const GmshDrawing& drawing);
[[nodiscard]] GmshDrawing drawing_from(const std::string& text);
} // namespace berm::meshes
