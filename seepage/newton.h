// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/solution.h"

#include <cstdint>
#include <span>
#include <vector>

/// The nonlinear solve on one mesh: Newton, the active set of the seepage face, and continuation in
/// the relative conductivity. Internal to seepage/.
namespace berm::seepage
{
/// @brief Relative conductivity, docs/theory.md eq. (2.5):
/// k_r = k_min + (1 - k_min) exp(min(p - eps w, 0) / eps). The forms of forms/flow.py use the same.
[[nodiscard]] double relative_conductivity(double p, double w, double eps, double k_min);

/// @brief Move the pressure head at a node by a Newton correction, docs/theory.md eq. (2.9).
/// Where a dry node gets wetter, the correction is one of the integral of k_r, which is nearly
/// linear in the flow, and not of p, which is its logarithm and would overshoot by orders of
/// magnitude.
[[nodiscard]] double moved_pressure(double p, double correction, double eps, double k_min);

/// Where the solve starts.
struct Start
{
  std::vector<double> p; ///< pressure head [m], shape (n)
  double smoothing = 0;  ///< first eps [m]
};

/// What the answer is smoothed with.
struct Smoothing
{
  std::vector<double> eps;   ///< in each triangle [m], shape (m)
  std::vector<double> k_min; ///< in each triangle [-], shape (m)
};

/// Against which rounding is judged.
struct Scales
{
  double height = 0;                    ///< of the water over the lowest point [m]
  std::span<const double> conductivity; ///< of each triangle [m/s], shape (m)
};

/// A converged pressure field.
struct Field
{
  std::vector<double> p; ///< pressure head [m], shape (n)
  std::vector<double>
      entering; ///< water that enters at each node, prescribed inflow left out [m2/s], shape (n)
  std::vector<std::uint8_t> active; ///< 1 on the active seepage face, shape (n)
  double inflow = 0, outflow = 0;   ///< [m2/s]; both 0 if nothing but rounding flows
  SolveHistory history;
};

/// @brief Solve docs/theory.md eq. (2.6) with the complementarity (2.4) on the seepage face.
/// @throws NotConverged with the history, also if the observer asks to stop.
[[nodiscard]] Field solve_field(FlowOperator& flow, const meshes::TriangleMesh& mesh,
                                const NodeConditions& conditions, const Smoothing& smoothing,
                                const Scales& scales, Start start, Observer& observer);
} // namespace berm::seepage
