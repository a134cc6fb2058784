// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <filesystem>
#include <string>
#include <vector>

namespace berm::app
{
/// A text file of a run, its path relative to the run's directory.
struct TextFile
{
  std::filesystem::path path;
  std::string text;
};

/// Folder of the lines' files; every CSV file in it is berm's.
inline constexpr const char* lines_folder = "lines";

/// @brief Path of a line's file: "lines/crest.csv".
[[nodiscard]] std::filesystem::path line_path(const coupling::OutputLine& line);

/// @brief What is read of the seepage solution as CSV: docs/output_format.md. Numbers have nine
/// digits. Empty without a seepage solve.
/// @throws NumericalError naming file, column and row of the first value that is not finite.
[[nodiscard]] std::vector<TextFile> reading_files(const coupling::Case& input,
                                                  const coupling::Analysis& analysis);
} // namespace berm::app
