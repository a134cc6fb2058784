// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"
#include "core/team.h"
#include "coupling/case.h"
#include "coupling/limit_equilibrium.h"
#include "coupling/readings.h"
#include "coupling/region.h"
#include "coupling/uncertainty.h"
#include "coupling/work_store.h"
#include "meshes/section.h"
#include "seepage/solution.h"
#include "sph/mechanism.h"
#include "sph/particles.h"
#include "sph/run_out.h"
#include "sph/strength_reduction.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace berm::coupling
{
/// The answer of one search: by what the strength in a region is divided when the slope fails, and
/// how it fails then.
struct FoundFactor
{
  Region region;
  double spacing = 0; ///< dx [m]
  sph::FactorOfSafety F;
  std::vector<SpacingFactor> coarser; ///< on particles 2 and 4 times as far apart, finest first
  std::optional<FlowRuleSpread> flow_rule;   ///< where asked for
  std::optional<sph::Mechanism> mechanism;   ///< of the failing trial
  std::optional<SlipCircle> critical_circle; ///< by limit equilibrium, to the side of the mechanism

  /// Nothing unless both ends are known.
  [[nodiscard]] std::optional<Bracket> bracket() const;
  [[nodiscard]] std::optional<DiscretisationError> discretisation() const;
  [[nodiscard]] std::optional<FactorRange> range() const;
};

/// What the soil stage leaves behind.
struct Stability
{
  sph::Particles particles;
  std::vector<double> pore_pressure; ///< p_w at the particles [Pa]
  sph::State settled;                ///< in elastic equilibrium, displacements set to zero
  double settlement = 0;             ///< largest displacement while settling [m]
  Polyline free_surface;             ///< the line of the hydrostatic mode; empty otherwise [m]
  std::vector<FoundFactor> searches; ///< in the order in which they ran; empty if not asked for
  double particle_steps = 0;         ///< particles times steps: settling, all trials, run-out [-]

  /// The search that speaks for the section, the first of equals: that which failed at the smallest
  /// factor; but one without an answer comes before all that failed above where it last stood.
  /// Pre: there is one.
  [[nodiscard]] const FoundFactor& governing() const;
};

/// Soil that failed and flowed.
struct RunOut
{
  double factor = 0;      ///< on strength
  bool from_trial = true; ///< went on from the failing trial; else from the settled state
  sph::RunOut motion;
  sph::FinalShape shape; ///< at the end of the motion
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
  Readings readings; ///< of the seepage; empty without one
  std::optional<Stability> stability;
  std::optional<RunOut> run_out;
  std::vector<StageSeconds> stages;
  bool interrupted = false; ///< the user asked to stop; what is here was computed before
};

/// Keeps the frames of a run-out, which take too much memory to hand over at the end.
class RunOutStore : public sph::FrameStore
{
public:
  /// Called before any frame, with what does not change from frame to frame.
  virtual void open(const sph::Particles& /*particles*/, double /*factor*/,
                    const sph::RunOutSettings& /*settings*/)
  {
  }
};

/// @brief The straight path: section, seepage, particles, pore pressure, settling, strength
/// reduction, mechanism, run-out. A stage that the case does not ask for is not built.
/// The ranks of a team all do all of it, but share the trials; all get the same analysis, except
/// that the run-out runs on rank 0 alone.
/// @param[in] work  Gives what was done of the same case before, and keeps what is done now.
[[nodiscard]] Analysis analyse(const Case& input, Observer& observer, RunOutStore& frames,
                               WorkStore& work, Team& team);
[[nodiscard]] Analysis analyse(const Case& input, Observer& observer, RunOutStore& frames);
[[nodiscard]] Analysis analyse(const Case& input, Observer& observer); ///< keeps nothing
} // namespace berm::coupling
