// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/case_check.h"
#include "core/error.h"
#include "coupling/case.h"
#include "meshes/section.h"

#include <string>
#include <string_view>
#include <vector>

/// [[output.line]] of the case file.
namespace berm::app
{
/// @brief The lines of the case, "line_1" and so on where they have no name.
/// @param[in,out] mistakes  Gains repeated points and names that are, as files, the same.
[[nodiscard]] std::vector<coupling::OutputLine> assemble_lines(const CheckedValues& values,
                                                               std::vector<Mistake>& mistakes);

/// @brief Points and stretches of line that lie outside the section.
void check_lines(const std::vector<coupling::OutputLine>& lines, const meshes::Section& section,
                 std::vector<Mistake>& mistakes);

/// @brief What a line's file is called, without ".csv": letters, digits, - and _ of the name, _ for
/// everything else, at most 64 of them. No name leads out of its folder.
[[nodiscard]] std::string file_name(std::string_view line_name);
} // namespace berm::app
