// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seepage/seepage.h"
#include "seepage/solution.h"

#include <optional>
#include <span>
#include <vector>

namespace berm::seepage
{
/// A point of the boundary where water leaves.
struct ExitPoint
{
  double distance = 0; ///< along the outlet from its first point [m]
  Vec2 at{0, 0};       ///< [m]
  double head = 0;     ///< [m]
  double normal = 0;   ///< hydraulic gradient along the outside normal, > 0 where water leaves [-]
  double upward = 0;   ///< hydraulic gradient upwards, -d head / dy [-]
  double flux = 0;     ///< out of the soil [m/s]
  bool faces_up = false; ///< the soil lies below, not beside or above
  Index soil = 0;        ///< index of the soil there
  /// Nearest place where the exact gradient has no bound, if one is nearer than the distance within
  /// which values say more about the mesh than about the soil.
  std::optional<Vec2> beside_singularity;
};

/// A part of one of the section's stretches through which water leaves without a break.
struct Outlet
{
  Index stretch = 0;             ///< index into Section::stretches
  double outflow = 0;            ///< [m2/s]
  std::vector<ExitPoint> points; ///< soil on the left; a sharp corner comes twice, once a side
  /// Index of the point with the largest normal gradient of those not beside a singularity; nothing
  /// if all are.
  std::optional<std::size_t> steepest;
  Polyline unbounded;   ///< the singularities that points lie beside, each once [m]
  double kept_away = 0; ///< how far from a singularity a point has to be to count [m]
};

/// @brief Hydraulic gradients where water leaves: heads, pools, seepage faces, drains.
/// From the reactions, which balance and converge fast, not from the elements' heads: the gradient
/// along the normal, linear between nodes, whose flux does at the nodes what the reactions are,
/// docs/theory.md eq. (2.22); at corners of less than 180 degrees of soil from the known heads on
/// both sides, eq. (2.23). Where the exact gradient has no bound (where a pervious stretch meets an
/// impervious one at more than 90 degrees, at corners of more than 180 degrees, at a waterline on a
/// seepage face) values within a fiftieth of the section's height are given, as means over an edge,
/// but do not count; the profile has a point where they begin to.
/// @param[in] boundary      One entry for each stretch, as it was solved with.
/// @param[in] conductivity  One entry for each soil index.
/// @return Outlets with more than 1e-7 of the discharge, none if only rounding flows.
[[nodiscard]] std::vector<Outlet> outlets(const Solution& solution,
                                          std::span<const Boundary> boundary,
                                          std::span<const Conductivity> conductivity);
} // namespace berm::seepage
