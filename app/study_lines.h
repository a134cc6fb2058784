// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

#include <filesystem>

namespace berm::app
{
/// @brief The phreatic lines of a study's members on one section, for the report page.
/// Read from `directory`/members/NAME/result.json alone. A member without a discharge, whose file
/// is missing or odd, or whose lines an earlier one has, has no entry.
/// @param[in] study  study.json of `directory`.
/// @return `section`: that of the first member with lines, without what others have differently:
/// pools, inner lines; `members`: index in the study, `lines` with packed `x` and `y` [m]. Null if
/// no member has a line.
[[nodiscard]] Json study_lines(const std::filesystem::path& directory, const Json& study);
} // namespace berm::app
