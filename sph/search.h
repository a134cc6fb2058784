// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Where to try next: pure functions of what is known, so that trials may run ahead of the search.
namespace berm::sph
{
enum class Outcome
{
  stands,
  fails,
  undecided
};

[[nodiscard]] const char* to_string(Outcome outcome);

/// What the search is to find, and how closely.
struct SearchSettings
{
  double lower = 0.5, upper = 3.0;           ///< where to start; widened if the answer lies outside
  double tolerance = 0.005;                  ///< half the width of the bracket
  double min_factor = 0.05, max_factor = 20; ///< beyond these the search gives up and says so
  /// Where the answer may be: tried first on either side, then ever farther out.
  std::optional<double> guess = std::nullopt;
};

/// Trials by their factor.
using Outcomes = std::map<double, Outcome>;

/// What the trials so far tell, and what is wanted next.
struct SearchStep
{
  std::optional<double> stands; ///< largest factor at which the slope stood
  std::optional<double> fails;  ///< smallest factor at which it failed
  std::optional<double> next;   ///< factor to try; nothing: the search is over
  bool complete = false; ///< bracket no wider than asked, both ends tried, nothing undecided in it
  std::string reason;    ///< why over and not complete
};

/// @brief Bisection, widening where an end contradicts its name.
/// Only whole multiples of the bracket's last width are tried, twice the tolerance or up to 6 %
/// less, so that the bracket does not depend on range and guess: only the cost does. An undecided
/// trial is never counted as either outcome: half a step below and above it are tried for a bracket
/// around it. If one of those is undecided, too, the search finds out how wide the gap is, and ends
/// incomplete, saying so.
[[nodiscard]] SearchStep next_step(const SearchSettings& settings, const Outcomes& known);

/// @brief Factors that the search will or may want next, the most certain first.
/// The first is what `next_step` wants; the others follow from either outcome of those before them.
/// @return At most `count` factors, none known, none twice; none if the search is over.
[[nodiscard]] std::vector<double> wanted_next(const SearchSettings& settings, const Outcomes& known,
                                              int count);
} // namespace berm::sph
