// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/uncertainty.h"

#include <algorithm>
#include <cmath>

namespace berm::coupling
{
namespace
{
constexpr double least_order = 0.5, greatest_order = 2.1; // beyond: chance, not convergence
constexpr double margin = 1.25;                           // Roache's

/// The order of three factors; nothing where noise or a change of sign hides it.
std::optional<double> observed_order(const SpacingFactor& fine, const SpacingFactor& middle,
                                     const SpacingFactor& coarse)
{
  const auto change = [](const SpacingFactor& a, const SpacingFactor& b)
  { return b.F.factor() - a.F.factor(); };
  const auto seen = [&](const SpacingFactor& a, const SpacingFactor& b)
  { return std::abs(change(a, b)) > a.F.half_width() + b.F.half_width(); };
  if (!seen(fine, middle) || !seen(middle, coarse) ||
      change(fine, middle) * change(middle, coarse) < 0)
    return std::nullopt;
  const double p = std::log2(change(middle, coarse) / change(fine, middle));
  if (p < least_order || p > greatest_order)
    return std::nullopt;
  return p;
}
} // namespace

std::optional<DiscretisationError>
discretisation_error(const std::vector<SpacingFactor>& finest_first)
{
  if (finest_first.size() < 2)
    return std::nullopt;
  DiscretisationError result;
  if (finest_first.size() >= 3)
    result.order = observed_order(finest_first[0], finest_first[1], finest_first[2]);
  const double F = finest_first[0].F.factor();
  if (result.order)
  {
    const double remains =
        (F - finest_first[1].F.factor()) / (std::pow(2.0, *result.order) - 1); // Richardson
    result.extrapolated = F + remains;
    result.error = margin * std::abs(remains);
    return result;
  }
  double share = 1; // of a change that is the finest factor's error, at first order
  for (std::size_t k = 1; k < finest_first.size(); ++k, share /= 2)
  {
    const double change = finest_first[k].F.factor() - finest_first[k - 1].F.factor();
    result.error = std::max(result.error, margin * share * std::abs(change));
  }
  return result;
}

FactorRange factor_range(const Bracket& F, const std::optional<DiscretisationError>& discretisation,
                         const std::optional<FlowRuleSpread>& flow_rule)
{
  FactorRange range{F.stands, F.fails};
  if (flow_rule)
  {
    range.low = std::min(range.low, flow_rule->no_dilation.stands);
    range.high = std::max(range.high, flow_rule->associated.fails);
  }
  if (discretisation)
  {
    range.low -= discretisation->error;
    range.high += discretisation->error;
  }
  return range;
}
} // namespace berm::coupling
