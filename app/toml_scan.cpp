// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/toml_scan.h"

#include <algorithm>
#include <cstddef>

namespace berm::app
{
namespace
{
constexpr int most_parts = 8; // of a dotted key; the case file's deepest has three

/// End of a string that opens at `at`: just behind its closing quotes, or where a line ends it
/// wrongly.
std::size_t behind_string(std::string_view text, std::size_t at)
{
  const char quote = text[at];
  const bool escapes = quote == '"';
  const std::string closing(3, quote);
  const bool many_lines = text.substr(at).starts_with(closing);
  std::size_t i = at + (many_lines ? 3 : 1);
  while (i < text.size())
  {
    if (escapes && text[i] == '\\')
      i += 2;
    else if (!many_lines && (text[i] == quote || text[i] == '\n'))
      return i + (text[i] == quote ? 1 : 0);
    else if (many_lines && text.substr(i).starts_with(closing))
    {
      i += 3;
      for (int extra = 0; extra < 2 && i < text.size() && text[i] == quote; ++extra)
        ++i; // one or two quotes at the end belong to the string
      return i;
    }
    else
      ++i;
  }
  return text.size();
}

TomlObstacle obstacle_at(std::string_view text, std::size_t at, std::string problem)
{
  const std::string_view before = text.substr(0, at);
  const auto line_start = before.rfind('\n') + 1; // npos + 1 is 0
  return {std::move(problem), static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(at - line_start) + 1};
}
} // namespace

TomlObstacle find_obstacle(std::string_view text)
{
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  int parts = 1;
  char before = '\n'; // the last character that is no blank
  while (i < text.size())
  {
    const char c = text[i];
    if (c == '#')
    {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '"' || c == '\'')
    {
      if (std::string_view("\n=,[{.").find(before) == std::string_view::npos)
        return obstacle_at(text, i, "quotes where no text can begin");
      i = behind_string(text, i);
      before = c;
      continue;
    }
    if (static_cast<unsigned char>(c) >= 0x80)
      return obstacle_at(text, i, "a character beyond ASCII, outside of quotes");
    if (c == '.' && ++parts > most_parts)
      return obstacle_at(text, i, "a dotted key of more than 8 parts");
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{')
      parts = 1;
    if (c != ' ' && c != '\t')
      before = c;
    ++i;
  }
  return {};
}
} // namespace berm::app
