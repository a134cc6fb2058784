// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/tensor.h"
#include "sph/drucker_prager.h"

namespace berm::sph
{
/// Gradient of the velocity [1/s]: xy = d v_x / d y.
struct VelocityGradient
{
  double xx = 0, xy = 0, yx = 0, yy = 0;
};

/// @brief Elastic trial stress after dt: docs/theory.md eq. (9.3).
/// The stress turns by the angle of the spin exactly (Cayley form), so that a rigid rotation leaves
/// the invariants as they are to rounding, whatever the step; then the strain is added.
[[nodiscard]] inline SymTensor turn_and_strain(const SymTensor& sig, const VelocityGradient& L,
                                               double dt, const Elastic& e)
{
  // Mohr's circle turns by twice the angle w; t = tan(w) to third order.
  const double t = 0.5 * dt * (L.yx - L.xy);
  const double scale = 1 / (1 + t * t), c = (1 - t * t) * scale, s = 2 * t * scale;
  const double mean = 0.5 * (sig.xx + sig.yy), half = 0.5 * (sig.xx - sig.yy);
  const double half_new = c * half - s * sig.xy, xy_new = s * half + c * sig.xy;

  const double volume = dt * (e.K - 2 * e.G / 3) * (L.xx + L.yy), shear = dt * e.G;
  return {mean + half_new + volume + 2 * shear * L.xx, mean - half_new + volume + 2 * shear * L.yy,
          sig.zz + volume, xy_new + shear * (L.xy + L.yx)};
}

/// Elastic energy for each volume [J/m3]: I1^2 / (18 K) + J2 / (2 G).
[[nodiscard]] inline double strain_energy(const SymTensor& sig, const Elastic& e)
{
  const double i1 = I1(sig);
  return i1 * i1 / (18 * e.K) + J2(sig) / (2 * e.G);
}
} // namespace berm::sph
