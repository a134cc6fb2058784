// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "meshes/outline.h"
#include "meshes/section.h"

#include <vector>

namespace berm::meshes
{
/// @brief Put the drawn zones into the section: healed onto the outline and onto earlier zones, and
/// the outline given vertices where their borders meet it.
/// @param[in] usable  Which of them are simple polygons.
void place_zones(Boundary& b, const std::vector<Zone>& drawn, const std::vector<bool>& usable,
                 Section& section, std::vector<Mistake>& mistakes);
} // namespace berm::meshes
