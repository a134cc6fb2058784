// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "meshes/outline.h"
#include "meshes/section.h"

#include <vector>

namespace berm::meshes
{
/// @brief Give the ground under each pool, and under what runs over the crest, its kind, and the
/// outline vertices at the waterlines. See build_section for what covers what.
/// @param[out] section  Pool levels, overflow and warnings are set.
void flood(Boundary& b, const SectionInput& input, Section& section,
           std::vector<Mistake>& mistakes);
} // namespace berm::meshes
