// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mistakes.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace berm::app
{
struct TomlEntry;

/// A value of a TOML document; tables keep the order of the file, which says which soil is the
/// first.
struct TomlValue
{
  using Array = std::vector<TomlValue>;
  using Table = std::vector<TomlEntry>;
  struct DateOrTime
  {
  };

  std::variant<bool, std::int64_t, double, std::string, DateOrTime, Array, Table> data;
  std::string place; ///< "dam.toml:12" or "--set key=value"
  int order = 0;     ///< the line; after all lines for --set

  [[nodiscard]] const Table* table() const { return std::get_if<Table>(&data); }
  [[nodiscard]] const Array* array() const { return std::get_if<Array>(&data); }
};

/// A key and its value.
struct TomlEntry
{
  std::string first;
  TomlValue second;
};

/// @brief Parse a TOML document (toml++ is used here only).
/// @param[in] text   The document, UTF-8.
/// @param[in] name   What places call it, e.g. its path.
/// @throws InputError with one mistake, its place set in `places`: TOML stops at the first.
[[nodiscard]] TomlValue parse_toml(std::string_view text, const std::string& name,
                                   KeyPlaces& places);

/// @brief Apply `--set key=value`: create or replace. The value is TOML, or else a bare string.
/// Elements of an array of tables are counted from 1: "section.zone[1].soil"; one past the end adds
/// one.
/// @return The mistakes of `overrides` themselves (no "=", no such element); what they set is not
/// checked.
[[nodiscard]] std::vector<Mistake>
apply_overrides(TomlValue& document, const std::vector<std::string>& overrides, KeyPlaces& places);

/// @brief The value at a path as --set has it; null if there is none.
[[nodiscard]] const TomlValue* find_value(const TomlValue& document, std::string_view path);

/// @brief The value on one line as TOML, cut off after some 60 characters.
[[nodiscard]] std::string toml_text(const TomlValue& value);
} // namespace berm::app
