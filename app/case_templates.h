// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace berm::app
{
/// A commented case to begin with: a file of cases/templates.
struct CaseTemplate
{
  std::string_view name; ///< "dam_with_core"
  std::string_view text; ///< the file
};

[[nodiscard]] std::span<const CaseTemplate> case_templates();

/// @brief Write a template as NAME.toml, or as NAME if it ends so.
/// @param[in] kind  Name of the template, one of case_templates().
/// @return The path of the file.
/// @throws IoError if there is such a file already, or if it cannot be written.
[[nodiscard]] std::filesystem::path write_template(const std::string& name, std::string_view kind);
} // namespace berm::app
