// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/verdict.h"

#include <algorithm>
#include <fmt/core.h>
#include <utility>

namespace berm::sph
{
namespace
{
// Three decades lie between a standing slope's s near 2e-5 and a failing one's near 2e-2.
constexpr double at_rest = 1e-3;
constexpr double moving = 4e-3;
constexpr double moving_fast = 2e-2;
constexpr double at_rest_at_the_end = 2e-3;
constexpr double decaying = 0.97;     // s / s_previous of a slope that comes to rest stays below
constexpr int windows_to_fail = 3;    // running, none decaying
constexpr double earliest_stands = 4; // [T0]
constexpr double earliest_fails = 7;  // [T0]: before, the jump to the reduced strength still rings
constexpr double growth = 1.05;       // s over its smallest value past the ringing
constexpr double far_gone = 4;        // displacement [d_ref]
constexpr double progress = 0.5;      // way gained over way made; a sliding mass has 1 and more
} // namespace

bool Verdict::decide(Outcome outcome, std::string reason)
{
  outcome_ = outcome;
  reason_ = std::move(reason);
  return true;
}

bool Verdict::add_window(double time, double s, double displacement)
{
  const double s_previous = std::exchange(s_previous_, s);
  // In two windows the root mean square of the body makes a way of s_previous + s [d_ref].
  const double gained = displacement - std::exchange(displacement_2_, displacement_1_);
  const bool slides = gained > progress * (s_previous + s);
  displacement_1_ = displacement;
  if (time >= earliest_fails)
    smallest_ = std::min(smallest_, s);
  if (time >= earliest_stands && s < at_rest)
    return decide(Outcome::stands, fmt::format("at rest after {:.0f} T0", time));

  const bool undamped =
      slides && s > moving_fast && s > decaying * s_previous && time >= earliest_fails;
  not_decaying_ = undamped ? not_decaying_ + 1 : 0;
  if (not_decaying_ >= windows_to_fail)
    return decide(Outcome::fails, fmt::format("moves without slowing down after {:.0f} T0", time));

  // Slow motion may creep to rest along a plateau: only growth counts.
  if (slides && s > moving && s > growth * smallest_)
    return decide(Outcome::fails, fmt::format("moves ever faster after {:.0f} T0", time));

  if (slides && displacement > far_gone && s > moving && s > 0.5 * s_previous &&
      time >= earliest_fails)
    return decide(Outcome::fails, fmt::format("moved {:.1f} d_ref and still moves", displacement));

  if (time < longest)
    return false;
  if (s < at_rest_at_the_end)
    return decide(Outcome::stands, fmt::format("nearly at rest after {:.0f} T0", time));
  return decide(Outcome::undecided,
                fmt::format("neither at rest nor growing after {:.0f} T0", time));
}
} // namespace berm::sph
