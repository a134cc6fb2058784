// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace CLI
{
class App;
}

/// What can be said of a command line by looking at its own parser.
namespace berm::app
{
/// @brief A bash script that completes commands, options, their choices, keys of the case file
/// after --set and --vary, and files.
[[nodiscard]] std::string bash_completion(const CLI::App& app);

/// @brief The same for zsh, with descriptions; both the file of an autoloaded function and a script
/// to source.
[[nodiscard]] std::string zsh_completion(const CLI::App& app);

/// @brief The manual page berm(1), in man's macros.
[[nodiscard]] std::string man_page(const CLI::App& app);
} // namespace berm::app
