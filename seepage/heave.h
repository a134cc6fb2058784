// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seepage/exit_gradient.h"
#include "seepage/solution.h"

#include <optional>
#include <span>
#include <vector>

namespace berm::seepage
{
/// Safety of the ground's surface against being lifted by water that flows upwards.
struct Heave
{
  /// Where the upward gradient is nearest to the critical one.
  struct Surface
  {
    double factor = 0;            ///< gamma' / (i gamma_w) [-]
    double gradient = 0;          ///< i, upwards [-]
    double critical_gradient = 0; ///< gamma' / gamma_w [-]
    Vec2 at{0, 0};                ///< [m]
  };
  /// The vertical column below the surface whose buoyant weight is least against the head below it.
  struct Column
  {
    double factor = 0;      ///< buoyant weight / (gamma_w excess head) [-]
    double depth = 0;       ///< [m]
    double excess_head = 0; ///< head at its foot over that at the surface [m]
    Vec2 at{0, 0};          ///< its top [m]
  };
  std::optional<Surface> surface; ///< nothing if no water flows up at the surface
  std::optional<Column> column;   ///< nothing if there is no excess head below

  /// The lesser of both; nothing if no water flows up.
  [[nodiscard]] std::optional<double> factor() const;
};

/// @brief The least factors against heave where water leaves upwards.
/// docs/theory.md eq. (2.24), (2.25). Only ground counts through which water leaves: not what lies
/// under impervious parts, nor drains that take water from above, nor walls; nor points beside a
/// singularity of the gradient (ExitPoint), where both factors are nought in theory. A column ends
/// where the soil does, or is not saturated. Both are exact for the linear field of the elements.
/// @param[in] buoyant_weight  gamma' = saturated unit weight - gamma_w of each soil [N/m3].
[[nodiscard]] Heave heave(const Solution& solution, std::span<const Outlet> outlets,
                          std::span<const double> buoyant_weight);
} // namespace berm::seepage
