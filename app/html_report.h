// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/result_json.h"

#include <filesystem>
#include <string>

namespace berm::app
{
/// @brief Whether the page's template is a part of this build (BERM_WITH_REPORT).
[[nodiscard]] bool report_built_in();

/// @brief The page on which `data` (app/report_data.h) is shown. It stands alone: its policy lets
/// it load nothing and run no script but its own, and no text of the data can be markup.
[[nodiscard]] std::string report_page(const Json& data);

/// @brief Write report.html into a directory of results; for a comparison, into those of its runs
/// as well.
/// @param[in] foreign  Whether the directory may come from anywhere (foreign_report_data).
/// @throws as report_data; IoError if it cannot be written, or if the build is without the page.
void write_report(const std::filesystem::path& directory, bool foreign = false);
} // namespace berm::app
