// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mistakes.h"
#include "coupling/case.h"

#include <string>
#include <vector>

namespace berm::app
{
/// What the command line says about how to read a case.
struct ReadOptions
{
  std::vector<std::string> overrides; ///< of --set, "key=value"
  bool seepage_only = false;          ///< `berm seepage`: that stage, whatever the file asks for
};

/// @brief The bytes of a case file.
/// @throws IoError if it cannot be read, or is far too large for one.
[[nodiscard]] std::string read_case_text(const std::string& path);

/// @brief The case in a text, as `read_case`; `path` is what the messages call it.
/// @throws InputError with every mistake that was found.
[[nodiscard]] coupling::Case parse_case(const std::string& text, const std::string& path,
                                        const ReadOptions& options, KeyPlaces& places);

/// @brief Read and check a case file; SI and radians from here on.
/// @param[in]  path    The file; "cases/dam.toml".
/// @param[out] places  Place of every key, for the messages of this and of later stages.
/// @throws InputError with every mistake that was found; IoError if the file cannot be read.
[[nodiscard]] coupling::Case read_case(const std::string& path, const ReadOptions& options,
                                       KeyPlaces& places);
} // namespace berm::app
