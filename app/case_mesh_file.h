// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/case_check.h"
#include "app/toml_document.h"
#include "core/error.h"
#include "meshes/section.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// section.mesh_file of the case file.
namespace berm::app
{
/// @brief Outline and zones of the section from a file of gmsh; its surfaces are named after soils.
/// @param[in]     folder    Of the case file. A relative path may not lead out of it.
/// @param[in,out] mistakes  Gains what is wrong with the file, and names that are no soil's.
/// @return Its physical curves, by name.
std::map<std::string, Polyline> read_section(const std::string& file,
                                             const std::filesystem::path& folder,
                                             const std::vector<std::string>& soils,
                                             meshes::SectionInput& section,
                                             std::vector<Mistake>& mistakes);

/// @brief section.mesh_file of a case, if it has one whose path is relative.
[[nodiscard]] std::optional<std::filesystem::path> relative_mesh_file(const TomlValue& document);

/// @brief The same, of a case file's text; nothing if that is not TOML.
[[nodiscard]] std::optional<std::filesystem::path> relative_mesh_file(const std::string& case_text);
} // namespace berm::app
