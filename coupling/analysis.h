// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"
#include "coupling/case.h"
#include "coupling/limit_equilibrium.h"
#include "meshes/section.h"
#include "seepage/solution.h"
#include "sph/mechanism.h"
#include "sph/particles.h"
#include "sph/strength_reduction.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace berm::coupling
{
/// What the soil stage leaves behind.
struct Stability
{
  sph::Particles particles;
  std::vector<double> pore_pressure; ///< p_w at the particles [Pa]
  sph::State settled;                ///< in elastic equilibrium, displacements set to zero
  double settlement = 0;             ///< largest displacement while settling [m]
  Polyline free_surface;             ///< the line of the hydrostatic mode; empty otherwise [m]
  sph::FactorOfSafety factor_of_safety;
  std::optional<sph::Mechanism> mechanism;   ///< of the failing trial
  std::optional<SlipCircle> critical_circle; ///< by limit equilibrium, to the side of the mechanism
  double particle_steps = 0;                 ///< particles times steps, settling and all trials [-]
};

struct StageSeconds
{
  std::string stage;
  Seconds seconds;
};

/// All that a run found out. A stage that was not asked for, or not reached, is absent.
struct Analysis
{
  meshes::Section section;
  std::optional<seepage::Solution> seepage;
  std::optional<Stability> stability;
  std::vector<StageSeconds> stages;
  bool interrupted = false; ///< the user asked to stop; what is here was computed before
};

/// @brief The straight path: section, seepage, particles, pore pressure, settling, strength
/// reduction, mechanism.
[[nodiscard]] Analysis analyse(const Case& input, Observer& observer);
} // namespace berm::coupling
