// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/discretisation.h"

namespace berm::sph
{
/// @brief Largest eigenvalue of dt^2 K + 2 dt C, with K the elastic and C the viscous operator [-].
/// The undamped scheme is stable below 4. Power iteration with one time step as the operator; the
/// start is a fixed pseudo-random field, so that the result is repeatable. Cost: `iterations` time
/// steps.
[[nodiscard]] double stability_number(const Discretisation& d, int iterations = 60);

/// @brief Shorten d.dt where the Courant number alone would not do: docs/theory.md eq. (3.10).
/// Soil that thins out on its base, and very uneven packings, are stiffer than their spacing says.
void limit_time_step(Discretisation& d);
} // namespace berm::sph
