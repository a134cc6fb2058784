// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

#include <filesystem>

namespace berm::app
{
/// @brief What the report page shows of a directory that `berm run`, `berm seepage`,
/// `berm compare` or `berm study` wrote: `kind` ("run", "comparison" or "study"), the JSON files as
/// they are, the fields packed (app/packed_array.h); of a study also its reference points, as text,
/// and its members' phreatic lines (app/study_lines.h).
/// @throws InputError if the directory is missing or holds neither kind of result, or one that
/// cannot be read; IoError if a file beside it cannot be read.
[[nodiscard]] Json report_data(const std::filesystem::path& directory);

/// @brief The same of a directory that may come from anywhere: read in a sandbox
/// (core/sandbox.h), so that broken files end in a message. Call it before threads are started.
/// @throws as report_data; InputError also where reading crashes or does not end.
[[nodiscard]] Json foreign_report_data(const std::filesystem::path& directory);
} // namespace berm::app
