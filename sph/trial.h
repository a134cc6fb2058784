// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "sph/soil.h"
#include "sph/soil_model.h"
#include "sph/strength_reduction.h"

#include <span>
#include <string>
#include <vector>

namespace berm::sph
{
/// The state at rest under its own weight, and what it took to get there.
struct Settled
{
  State state; ///< displacement and velocity set to zero, positions kept
  double settlement =
      0; ///< largest displacement on the way [m]; 7-10 times gamma H^2/(2M) marks a bad packing
  long steps = 0;
};

/// @brief Let the soil settle under gravity and pore pressure from zero stress.
/// Every trial starts from this state.
/// @param[in] cones  Empty: elastically. Else with this strength, which must hold it.
/// @throws NotConverged if it does not come to rest; NumericalError on a value that is not finite.
[[nodiscard]] Settled settle(const SoilModel& model, Observer& observer,
                             std::vector<Cone> cones = {});

/// @brief Strength reduced by a factor: c, tan(phi) and the tensile strength first, then the cone;
/// psi is kept at or below phi_F.
/// @param[in] cone  "fitted" or "paper" (Bui et al. 2009 eq. 14 for every psi).
[[nodiscard]] std::vector<Cone> reduced_cones(std::span<const Soil> soils, double factor,
                                              const std::string& cone);

/// @brief Run the soil with given cones from the settled state until the verdict is known.
[[nodiscard]] Trial run_trial(const SoilModel& model, const State& settled, std::vector<Cone> cones,
                              double factor, Observer& observer);
} // namespace berm::sph
