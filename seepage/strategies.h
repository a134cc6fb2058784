// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seepage/newton.h"

#include <optional>
#include <span>
#include <vector>

/// From where the nonlinear solve is tried. Internal to seepage/.
namespace berm::seepage
{
/// A coarser mesh's solution at the nodes of the present mesh.
struct CoarserField
{
  std::vector<double> p;      ///< pressure head [m], shape (n)
  std::vector<double> eps;    ///< smoothing of k_r that it was solved with [m], shape (n)
  double largest_eps = 0;     ///< of the coarser mesh [m]
  double smoothing_share = 0; ///< eps over the element size there [-]
};

/// @brief Dry soil through which water trickles has the k_r that conducts it, whatever eps is:
/// p / eps stays, down to eps (1 + ln k_min), below which the floor governs and p moves along.
[[nodiscard]] double rescaled_pressure(double p, double eps_before, double eps, double k_min);

/// @brief The field, by the first of these that converges (docs/theory.md, "Solution"):
/// "coarser mesh": from its solution, at the final smoothing at once;
/// "coarser mesh rescaled": likewise, rescaled for soil through which water trickles;
/// "coarser mesh in steps": from its solution, smoothed as there, then less from level to level;
/// "full section": from h = H everywhere, likewise; on the first mesh and as a last resort, since
/// behind tight cores it may take hundreds of steps.
/// A field whose heads leave the range that the boundary allows by a tenth of it counts as none.
/// On a finer mesh all of them together have a budget of Newton steps.
/// The observer is told of each that fails. The history counts the steps of all, and names the one
/// that answered.
/// @param[in] coarser      Nothing on the first mesh.
/// @param[in] last_resort  Whether no larger smoothing is left to try.
/// @throws NotConverged with the history of the last if none does, or if the observer asks to stop.
[[nodiscard]] Field solve_by_strategies(FlowOperator& flow, const meshes::TriangleMesh& mesh,
                                        const NodeConditions& conditions,
                                        std::span<const RelativeConductivity> laws,
                                        const Scales& scales,
                                        const std::optional<CoarserField>& coarser,
                                        bool last_resort, Observer& observer);
} // namespace berm::seepage
