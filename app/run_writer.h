// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <filesystem>
#include <span>
#include <string>

namespace berm::app
{
/// @brief Where results go unless --out says otherwise: results/<case's folder>_<case's name>.
[[nodiscard]] std::filesystem::path default_directory(const std::string& case_path);

/// @brief Make the directory and see that files can be written there: better now than after the
/// run.
/// @throws IoError if not.
void prepare_directory(const std::filesystem::path& directory);

/// @brief Write a text file aside, then rename it.
/// @throws IoError if it cannot be written.
void write_aside(const std::filesystem::path& path, const std::string& text);

/// @brief Write case.toml, results.h5, its XDMF companions, the readings as CSV and, last,
/// result.json.
/// Each is written aside and then renamed; files of an earlier run that this run has no match for
/// are removed, other files stay as they are.
/// @param[in] warnings  What was warned of on the way, for result.json.
/// @param[in] frames    Folder with the frames of its run-out, as FrameFiles left them.
/// @throws NumericalError if a value is not finite (nothing is replaced then); IoError.
void write_run(const std::filesystem::path& directory, const coupling::Case& input,
               const coupling::Analysis& analysis, std::span<const std::string> warnings = {},
               const std::filesystem::path& frames = {});
} // namespace berm::app
