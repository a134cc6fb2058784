// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace berm::app
{
/// @brief All of a file, byte for byte; nothing if it cannot be read.
[[nodiscard]] std::optional<std::string> text_of(const std::filesystem::path& path);

/// @brief The last part of a path that a file of results names; never one that leads up. Beside a
/// directory it is read from there: a result names nothing outside.
[[nodiscard]] std::filesystem::path name_inside(const std::string& path);
} // namespace berm::app
