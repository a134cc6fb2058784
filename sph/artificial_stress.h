// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "sph/kernel.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace berm::sph
{
/// @brief Repulsion against tensile clumping, R / rho^2 without the rho: docs/theory.md eq. (9.7).
/// -eps0 times each principal stress of the plane that is tensile, turned back to x and y. Gray,
/// Monaghan & Swift 2001; Bui et al. 2009 eq. (12). No angle is taken: with the tensile principal
/// values s1 >= s2, R = -eps0 (p I + d n), n the unit deviator of the plane.
[[nodiscard]] inline SymTensor tensile_repulsion(const SymTensor& sig, double eps0)
{
  const double mean = 0.5 * (sig.xx + sig.yy), half = 0.5 * (sig.xx - sig.yy);
  const double radius = std::sqrt(half * half + sig.xy * sig.xy);
  if (mean + radius <= 0)
    return {};
  const double s1 = -eps0 * (mean + radius), s2 = mean > radius ? -eps0 * (mean - radius) : 0;
  const double p = 0.5 * (s1 + s2), d = radius > 0 ? 0.5 * (s1 - s2) / radius : 0;
  return {p + d * half, p - d * half, 0, d * sig.xy};
}

/// (W(q h) / W(dx))^2.55 from a table of 512 entries with linear interpolation, q = r / h.
class RepulsionTable
{
public:
  RepulsionTable(double h, double spacing)
  {
    const CubicSpline W{h};
    for (std::size_t k = 0; k < values_.size(); ++k)
      values_[k] = std::pow(W.W(static_cast<double>(k) / per_q * h) / W.W(spacing), exponent);
  }
  [[nodiscard]] double operator()(double q) const
  {
    const double place = q * per_q;
    const auto k = static_cast<std::size_t>(static_cast<int>(place));
    if (k >= entries - 1)
      return 0;
    return values_[k] + (place - static_cast<double>(k)) * (values_[k + 1] - values_[k]);
  }

private:
  static constexpr std::size_t entries = 512;
  static constexpr double exponent = 2.55, per_q = (entries - 1) / 2.0;
  std::array<double, entries> values_{};
};
} // namespace berm::sph
