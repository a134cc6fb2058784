// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace berm::app
{
/// @brief The program's version, e.g. "0.1.0".
[[nodiscard]] std::string version();

/// @brief The commit that was built, as `git describe` calls it; empty if that is unknown.
[[nodiscard]] std::string commit();

/// @brief Version, commit, compiler and libraries, a line each: what a bug report needs.
[[nodiscard]] std::string version_text();

/// @brief Whether the seepage stage is a part of this build.
[[nodiscard]] bool seepage_built_in();
} // namespace berm::app
