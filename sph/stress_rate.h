// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "sph/drucker_prager.h"

#include <algorithm>

namespace berm::sph
{
/// Gradient of the velocity [1/s]: xy = d v_x / d y.
struct VelocityGradient
{
  double xx = 0, xy = 0, yx = 0, yy = 0;
};

/// @brief Gradient in the middle of a step from that at its end, L (I - L dt / 2)^-1: eq. (9.11).
/// The velocity belongs to the middle of the step, the positions to its end. Taken as it is, L
/// would see an expansion of w dt / 2 in every turn by w dt: soil would shrink as it turns.
[[nodiscard]] inline VelocityGradient at_middle(const VelocityGradient& L, double dt)
{
  constexpr double least = 0.25; // of the determinant: no step of soil doubles its lengths
  const double xx = 1 - 0.5 * dt * L.xx, xy = -0.5 * dt * L.xy;
  const double yx = -0.5 * dt * L.yx, yy = 1 - 0.5 * dt * L.yy;
  const double scale = 1 / std::max(xx * yy - xy * yx, least);
  return {scale * (L.xx * yy - L.xy * yx), scale * (L.xy * xx - L.xx * xy),
          scale * (L.yx * yy - L.yy * yx), scale * (L.yy * xx - L.yx * xy)};
}

/// @brief Stress turned by the spin over dt: docs/theory.md eq. (9.3).
/// The angle's Cayley form is used, so that a rigid rotation leaves the invariants as they are to
/// rounding, whatever the step.
[[nodiscard]] inline SymTensor turned_by(const SymTensor& sig, const VelocityGradient& L, double dt)
{
  // Mohr's circle turns by twice the angle w; t = tan(w) to third order.
  const double t = 0.5 * dt * (L.yx - L.xy);
  const double scale = 1 / (1 + t * t), c = (1 - t * t) * scale, s = 2 * t * scale;
  const double mean = 0.5 * (sig.xx + sig.yy), half = 0.5 * (sig.xx - sig.yy);
  const double half_new = c * half - s * sig.xy;
  return {mean + half_new, mean - half_new, sig.zz, s * half + c * sig.xy};
}

/// @brief Elastic stress of the strain over dt: the second line of eq. (9.3) [Pa].
[[nodiscard]] inline SymTensor strained_by(const VelocityGradient& L, double dt, const Elastic& e)
{
  const double volume = dt * (e.K - 2 * e.G / 3) * (L.xx + L.yy), shear = dt * e.G;
  return {volume + 2 * shear * L.xx, volume + 2 * shear * L.yy, volume, shear * (L.xy + L.yx)};
}

/// a : C^-1 : b [J/m3], C the elastic stiffness.
[[nodiscard]] inline double strain_energy_product(const SymTensor& a, const SymTensor& b,
                                                  const Elastic& e)
{
  const double a_p = I1(a) / 3, b_p = I1(b) / 3;
  const double s_s = (a.xx - a_p) * (b.xx - b_p) + (a.yy - a_p) * (b.yy - b_p) +
                     (a.zz - a_p) * (b.zz - b_p) + 2 * a.xy * b.xy;
  return a_p * b_p / e.K + s_s / (2 * e.G);
}

/// Elastic energy for each volume [J/m3]: I1^2 / (18 K) + J2 / (2 G).
[[nodiscard]] inline double strain_energy(const SymTensor& sig, const Elastic& e)
{
  const double i1 = I1(sig);
  return i1 * i1 / (18 * e.K) + J2(sig) / (2 * e.G);
}
} // namespace berm::sph
