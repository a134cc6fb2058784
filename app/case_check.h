// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mistakes.h"
#include "app/toml_document.h"
#include "core/tensor.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace berm::app
{
/// The values of a case file that passed the key table, by their paths: "soil.fill.cohesion_kPa",
/// "section.zone[1].soil". Units are still the file's. Defaults are filled in.
class CheckedValues
{
public:
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>,
                             std::vector<double>, Polyline, std::vector<Polyline>>;

  void set(const std::string& path, Value value) { values_[path] = std::move(value); }
  /// @brief The value, if it is there, right, and of this type.
  template <typename T>
  [[nodiscard]] std::optional<T> get(const std::string& path) const
  {
    const auto it = values_.find(path);
    if (it == values_.end() || !std::holds_alternative<T>(it->second))
      return std::nullopt;
    return std::get<T>(it->second);
  }
  [[nodiscard]] bool has(const std::string& path) const { return values_.contains(path); }

  void set_count(const std::string& path, std::size_t count) { counts_[path] = count; }
  /// @brief Number of elements of an array of tables, as "section.zone"; 0 if it is not there.
  [[nodiscard]] std::size_t count(const std::string& path) const
  {
    const auto it = counts_.find(path);
    return it == counts_.end() ? 0 : it->second;
  }

  std::vector<std::string> soils; ///< names, in the file's order
  bool run_out = false;           ///< there is a [runout], be it empty

private:
  std::map<std::string, Value> values_;
  std::map<std::string, std::size_t> counts_;
};

/// @brief Check a document against the key table, each value by itself.
/// @param[in]     document  The parsed file with --set applied.
/// @param[in,out] places    Gains the place of every key.
/// @param[in,out] mistakes  Gains every mistake; what is wrong is left out of the result.
[[nodiscard]] CheckedValues check_values(const TomlValue& document, KeyPlaces& places,
                                         std::vector<Mistake>& mistakes);

/// @brief Whether a key was given, be it right or wrong: a wrong value is reported already.
[[nodiscard]] bool was_given(const CheckedValues& values, const std::vector<Mistake>& mistakes,
                             const std::string& path);
} // namespace berm::app
