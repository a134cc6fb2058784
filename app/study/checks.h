// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/study/files.h"

#include <string>
#include <vector>

namespace berm::app
{
/// Whether a study can be run, and what its case says about it as a whole.
struct CheckedMembers
{
  std::string mistakes; ///< every mistake of every member, each once, for the user; may be empty
  std::string title;    ///< of the case
  std::vector<std::string> figure_formats;
};

/// @brief Read and check the case of every member, and the file of reference points.
/// @throws IoError if a file cannot be read.
[[nodiscard]] CheckedMembers check_members(const Study& study, const std::string& reference);
} // namespace berm::app
