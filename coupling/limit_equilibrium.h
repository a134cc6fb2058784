// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "coupling/column_weights.h"
#include "coupling/pore_pressure.h"
#include "coupling/region.h"
#include "meshes/section.h"
#include "sph/soil.h"

#include <optional>
#include <span>

/// The companion of the factor of safety: circular slip surfaces by limit equilibrium, with the
/// same section, soils and pore pressure. It explains differences to an engineer; it never replaces
/// F.
namespace berm::coupling
{
/// A circular slip surface and its factors.
struct SlipCircle
{
  Vec2 centre{0, 0};              ///< [m]
  double radius = 0;              ///< [m]
  double x_left = 0, x_right = 0; ///< where it meets the ground [m]
  bool moves_right = true;        ///< which way the mass slides
  double bishop = 0;              ///< factor by Bishop's simplified method [-]
  std::optional<double> spencer;  ///< factor by Spencer's method, if it converged [-]
};

/// What the slices need to know of the slope.
struct LimitEquilibriumModel
{
  const meshes::Section& section; ///< ground and base as functions of x
  std::span<const sph::Soil> soils;
  const PorePressure& pore_pressure; ///< in the soil; at the ground, the pressure of the pool on it
  const Region* region = nullptr; ///< where the strength is divided by the factor; null: everywhere
  const ColumnWeights* weights = nullptr; ///< null: each slice's own, by 40 points
};

/// @brief Factors of one circle: docs/theory.md eq. (10.1)-(10.6). Bishop 1955, Spencer 1967.
/// A pool is a load on the ground, its vertical and horizontal parts integrated between the
/// ground's kinks, so that a submerged slope has the same factor whatever the depth of the pool.
/// Of several masses that one arc cuts off, the weakest.
/// Where the base of a slice lies in held soil, its strength is divided by min(F, 1), as in the
/// trials.
/// @return Nothing if the arc leaves the section, holds no mass, does not slide this way, stands at
///         any factor, or if the iteration does not converge.
[[nodiscard]] std::optional<SlipCircle> evaluate_circle(const LimitEquilibriumModel& model,
                                                        const Vec2& centre, double radius,
                                                        bool moves_right, int slices = 50);

/// @brief The circle with the smallest Bishop factor: arcs between every pair of points of the
/// ground, by their sagitta, then a shrinking pattern search from the best of them. The search
/// takes weights from a table, the factors of the circle that it finds do not.
/// @param[in] min_depth  Arcs shallower than this are left out [m]: a cohesionless skin hides the
/// rest.
/// @return Nothing if no arc is admissible.
[[nodiscard]] std::optional<SlipCircle> critical_circle(const LimitEquilibriumModel& model,
                                                        bool moves_right, double min_depth);
} // namespace berm::coupling
