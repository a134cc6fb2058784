// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"
#include "core/team.h"
#include "sph/particles.h"
#include "sph/search.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace berm::sph
{
/// The soil at the end of one window of T0.
struct TrialWindow
{
  double time = 0;             ///< since the strength was reduced [s]
  double velocity_measure = 0; ///< s of the window [-]; docs/theory.md eq. (6.1)
  double max_displacement = 0; ///< since the settled state [m]
};

/// One run of the soil with its strength divided by a factor, and the evidence for its outcome.
struct Trial
{
  double factor = 0;
  Outcome outcome = Outcome::undecided;
  std::string reason; ///< one clause: which rule decided
  double time = 0;    ///< simulated [s]
  long steps = 0;
  double velocity_measure =
      0; ///< s of the last window: mean v_rms T0 / d_ref [-]; docs/theory.md section 6
  double max_displacement = 0;      ///< since the settled state [m]
  std::vector<TrialWindow> history; ///< every window, in the order of time
  bool interrupted = false;         ///< the user asked to stop
  Seconds seconds;
  State state; ///< at its end
};

/// The answer of a search: a bracket whose ends were both tried.
struct FactorOfSafety
{
  std::optional<double> stands; ///< largest factor at which the slope stood
  std::optional<double> fails;  ///< smallest factor at which it failed
  std::vector<Trial>
      trials;            ///< in the order in which they ran; states kept only where `state_of` says
  bool complete = false; ///< bracket no wider than asked, or twice that around an undecided trial
  std::string reason;    ///< why not complete; empty if it is

  /// Middle of the bracket; nothing unless both ends are known.
  [[nodiscard]] std::optional<double> factor() const;
  /// The trial at the upper (fails) or lower (stands) end of the bracket; null if there is none.
  [[nodiscard]] const Trial* failing_trial() const;
  [[nodiscard]] const Trial* standing_trial() const;
};

/// Tries one factor; reports its own progress in [0, 1] and polls the observer for a wish to stop.
using RunTrial = std::function<Trial(double factor, Observer& observer)>;

/// @brief Bracket the factor of safety: `next_step` says where to try.
/// Every trial must start from the same state, so that the order does not matter.
/// A team tries as many factors at a time as it has ranks, those first that the search may want
/// next; it takes in only what it would have tried alone, in the same order, so that the answer is
/// the same for any number of ranks. Every rank gets it.
[[nodiscard]] FactorOfSafety reduce_strength(const RunTrial& run_trial,
                                             const SearchSettings& settings, Observer& observer,
                                             Team& team);
[[nodiscard]] FactorOfSafety reduce_strength(const RunTrial& run_trial,
                                             const SearchSettings& settings, Observer& observer);
} // namespace berm::sph
