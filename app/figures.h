// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace berm::app
{
/// @brief Draw seepage.png, lines.png, exit_gradient.png, slip.png, trials.png, curves.png and
/// those of a run-out beside the results (docs/plots/figures.py).
/// @param[in] formats  Of files, at least one: "png", "svg".
/// @return Empty if it went well; else one clause on why there are no figures.
[[nodiscard]] std::string draw_figures(const std::filesystem::path& directory,
                                       std::span<const std::string> formats);

/// @brief Draw comparison.png beside comparison.json (docs/plots/comparison.py). Returns likewise.
[[nodiscard]] std::string draw_comparison(const std::filesystem::path& directory,
                                          std::span<const std::string> formats);

/// @brief Draw the figures of a study beside study.json (docs/plots/study.py). Returns likewise.
[[nodiscard]] std::string draw_study(const std::filesystem::path& directory,
                                     std::span<const std::string> formats);
} // namespace berm::app
