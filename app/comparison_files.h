// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"
#include "coupling/comparison.h"

#include <filesystem>
#include <string>

namespace berm::app
{
/// @brief The contract for scripts: docs/output_format.md, comparison.json.
[[nodiscard]] Json comparison_json(const coupling::Comparison& comparison);

/// @brief Write comparison.json aside, then rename it.
/// @throws NumericalError if a value is not finite (nothing is replaced then); IoError.
void write_comparison(const std::filesystem::path& directory,
                      const coupling::Comparison& comparison);

/// @brief The waters side by side, as aligned text for a terminal.
[[nodiscard]] std::string comparison_report(const coupling::Comparison& comparison);
} // namespace berm::app
