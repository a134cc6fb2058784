// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/stopwatch.h"
#include "meshes/section.h"
#include "sph/updated_lagrangian.h"

#include <optional>
#include <string>
#include <vector>

namespace berm::sph
{
/// What soil that runs out is told. docs/theory.md section 11.
struct RunOutSettings
{
  double longest = 0;        ///< it is given up as still moving then [s]; 0: 40 sqrt(H/g)
  double frame_interval = 0; ///< time between frames [s]; 0: sqrt(H/g) / 2
  double shake = 0;          ///< horizontal acceleration of the ground to the left, which throws
                             ///< the soil to the right [m/s2]
  double shake_duration = 0; ///< from the start [s]
};

/// The soil at one moment of the run-out, complete: going on from a frame gives the same bits as
/// never having stopped.
struct Frame
{
  Index number = 0;
  double time = 0;         ///< since the start of the run-out [s]
  double time_step = 0;    ///< last one [s]
  double still_since = -1; ///< time from which nothing has moved; negative while something does [s]
  long steps = 0;
  State state;                       ///< with positions and densities
  std::vector<double> pore_pressure; ///< where the particles are now [Pa]
  Energies energies;
};

/// What is remembered of a frame.
struct Moment
{
  double time = 0; ///< [s]
  Energies energies;
  double max_displacement = 0; ///< [m]
};

[[nodiscard]] Moment moment_of(const Frame& frame);

/// Where frames are kept while the soil moves, and where a run-out that was stopped takes them
/// from.
class FrameStore
{
public:
  FrameStore() = default;
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;
  virtual ~FrameStore() = default;

  /// What there is of this run-out already.
  struct Kept
  {
    Frame last;
    std::vector<Moment> history; ///< of all frames, the last included
  };
  /// Called once: nothing, or what to go on from.
  virtual std::optional<Kept> kept() { return std::nullopt; }
  /// Called with every new frame, the first included.
  virtual void keep(const Frame& /*frame*/) {}
};

/// How a run-out went.
struct RunOut
{
  bool at_rest = false;
  double time = 0;         ///< simulated [s]
  double time_to_rest = 0; ///< since when nothing moved, if at rest [s]
  long steps = 0;
  std::vector<Moment> history; ///< one for each frame
  Frame last;
  double closest_pair = 0;  ///< in the last frame [m]
  bool interrupted = false; ///< the user asked to stop
  Seconds seconds;
};

/// @brief The first frame of a run-out from a state of the same body, e.g. a failing trial.
[[nodiscard]] Frame first_frame(const MovingBody& body, const State& start);

/// @brief Let the soil move until it rests or the time is up.
/// At rest: for sqrt(H/g), kinetic energy and dissipation are small, docs/theory.md eq. (11.1).
/// A run-out that was stopped goes on from the last frame that was kept.
/// @param[in] cones   One for each soil.
/// @param[in] height  Of the section [m].
/// @throws NumericalError naming field, particle and time if a value is not finite.
[[nodiscard]] RunOut run_out(const MovingBody& body, const std::vector<Cone>& cones,
                             const Frame& first, double height, const RunOutSettings& settings,
                             FrameStore& frames, Observer& observer);

/// What has become of the section. docs/theory.md section 11.
struct FinalShape
{
  Polyline surface;            ///< of the soil, packed, left to right [m]
  double moved_volume = 0;     ///< soil that moved by more than 1 % of the section's height [m2]
  double max_displacement = 0; ///< [m]
  std::string side;            ///< "left" or "right": where most went; empty if nothing moved
  std::optional<Vec2> toe;     ///< of the slope as drawn, on that side [m]
  std::optional<Vec2> tip; ///< where the surface last stands 1 % of the height above its start [m]
  std::optional<double> run_out; ///< from the toe to the tip, along x; negative if short of it [m]
  double crest_settlement = 0;   ///< by how much the highest ground is lower [m]
};

/// @brief Measure the soil after it moved against the section as drawn.
[[nodiscard]] FinalShape final_shape(const Particles& particles, const State& state,
                                     const meshes::Section& section);
} // namespace berm::sph
