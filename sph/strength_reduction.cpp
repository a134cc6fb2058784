// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/strength_reduction.h"

#include "core/error.h"
#include "sph/trial_bytes.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
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

/// How one rank's trial went; its error is thrown where the search wants the trial, on every rank.
struct Attempt
{
  Trial trial;
  std::string error; ///< a value that is not finite
};

std::string to_bytes(const Attempt& attempt)
{
  ByteWriter bytes;
  bytes.put(attempt.error);
  write(bytes, attempt.trial);
  return bytes.bytes();
}

Attempt attempt_from(const std::string& text)
{
  ByteReader bytes(text);
  Attempt attempt;
  bytes.get(attempt.error);
  read(bytes, attempt.trial);
  return attempt;
}

/// The search as it goes: trials taken in, and those that ran ahead of it.
class Search
{
public:
  Search(const RunTrial& run_trial, const SearchSettings& settings, Observer& observer, Team& team)
      : run_trial_(run_trial), settings_(settings), observer_(observer), team_(team)
  {
  }

  FactorOfSafety run()
  {
    SearchStep step = next_step(settings_, outcomes_);
    while (step.next && answer_.reason.empty())
    {
      if (!ahead_.contains(*step.next))
        try_next(step);
      take_in(ahead_.extract(*step.next).mapped());
      step = next_step(settings_, outcomes_);
      keep_states(step);
    }
    answer_.stands = step.stands;
    answer_.fails = step.fails;
    answer_.complete = step.complete;
    if (answer_.reason.empty())
      answer_.reason = step.reason;
    return std::move(answer_);
  }

private:
  /// Each rank one of the factors that are wanted next.
  void try_next(const SearchStep& step)
  {
    const std::vector<double> factors = wanted_next(settings_, outcomes_, team_.size());
    const auto mine = static_cast<std::size_t>(team_.rank());
    std::string bytes;
    if (mine < factors.size() && !ahead_.contains(factors[mine]))
      bytes = attempt(factors[mine], step);
    for (const std::string& from_rank : team_.gather(std::move(bytes)))
      if (!from_rank.empty())
      {
        Attempt done = attempt_from(from_rank);
        ahead_[done.trial.factor] = std::move(done);
      }
  }

  std::string attempt(double F, const SearchStep& step)
  {
    const double lower = step.stands.value_or(settings_.lower);
    const double upper = step.fails.value_or(settings_.upper);
    const double left = 1 + std::max(0.0, std::log2((upper - lower) / (2 * settings_.tolerance)));
    const double done = static_cast<double>(answer_.trials.size());
    const double total = done + left;
    TrialObserver trial_observer(
        observer_, done / total, (done + 1) / total,
        fmt::format("trial {}: F = {:.4g}, between {:.4g} and {:.4g}", done + 1, F, lower, upper));
    Attempt attempt;
    try
    {
      attempt.trial = run_trial_(F, trial_observer);
    }
    catch (const NumericalError& e)
    {
      attempt.error = e.what();
    }
    attempt.trial.factor = F;
    return to_bytes(attempt);
  }

  void take_in(Attempt attempt)
  {
    if (!attempt.error.empty())
      throw NumericalError(
          fmt::format("trial at F = {:.5g}: {}", attempt.trial.factor, attempt.error));
    Trial& trial = answer_.trials.emplace_back(std::move(attempt.trial));
    observer_.note(fmt::format("F = {:<7.5g} {:<9} {}; s = {:.2g}, moved {:.3g} m, {} steps, "
                               "{:.1f} s",
                               trial.factor, to_string(trial.outcome), trial.reason,
                               trial.velocity_measure, trial.max_displacement, trial.steps,
                               trial.seconds.wall));
    if (trial.interrupted)
      answer_.reason = "stopped before the bracket was narrow enough";
    else
      outcomes_[trial.factor] = trial.outcome;
  }

  /// Of the ends of the bracket only: a state is 100 bytes for each particle.
  void keep_states(const SearchStep& step)
  {
    for (Trial& trial : answer_.trials)
      if (trial.factor != step.stands && trial.factor != step.fails)
        trial.state = {};
  }

  const RunTrial& run_trial_;
  const SearchSettings& settings_;
  Observer& observer_;
  Team& team_;
  Outcomes outcomes_;
  std::map<double, Attempt> ahead_;
  FactorOfSafety answer_;
};

const Trial* find_trial(const std::vector<Trial>& trials, std::optional<double> factor)
{
  const auto it = std::find_if(trials.begin(), trials.end(),
                               [&](const Trial& t) { return factor && t.factor == *factor; });
  return it == trials.end() ? nullptr : &*it;
}
} // namespace

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
                               Observer& observer, Team& team)
{
  return Search(run_trial, settings, observer, team).run();
}

FactorOfSafety reduce_strength(const RunTrial& run_trial, const SearchSettings& settings,
                               Observer& observer)
{
  Team alone;
  return reduce_strength(run_trial, settings, observer, alone);
}
} // namespace berm::sph
