// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/strength_reduction.h"

#include <limits>
#include <string>

namespace berm::sph
{
/// Decides from the course of a trial whether the slope stands or fails. docs/theory.md section 6.
/// The velocity measure s = mean(v_rms) T0 / d_ref over a window of one T0 falls monotonically
/// after a few T0 when the slope stands, and dips, then grows when it fails. Only motion that goes
/// somewhere counts: weakly damped soil swings, and s rises and falls, while nothing slides. The
/// rules were found by running each case to a certain end and asking from when on the answer could
/// have been known.
class Verdict
{
public:
  /// @brief Take in one window.
  /// @param[in] time          Its end, in units of T0 [-].
  /// @param[in] s             Velocity measure [-].
  /// @param[in] displacement  Largest displacement since the settled state, in units of d_ref [-].
  /// @return Whether the trial is over.
  [[nodiscard]] bool add_window(double time, double s, double displacement);

  [[nodiscard]] Outcome outcome() const { return outcome_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

  static constexpr double longest = 160; ///< a trial ends here at the latest [T0]

private:
  bool decide(Outcome outcome, std::string reason);

  double s_previous_ = 0;
  double displacement_1_ = 0, displacement_2_ = 0;       ///< one and two windows ago [d_ref]
  double smallest_ = std::numeric_limits<double>::max(); ///< s, once the start has rung out
  int not_decaying_ = 0;                                 ///< windows running
  Outcome outcome_ = Outcome::undecided;
  std::string reason_;
};
} // namespace berm::sph
