// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/relative_conductivity.h"

#include <algorithm>
#include <cmath>

namespace berm::seepage
{
namespace
{
/// Above n = 3 van Genuchten's k_r falls by up to n / 3 over 1 / alpha, at once as n grows.
constexpr double steepest_at = 3;
constexpr double largest_drying = 2; ///< of a node in one step, over eps
/// alpha times suction at both ends of the curve: powers of it neither vanish nor overflow.
constexpr double least_suction = 1e-5, largest_suction = 1e5;

/// Not scaled to 1 at the air entry.
double van_genuchten(const VanGenuchtenCurve& curve, double suction)
{
  const double m = 1 - 1 / curve.n, y = std::pow(suction, curve.n);
  return std::pow(1 + y, -m * curve.l) * std::pow(1 - std::pow(y / (1 + y), m), 2);
}

/// f of docs/theory.md eq. (2.40), u = (p - shift w) / eps.
double falling(const RelativeConductivity& law, double u)
{
  const VanGenuchtenCurve& curve = law.curve;
  if (curve.scale == 0)
    return std::exp(std::min(u, 0.0));
  return curve.scale * van_genuchten(curve, std::clamp(-u, curve.entry, largest_suction));
}

/// int f du over u < 0: Simpson's rule in the logarithm of the suction. Enough for a shift.
double integral(const RelativeConductivity& law)
{
  constexpr int intervals = 400;
  const double low = std::log(law.curve.entry);
  const double step = (std::log(largest_suction) - low) / intervals;
  double sum = 0;
  for (int k = 0; k <= intervals; ++k)
  {
    const double suction = std::exp(low + k * step);
    const double share = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
    sum += share * step / 3 * suction * falling(law, -suction);
  }
  return law.curve.entry + sum;
}

/// Least p at which k_r = 1 [m].
double wet_from(const RelativeConductivity& law)
{
  return law.shift() - (law.curve.scale == 0 ? 0 : law.curve.entry * law.eps);
}

/// Of the exponential: U is eps exp((p - shift) / eps) below the shift.
double wetted_along_exponential(const RelativeConductivity& law, double p, double correction)
{
  const double eps = law.eps, shift = law.shift();
  // Below p_dry the floor k_min governs and the flow is linear in p.
  const double p_dry = shift + eps * std::log(law.k_min);
  const double linear = std::clamp(p_dry - p, 0.0, correction);
  if (linear == correction)
    return p + correction;
  p += linear;
  const double u = std::exp((p - shift) / eps) * (eps + correction - linear);
  return u < eps ? shift + eps * std::log(u / eps) : u + (shift - eps);
}

/// Length over which van Genuchten's k_r grows by a factor e [m].
double growth_length(const RelativeConductivity& law, double p)
{
  const VanGenuchtenCurve& curve = law.curve;
  const double x = std::min((law.shift() - p) / law.eps, largest_suction);
  const double m = 1 - 1 / curve.n, y = std::pow(x, curve.n);
  const double rest = -std::expm1(-m * std::log1p(1 / y)); // 1 - (y / (1 + y))^m, never 0
  const double log_slope = m * curve.n / (x * (1 + y)) * (curve.l * y + 2 * (1 - rest) / rest);
  constexpr double least_share = 1e-12; // keeps a length of the floor's linear flow finite
  const double share = std::max(1 - law.k_min / relative_conductivity(law, p, 1), least_share);
  return law.eps / (share * log_slope);
}

/// Of van Genuchten's curve: pieces of exponentials, short against the way to the wet side.
double wetted_along_curve(const RelativeConductivity& law, double p, double correction)
{
  constexpr double longest_piece = 0.5; // over growth length and way
  const double wet = wet_from(law);
  double left = relative_conductivity(law, p, 1) * correction; // of U
  while (wet - p > least_suction * law.eps)
  {
    const double k_r = relative_conductivity(law, p, 1);
    const double length = growth_length(law, p), way = wet - p;
    const double longest = std::max(longest_piece * std::min(length, way), least_suction * law.eps);
    const double piece = length * std::log1p(left / (k_r * length));
    if (!(piece > longest))
      return p + piece;
    left -= k_r * length * std::expm1(longest / length);
    p += longest;
  }
  return p + left;
}
} // namespace

double RelativeConductivity::shift() const
{
  return tau * eps - fringe;
}

RelativeConductivity law_of(const Retention& retention)
{
  RelativeConductivity law{.eps = 0, .k_min = 0, .fringe = 0, .tau = 1, .curve = {}};
  if (retention.model == RetentionModel::sharp)
    return law;
  law.eps = 1 / retention.alpha;
  if (retention.model == RetentionModel::van_genuchten)
  {
    law.curve = {.n = retention.n,
                 .l = retention.l,
                 .entry = std::max(retention.alpha * retention.air_entry, least_suction),
                 .scale = 1};
    law.curve.scale = 1 / van_genuchten(law.curve, law.curve.entry);
    law.tau = integral(law);
  }
  law.fringe = law.tau * law.eps;
  return law;
}

RelativeConductivity on_mesh(RelativeConductivity law, double resolved, double k_min)
{
  law.k_min = k_min;
  const VanGenuchtenCurve& curve = law.curve;
  const bool shown = // docs/theory.md eq. (2.44)
      resolved * std::max(1.0, curve.n / steepest_at) <= law.eps * std::max(1.0, curve.entry);
  if (shown)
    return law;
  law.curve = {};
  law.tau = 1;
  law.eps = resolved;
  return law;
}

double relative_conductivity(const RelativeConductivity& law, double p, double w)
{
  return law.k_min + (1 - law.k_min) * falling(law, (p - law.shift() * w) / law.eps);
}

double moved_pressure(const RelativeConductivity& law, double p, double correction)
{
  if (correction <= 0)
    return falling(law, (p - law.shift()) / law.eps) < law.k_min
               ? p + correction
               : std::max(p + correction, std::min(p, law.shift()) - largest_drying * law.eps);
  if (p >= wet_from(law))
    return p + correction;
  return law.curve.scale == 0 ? wetted_along_exponential(law, p, correction)
                              : wetted_along_curve(law, p, correction);
}
} // namespace berm::seepage
