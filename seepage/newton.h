// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"
#include "core/observer.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/solution.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// The nonlinear solve on one mesh: Newton, the active set of the seepage face, and continuation in
/// the relative conductivity. Internal to seepage/.
namespace berm::seepage
{
/// Where the solve starts.
struct Start
{
  std::vector<double> p; ///< pressure head [m], shape (n)
  double smoothing = 0;  ///< first eps [m]; 0: the final eps and k_min at once
  int most_steps = std::numeric_limits<int>::max(); ///< in the history; more count as a failure
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

/// No start and no level of smoothing gets any further.
class RoundingHidesFlow : public NotConverged
{
public:
  using NotConverged::NotConverged;
};

/// @brief Solve docs/theory.md eq. (2.6) with the complementarity (2.4) on the seepage face.
/// @param[in]     laws     k_r of the answer in each triangle, shape (m).
/// @param[in,out] history  Newton steps and changes of the set are added, the rest is replaced.
/// @throws NotConverged with the history, also if the observer asks to stop; names the cause if the
///         last iterate shows one; RoundingHidesFlow if that is it.
[[nodiscard]] Field solve_field(FlowOperator& flow, const meshes::TriangleMesh& mesh,
                                const NodeConditions& conditions,
                                std::span<const RelativeConductivity> laws, const Scales& scales,
                                Start start, SolveHistory& history, Observer& observer);
} // namespace berm::seepage
