// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/search.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/core.h>
#include <utility>

namespace berm::sph
{
namespace
{
/// Of the range: once the answer is nearer than this to an end that is only guessed, it is tried.
constexpr double doubtful = 0.13; // three bisections on one side

/// Goes through the search from its start with what is known, up to the first factor that is not.
class Replay
{
public:
  Replay(const SearchSettings& settings, const Outcomes& known) : settings_(settings), known_(known)
  {
  }

  SearchStep run()
  {
    // The ends of the range are guesses: bisect between them, try an end only when the answer seems
    // to lie near it or beyond.
    double lower = at_or_below(settings_.guess.value_or(settings_.lower));
    double upper = settings_.guess ? above_by(lower, width()) : at_or_above(settings_.upper);
    double range = upper - lower;
    while (goes_on())
    {
      lower = step_.stands.value_or(lower);
      upper = step_.fails.value_or(upper);
      const bool wide = upper - lower > width();
      const bool bracketed = step_.stands && step_.fails;
      const bool doubted = settings_.guess || upper - lower <= doubtful * range;
      if (wide && (bracketed || !doubted))
        bisect(lower, upper);
      else if (!step_.stands)
      {
        lower = widen(lower, [&](double F) { return below(F); });
        range = upper - lower;
      }
      else if (!step_.fails)
      {
        upper = widen(upper, [&](double F) { return above(F); });
        range = upper - lower;
      }
      else
        step_.complete = true;
    }
    return std::move(step_);
  }

private:
  [[nodiscard]] bool goes_on() const
  {
    return !step_.next && !step_.complete && step_.reason.empty();
  }

  /// Of the last bracket: twice the tolerance, less what takes more than five binary digits. So its
  /// multiples and their differences are exact.
  [[nodiscard]] double width() const
  {
    int exponent = 0;
    const double fraction = std::frexp(2 * settings_.tolerance, &exponent);
    return std::ldexp(std::floor(32 * fraction), exponent - 5);
  }

  /// Multiples of the width, within the limits.
  [[nodiscard]] double at_or_below(double F) const
  {
    return std::max(std::floor(F / width()) * width(), settings_.min_factor);
  }
  [[nodiscard]] double at_or_above(double F) const
  {
    return std::min(std::ceil(F / width()) * width(), settings_.max_factor);
  }
  [[nodiscard]] double nearest(double F) const { return std::round(F / width()) * width(); }

  /// Where to look next beyond an end that contradicted its name: near a guess in steps that
  /// double.
  double below(double F) { return at_or_below(settings_.guess ? F - next_stride() : F / 1.5); }
  double above(double F)
  {
    return settings_.guess ? above_by(F, next_stride()) : at_or_above(F * 1.5);
  }
  [[nodiscard]] double above_by(double F, double stride) const
  {
    return std::min(nearest(F + stride), settings_.max_factor);
  }
  double next_stride()
  {
    stride_ = stride_ > 0 ? 2 * stride_ : width();
    return stride_;
  }

  void bisect(double lower, double upper)
  {
    if (attempt(nearest(0.5 * (lower + upper))))
      narrow_gap();
  }

  /// Try an end of the range that was only guessed; if it contradicts its name, move it outwards.
  template <class Outwards>
  double widen(double end, Outwards&& outwards)
  {
    const bool is_lower = !step_.stands;
    if (attempt(end))
      narrow_gap();
    if (!goes_on() || (is_lower ? step_.stands.has_value() : step_.fails.has_value()))
      return end;
    const double next = outwards(end);
    if (next == end)
      step_.reason = is_lower ? fmt::format("it fails even at {:.4g}", end)
                              : fmt::format("it stands even at {:.4g}", end);
    return next;
  }

  /// Once a trial was undecided: the search for what stands and what fails next to it.
  void narrow_gap()
  {
    while (goes_on())
    {
      std::erase_if(undecided_, [this](double F)
                    { return F < step_.stands.value_or(F) || F > step_.fails.value_or(F); });
      if (undecided_.empty()) // by chance, beside the answer
        return;
      const double lowest = std::min(undecided_.front(), step_.fails.value_or(undecided_.front()));
      const double highest = std::max(undecided_.back(), step_.stands.value_or(undecided_.back()));
      if (!step_.stands && lowest > settings_.min_factor)
        attempt(at_or_below(lowest / 1.2));
      else if (!step_.fails && highest < settings_.max_factor)
        attempt(at_or_above(highest * 1.2));
      else if (step_.stands && undecided_.front() - *step_.stands > width())
        attempt(nearest(0.5 * (*step_.stands + undecided_.front())));
      else if (step_.fails && *step_.fails - undecided_.back() > width())
        attempt(nearest(0.5 * (undecided_.back() + *step_.fails)));
      else if (step_.stands && step_.fails && *step_.fails - *step_.stands <= 2 * width())
        step_.complete = true;
      else
        step_.reason = fmt::format("trials from {:.4g} to {:.4g} stayed undecided",
                                   undecided_.front(), undecided_.back());
    }
  }

  /// Take in the trial at F, or ask for it. @return Whether it is known to be undecided.
  bool attempt(double F)
  {
    const auto it = known_.find(F);
    if (it == known_.end())
    {
      step_.next = F;
      return false;
    }
    if (it->second == Outcome::stands)
      step_.stands = std::max(F, step_.stands.value_or(F));
    else if (it->second == Outcome::fails)
      step_.fails = std::min(F, step_.fails.value_or(F));
    if (step_.stands && step_.fails && *step_.stands >= *step_.fails)
      step_.reason = fmt::format("contradiction: it stands at {:.4g} and fails at {:.4g}",
                                 *step_.stands, *step_.fails);
    if (it->second != Outcome::undecided)
      return false;
    undecided_.insert(std::upper_bound(undecided_.begin(), undecided_.end(), F), F);
    return true;
  }

  const SearchSettings& settings_;
  const Outcomes& known_;
  SearchStep step_;
  std::vector<double> undecided_; ///< ascending
  double stride_ = 0;
};
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

SearchStep next_step(const SearchSettings& settings, const Outcomes& known)
{
  return Replay(settings, known).run();
}

std::vector<double> wanted_next(const SearchSettings& settings, const Outcomes& known, int count)
{
  std::vector<double> wanted;
  std::deque<Outcomes> supposed = {known}; // breadth first: the fewer suppositions the better
  while (!supposed.empty() && std::ssize(wanted) < count)
  {
    const Outcomes outcomes = std::move(supposed.front());
    supposed.pop_front();
    const std::optional<double> next = next_step(settings, outcomes).next;
    if (!next)
      continue;
    if (std::find(wanted.begin(), wanted.end(), *next) == wanted.end())
      wanted.push_back(*next);
    for (const Outcome outcome : {Outcome::stands, Outcome::fails})
    {
      supposed.push_back(outcomes);
      supposed.back()[*next] = outcome;
    }
  }
  return wanted;
}
} // namespace berm::sph
