// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/strength_reduction.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

namespace berm::sph
{
namespace
{
/// Hands the progress of one trial on as a part of the whole search.
class TrialObserver : public Observer
{
public:
  TrialObserver(Observer& whole, double begin, double end, std::string text)
      : whole_(whole), begin_(begin), end_(end), text_(std::move(text))
  {
  }
  void note(std::string_view text) override { whole_.note(text); }
  void warn(std::string_view text) override { whole_.warn(text); }
  void progress(double fraction, std::string_view) override
  {
    whole_.progress(begin_ + fraction * (end_ - begin_), text_);
  }
  [[nodiscard]] bool stop_requested() const override { return whole_.stop_requested(); }

private:
  Observer& whole_;
  double begin_, end_;
  std::string text_;
};

/// Of the range: once the answer is nearer than this to an end that is only guessed, it is tried.
constexpr double doubtful = 0.13; // three bisections on one side

/// The search: trials so far, and the bracket that they give.
class Search
{
public:
  Search(const RunTrial& run_trial, const SearchSettings& settings, Observer& observer)
      : run_trial_(run_trial), settings_(settings), observer_(observer)
  {
  }

  FactorOfSafety run()
  {
    // The ends of the range are guesses: bisect between them, try an end only when the answer seems
    // to lie near it or beyond.
    double lower = settings_.lower, upper = settings_.upper;
    if (settings_.guess)
    {
      lower = *settings_.guess - reach();
      upper = *settings_.guess + reach();
    }
    double range = upper - lower;
    while (answer_.reason.empty())
    {
      lower = answer_.stands.value_or(lower);
      upper = answer_.fails.value_or(upper);
      const bool wide = upper - lower > 2 * settings_.tolerance;
      const bool known = answer_.stands && answer_.fails;
      const bool doubted = settings_.guess || upper - lower <= doubtful * range;
      if (wide && (known || !doubted))
        bisect(lower, upper);
      else if (!answer_.stands)
      {
        lower = widen(lower, [&](double F) { return std::max(below(F), settings_.min_factor); });
        range = upper - lower;
      }
      else if (!answer_.fails)
      {
        upper = widen(upper, [&](double F) { return std::min(above(F), settings_.max_factor); });
        range = upper - lower;
      }
      else
      {
        answer_.complete = true;
        break;
      }
    }
    return std::move(answer_);
  }

private:
  /// The tolerance, but for rounding: brackets of twice this are no wider than asked.
  [[nodiscard]] double reach() const { return settings_.tolerance * (1 - 1e-9); }

  /// Where to look next beyond an end that contradicted its name: near a guess in steps that
  /// double.
  double below(double F) { return settings_.guess ? F - next_stride() : F / 1.5; }
  double above(double F) { return settings_.guess ? F + next_stride() : F * 1.5; }
  double next_stride()
  {
    stride_ = stride_ > 0 ? 2 * stride_ : 2 * reach();
    return stride_;
  }

  void bisect(double lower, double upper)
  {
    const double middle = 0.5 * (lower + upper);
    if (attempt(middle) == Outcome::undecided && answer_.reason.empty() &&
        attempt(0.5 * (lower + middle)) == Outcome::undecided && answer_.reason.empty())
      answer_.reason = fmt::format("trials at {:.4g} and {:.4g} stayed undecided", middle,
                                   0.5 * (lower + middle));
  }

  /// Try an end of the range that was only guessed; if it contradicts its name, move it outwards.
  template <class Outwards>
  double widen(double end, Outwards&& outwards)
  {
    const bool is_lower = !answer_.stands;
    if (attempt(end) == Outcome::undecided && answer_.reason.empty())
      answer_.reason = fmt::format("the trial at {:.4g} stayed undecided", end);
    const bool known = is_lower ? answer_.stands.has_value() : answer_.fails.has_value();
    if (known || !answer_.reason.empty())
      return end;
    const double next = outwards(end);
    if (next == end)
      answer_.reason = is_lower ? fmt::format("it fails even at {:.4g}", end)
                                : fmt::format("it stands even at {:.4g}", end);
    return next;
  }

  Outcome attempt(double F)
  {
    const double lower = answer_.stands.value_or(settings_.lower);
    const double upper = answer_.fails.value_or(settings_.upper);
    const double left = 1 + std::max(0.0, std::log2((upper - lower) / (2 * settings_.tolerance)));
    const double done = static_cast<double>(answer_.trials.size());
    const double total = done + left;
    TrialObserver trial_observer(
        observer_, done / total, (done + 1) / total,
        fmt::format("trial {}: F = {:.4g}, between {:.4g} and {:.4g}", done + 1, F, lower, upper));
    Trial trial = run_trial_(F, trial_observer);
    observer_.note(
        fmt::format("F = {:<7.5g} {:<9} {}; s = {:.2g}, moved {:.3g} m, {} steps, {:.1f} s", F,
                    to_string(trial.outcome), trial.reason, trial.velocity_measure,
                    trial.max_displacement, trial.steps, trial.seconds.wall));
    const Outcome outcome = trial.outcome;
    if (trial.interrupted)
      answer_.reason = "stopped before the bracket was narrow enough";
    else if (outcome == Outcome::stands)
      answer_.stands = std::max(F, answer_.stands.value_or(F));
    else if (outcome == Outcome::fails)
      answer_.fails = std::min(F, answer_.fails.value_or(F));
    answer_.trials.push_back(std::move(trial));
    if (answer_.stands && answer_.fails && *answer_.stands >= *answer_.fails)
      answer_.reason = fmt::format("contradiction: it stands at {:.4g} and fails at {:.4g}",
                                   *answer_.stands, *answer_.fails);
    keep_states_of_the_bracket();
    return outcome;
  }

  void keep_states_of_the_bracket()
  {
    for (Trial& trial : answer_.trials)
      if (trial.factor != answer_.stands && trial.factor != answer_.fails)
        trial.state = {};
  }

  const RunTrial& run_trial_;
  const SearchSettings& settings_;
  Observer& observer_;
  FactorOfSafety answer_;
  double stride_ = 0;
};

const Trial* find_trial(const std::vector<Trial>& trials, std::optional<double> factor)
{
  const auto it = std::find_if(trials.begin(), trials.end(),
                               [&](const Trial& t) { return factor && t.factor == *factor; });
  return it == trials.end() ? nullptr : &*it;
}
} // namespace

const char* to_string(Outcome outcome)
{
  switch (outcome)
  {
  case Outcome::stands:
    return "stands";
  case Outcome::fails:
    return "fails";
  case Outcome::undecided:
    break;
  }
  return "undecided";
}

std::optional<double> FactorOfSafety::factor() const
{
  if (!stands || !fails)
    return std::nullopt;
  return 0.5 * (*stands + *fails);
}

const Trial* FactorOfSafety::failing_trial() const
{
  return find_trial(trials, fails);
}
const Trial* FactorOfSafety::standing_trial() const
{
  return find_trial(trials, stands);
}

FactorOfSafety reduce_strength(const RunTrial& run_trial, const SearchSettings& settings,
                               Observer& observer)
{
  return Search(run_trial, settings, observer).run();
}
} // namespace berm::sph
