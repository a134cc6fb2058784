// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/observer.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/solution.h"

#include <cstdint>
#include <span>
#include <vector>

/// The nonlinear solve on one mesh: Newton, the active set of the seepage face, and continuation in
/// the smoothing. Internal to seepage/.
namespace berm::seepage
{
/// Where the solve starts.
struct Start
{
  std::vector<double> p; ///< pressure head [m], shape (n)
  double smoothing = 0;  ///< first eps [m]
};

/// A converged pressure field.
struct Field
{
  std::vector<double> p; ///< pressure head [m], shape (n)
  std::vector<double>
      entering; ///< water that enters at each node, loads included [m2/s], shape (n)
  std::vector<std::uint8_t> active; ///< 1 on the active seepage face, shape (n)
  double inflow = 0, outflow = 0;   ///< [m2/s]
  SolveHistory history;
};

/// @brief Solve docs/theory.md eq. (2.6) with the complementarity (2.3) on the seepage face.
/// @param[in] eps_final   Smoothing of the answer in each triangle [m], shape (m).
/// @param[in] flow_scale  Largest conductivity times height [m2/s]: flows below its rounding count
/// as none.
/// @throws NotConverged with the history, also if the observer asks to stop.
[[nodiscard]] Field solve_field(FlowOperator& flow, const NodeConditions& conditions,
                                std::span<const double> eps_final, double flow_scale, Start start,
                                Observer& observer);
} // namespace berm::seepage
