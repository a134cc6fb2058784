// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_schema.h"

#include <fmt/format.h>

namespace berm::app
{
namespace
{
constexpr std::string_view head = R"(# Case file reference, format 1

Written by `berm reference`; a test checks that it is up to date.

A case is a TOML file. Units are in the names of the keys, one unit per key; material data have no
defaults. x points to the right, y up. `berm check CASE` reports every mistake at once, with its line.
`--set key=value` on the command line replaces a key of the file or adds one, e.g.
`--set sph.spacing_m=1` or `--set section.zone[1].soil=core` (elements are counted from 1).

`[soil.NAME]` is a soil, its name of your choice; the first in the file fills what no zone covers.
)";

/// "[soil.NAME]" of "soil.*.cohesion_kPa", "[[section.zone]]" of "section.zone[].soil".
std::string table_of(std::string_view path)
{
  const auto cut = path.rfind('.');
  if (cut == std::string_view::npos)
    return "Top level";
  const std::string_view table = path.substr(0, cut);
  if (table.ends_with("[]"))
    return fmt::format("`[[{}]]`", table.substr(0, table.size() - 2));
  if (const auto star = table.find('*'); star != std::string_view::npos)
    return fmt::format("`[{}NAME{}]`", table.substr(0, star), table.substr(star + 1));
  return fmt::format("`[{}]`", table);
}

/// In a Markdown table a bar stands as \|.
std::string escaped(std::string_view text)
{
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string absent_text(const Key& key)
{
  switch (key.presence)
  {
  case Presence::required:
    return "**required**";
  case Presence::defaulted:
    return fmt::format("`{}`", key.otherwise);
  case Presence::optional:
    return std::string(key.otherwise);
  }
  return {};
}
} // namespace

std::string case_reference()
{
  std::string text(head);
  std::string table;
  for (const Key& key : keys())
  {
    if (table_of(key.path) != table)
    {
      table = table_of(key.path);
      text += fmt::format(
          "\n## {}\n\n| key | unit | allowed | without it | meaning |\n|--|--|--|--|--|\n", table);
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", last_part(key.path), key.unit,
                        escaped(allowed_text(key)), absent_text(key), escaped(key.sentence));
  }
  return text;
}
} // namespace berm::app
