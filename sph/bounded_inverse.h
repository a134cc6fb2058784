// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <algorithm>
#include <cmath>

namespace berm::sph
{
/// @brief Inverse of the symmetric matrix (xx, xy; xy, yy) [-], docs/theory.md eq. (9.2).
/// Eigenvalues count as at least 0.2: a direction in which few neighbours lie is corrected at most
/// five times, and without a jump as neighbours come and go.
[[nodiscard]] inline SymTensor bounded_inverse(double xx, double xy, double yy)
{
  constexpr double least = 0.2;
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
  const double radius = std::sqrt(half * half + xy * xy);
  const double a = 1 / std::max(mean + radius, least), b = 1 / std::max(mean - radius, least);
  const double p = 0.5 * (a + b), d = radius > 0 ? 0.5 * (a - b) / radius : 0;
  return {p + d * half, p - d * half, 0, d * xy};
}
} // namespace berm::sph
