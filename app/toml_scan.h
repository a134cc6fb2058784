// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace berm::app
{
/// What stands in the way of handing a document to toml++; `problem` is empty if nothing does.
struct TomlObstacle
{
  std::string problem;
  int line = 0, column = 0; ///< from 1; columns in bytes
};

/// @brief Look for what toml++ 3.3 does not survive, outside of strings and comments:
/// keys of so many parts that taking the nested tables down overflows the stack (it bounds brackets
/// only), quotes where no text can begin, which it takes for a part of what stands before them, and
/// characters beyond ASCII, which are not TOML there and lead it to undefined behaviour.
[[nodiscard]] TomlObstacle find_obstacle(std::string_view text);
} // namespace berm::app
