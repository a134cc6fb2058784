// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace berm::sph
{
/// Effective-stress parameters of a soil. Fields start as NaN: a forgotten one shows.
struct Soil
{
  double density = NAN;               ///< above the water [kg/m3]
  double saturated_density = NAN;     ///< below the water [kg/m3]
  double cohesion = NAN;              ///< c [Pa], >= 0
  double friction_angle = NAN;        ///< phi [rad], [0, pi/2)
  double dilation_angle = NAN;        ///< psi [rad], [0, phi]
  double young_modulus = NAN;         ///< E [Pa], > 0
  double poisson_ratio = NAN;         ///< nu [-], [0, 0.5)
  double tensile_strength = INFINITY; ///< largest mean tension I1 / 3 [Pa], >= 0; beyond the apex
                                      ///< of the cone it has no effect
};
} // namespace berm::sph
