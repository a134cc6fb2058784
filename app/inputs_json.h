// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

namespace berm::app
{
/// @brief What a boundary on a stretch of the section is, in a case file's word.
[[nodiscard]] const char* kind_name(seepage::BoundaryKind kind);

/// @brief The case as understood, with the effect of --set: soils, zones, water, boundaries.
/// docs/output_format.md, `inputs`.
[[nodiscard]] Json inputs_json(const coupling::Case& input, const meshes::Section& section);
} // namespace berm::app
