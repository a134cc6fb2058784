// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "coupling/case.h"
#include "meshes/section.h"
#include "seepage/solution.h"

#include <functional>
#include <span>
#include <vector>

namespace berm::coupling
{
/// p_w at points [Pa], compression positive, >= 0 (no suction). One interface for every kind of
/// water.
using PorePressure =
    std::function<std::vector<double>(std::span<const double> x, std::span<const double> y)>;

/// @brief Dry soil: zero everywhere.
[[nodiscard]] PorePressure no_pore_pressure();

/// @brief Level of a line at x, constant beyond its ends [m].
/// @param[in] line  x strictly increasing [m]; not empty.
[[nodiscard]] double level_at(const Polyline& line, double x);

/// @brief gamma_w times the vertical depth below a line, whose level goes on beyond its ends.
/// Bui et al. 2009 section 4 and Griffiths & Lane 1999 Ex. 6 take the pore pressure so.
/// @param[in] free_surface  x strictly increasing [m]; not empty.
[[nodiscard]] PorePressure hydrostatic_pore_pressure(Polyline free_surface);

/// @brief The finite-element pressure, evaluated by barycentric interpolation, max(p, 0).
/// Points outside the mesh by up to `max_shift` take the nearest element's value at the nearest
/// point.
/// @throws InputError naming the worst point if one lies farther out.
[[nodiscard]] PorePressure seepage_pore_pressure(const seepage::Solution& solution,
                                                 double max_shift);

/// @brief The field fixed in space, for soil that moves: `inside` within the section as drawn;
/// around it the pools, hydrostatic below their level on their side of the section's highest
/// ground, and air.
[[nodiscard]] PorePressure pore_pressure_in_space(PorePressure inside,
                                                  const meshes::Section& section);

/// @brief The straight line that the paper draws: pool level up to the waterline, then straight to
/// the other pool's waterline or, without one, to the toe of the ground on that side. A pool that
/// runs over the crest ends there. Empty if there is no pool.
[[nodiscard]] Polyline straight_free_surface(const meshes::Section& section);
} // namespace berm::coupling
