// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

/// What a factor of safety is uncertain by. docs/theory.md section 6.1, eq. (6.3).
namespace berm::coupling
{
/// Largest factor at which the slope stood and smallest at which it failed.
struct Bracket
{
  double stands = 0, fails = 0;

  [[nodiscard]] double factor() const { return 0.5 * (stands + fails); }
  [[nodiscard]] double half_width() const { return 0.5 * (fails - stands); }
};

/// The answer on particles of one spacing.
struct SpacingFactor
{
  double spacing = 0; ///< dx [m]
  Bracket F;
};

/// How far the factor may lie from its limit for ever finer particles.
struct DiscretisationError
{
  double error = 0;                   ///< to either side of the finest factor [-], >= 0
  std::optional<double> order;        ///< in dx; nothing: not observable, 1 is supposed
  std::optional<double> extrapolated; ///< the limit by that order
};

/// @brief Grid convergence of a factor, each spacing twice the one before.
/// Three spacings, one trend and an order from 0.5 to 2.1: Richardson's error. Else, where the
/// changes are not larger than the brackets or contradict each other, the largest error that a
/// change tells if the order were 1, the lowest at which the sums converge. Both times Roache's
/// margin of 1.25 (J. Fluids Eng. 116, 1994, 405-413).
/// @param[in] finest_first  The factor and those on coarser particles.
/// @return Nothing for fewer than two spacings.
[[nodiscard]] std::optional<DiscretisationError>
discretisation_error(const std::vector<SpacingFactor>& finest_first);

/// The factor without dilation and with associated flow: a soil's lies between them.
struct FlowRuleSpread
{
  Bracket no_dilation; ///< psi = 0
  Bracket associated;  ///< psi = phi
};

/// From where to where the factor may lie, all of the above together.
struct FactorRange
{
  double low = 0, high = 0;
};

[[nodiscard]] FactorRange factor_range(const Bracket& F,
                                       const std::optional<DiscretisationError>& discretisation,
                                       const std::optional<FlowRuleSpread>& flow_rule);
} // namespace berm::coupling
