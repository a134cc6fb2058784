// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/particles.h"

namespace berm::sph
{
/// A body of soil that steps through time: what settling, trials and run-out need to know of it.
/// Called once a window of many steps, never in a loop over particles.
class SoilSolver
{
public:
  SoilSolver() = default;
  SoilSolver(const SoilSolver&) = delete;
  SoilSolver& operator=(const SoilSolver&) = delete;
  virtual ~SoilSolver() = default;

  virtual void advance(long steps) = 0;
  [[nodiscard]] virtual double time() const = 0;      ///< simulated [s]
  [[nodiscard]] virtual double time_step() const = 0; ///< of the next step [s]
  [[nodiscard]] virtual long steps() const = 0;
  /// Root mean square of the velocity over the mass [m/s].
  [[nodiscard]] virtual double v_rms() const = 0;
  /// Largest displacement since the start [m].
  [[nodiscard]] virtual double max_displacement() const = 0;
  /// @throws NumericalError naming field, particle and time if a value is not finite.
  virtual void check_finite() const = 0;
  /// In the order of the particles as filled.
  [[nodiscard]] virtual State state() const = 0;
};
} // namespace berm::sph
