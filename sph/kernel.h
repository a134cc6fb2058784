// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

namespace berm::sph
{
/// Cubic spline in two dimensions, support 2 h. docs/theory.md eq. (3.1); Monaghan & Lattanzio
/// 1985; Bui et al. 2009 eq. (4).
struct CubicSpline
{
  double h; ///< smoothing length [m]

  [[nodiscard]] double radius() const { return 2 * h; }

  /// W(r) [1/m2]
  [[nodiscard]] double W(double r) const
  {
    const double q = r / h;
    if (q >= 2)
      return 0;
    const double a = 2 - q;
    return q < 1 ? norm() * (1 - 1.5 * q * q + 0.75 * q * q * q) : norm() * 0.25 * a * a * a;
  }

  /// dW/dr [1/m3], <= 0
  [[nodiscard]] double dW(double r) const
  {
    const double q = r / h;
    if (q >= 2)
      return 0;
    const double a = 2 - q;
    return q < 1 ? norm() / h * (-3 * q + 2.25 * q * q) : -norm() / h * 0.75 * a * a;
  }

private:
  [[nodiscard]] double norm() const { return 10 / (7 * pi * h * h); }
};
} // namespace berm::sph
