// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "meshes/outline.h"

#include <vector>

namespace berm::meshes
{
/// A marked line that runs through the soil.
struct MarkedInside
{
  Polyline points; ///< where it ends on the outline, that end is a vertex of the outline [m]
  Index marked_line = 0;
};

/// @brief Give the outline vertices at the marked lines' points and the edges along them their
/// kind. See build_section for which lines count as inner ones.
/// @param[in] usable  Which of them have points that can be worked with.
/// @return The inner lines.
[[nodiscard]] std::vector<MarkedInside> mark_lines(Boundary& b, const std::vector<Polyline>& lines,
                                                   const std::vector<bool>& usable,
                                                   std::vector<Mistake>& mistakes);
} // namespace berm::meshes
