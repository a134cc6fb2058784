// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace berm::app
{
/// Where the user wrote which key: "cases/dam.toml:12", or "--set sph.spacing_m=-1".
class KeyPlaces
{
public:
  bool run_began = false; ///< the case had no mistake; what comes now comes from a stage

  void set(const std::string& key, std::string text, int order)
  {
    places_[key] = {std::move(text), order};
  }

  struct Place
  {
    std::string text; ///< as printed; empty if nothing is known
    int order = 0;    ///< the line; after all lines for --set
  };
  /// @brief Place of a key, or of the nearest table or array around it, or of the whole file (key
  /// "").
  [[nodiscard]] Place find(std::string_view key) const;

private:
  std::map<std::string, Place, std::less<>> places_;
};

/// `Mistake::problem` of a key that is not in the table; printed before the key.
inline constexpr std::string_view unknown_key = "unknown key";
/// `Mistake::problem` of a required key that is not there; printed before the key.
inline constexpr std::string_view missing_key = "missing key";

/// @brief The text for the user: place, key = value, allowed, hint; in the file's order; a count
/// last.
[[nodiscard]] std::string describe(const std::vector<Mistake>& mistakes, const KeyPlaces& places);

/// @brief One mistake likewise, without a count.
[[nodiscard]] std::string describe_one(const Mistake& mistake, const KeyPlaces& places);

/// @brief The candidate nearest to a mistyped word by edit distance; empty if none is near.
[[nodiscard]] std::string_view nearest(std::string_view word,
                                       const std::vector<std::string_view>& candidates);
} // namespace berm::app
