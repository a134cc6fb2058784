// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// `--vary key=values` of `berm study`.
namespace berm::app
{
/// Keys that take the same values together, and these values.
struct Variation
{
  std::vector<std::string> keys;   ///< as --set addresses them; at least one
  std::vector<std::string> values; ///< TOML, or bare words; at least one

  /// Heading of its column: the keys, joined by "+".
  [[nodiscard]] std::string name() const;
};

/// @brief Parse the texts of `--vary`: "key=a,b,c", "key=from:to:count", "key=from:to:count:log",
/// "key+key=a,b"; ranges may stand in a list. Commas inside brackets, braces or quotes separate
/// nothing, so that every value may be any TOML value.
/// @param[in,out] mistakes  Gains every mistake: no "=", an empty or repeated value, a range that
/// is
///                          none, a key that is varied twice.
/// @return What is right.
[[nodiscard]] std::vector<Variation> parse_variations(const std::vector<std::string>& texts,
                                                      std::vector<Mistake>& mistakes);

/// @brief Cut at commas outside of brackets, braces and quotes; blanks around the parts go.
[[nodiscard]] std::vector<std::string> split_values(std::string_view text);

/// @brief The number that a text is, all of it; nothing for other texts.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

/// @brief The same text, or the same number.
[[nodiscard]] bool same_value(const std::string& a, const std::string& b);
} // namespace berm::app
