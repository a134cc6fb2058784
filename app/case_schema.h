// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace berm::app
{
/// What a key of the case file holds.
enum class ValueType
{
  text,              ///< a short line
  choice,            ///< one of Key::choices
  choice_list,       ///< some of them, each once, at least one
  number,            ///< finite, within Key::range
  integer,           ///< whole, within Key::range
  boolean,           ///< true or false
  points,            ///< [[x, y], ...], at least Key::least_points
  polygons,          ///< [[x, y], ...], at least Key::least_points, or a list of such
  level_or_polyline, ///< a number, or [[x, y], ...]
  conductivity,      ///< a number, or [kx, ky]; each within Key::range
  interval           ///< [lower, upper], lower < upper, both within Key::range
};

/// Where a number may lie. Every number of the case file has a range: no absurd value gets through.
struct Range
{
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false, upper_open = false; ///< the bound itself is not allowed

  [[nodiscard]] bool contains(double value) const
  {
    return (lower_open ? value > lower : value >= lower) &&
           (upper_open ? value < upper : value <= upper);
  }
};

enum class Presence
{
  required,  ///< in every table of its kind
  defaulted, ///< Key::otherwise is its value, as TOML
  optional   ///< Key::otherwise says in words what happens without it
};

/// One key of the case file: all there is to know about it.
struct Key
{
  std::string_view
      path; ///< "soil.*.cohesion_kPa": `*` any name; "section.zone[].soil": `[]` any element
  std::string_view unit = {}; ///< as in the reference; "" for none
  ValueType type = ValueType::text;
  Range range = {};
  std::vector<std::string_view> choices = {};
  int least_points = 2;
  Presence presence = Presence::required;
  std::string_view otherwise = {};
  std::string_view sentence; ///< what it is, one sentence
};

/// @brief Every key of case file version 1: parsing, checking, `berm reference` and the bad-input
/// tests come from this one table.
[[nodiscard]] std::span<const Key> keys();

/// @brief The last part of a path: "cohesion_kPa" of "soil.*.cohesion_kPa".
[[nodiscard]] std::string_view last_part(std::string_view path);

/// @brief What a key's value may be, one clause, e.g. "0 <= friction_angle_deg < 90".
[[nodiscard]] std::string allowed_text(const Key& key);

/// @brief The key table as a JSON Schema (draft 7), for editors that complete and check TOML.
/// Rules that concern more than one key, and names of soils, are beyond it.
[[nodiscard]] std::string case_json_schema();

/// @brief The key table as the Markdown page docs/case_reference.md.
[[nodiscard]] std::string case_reference();
} // namespace berm::app
