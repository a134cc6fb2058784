// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/discretisation.h"
#include "sph/drucker_prager.h"
#include "sph/lanes.h"
#include "sph/particles.h"
#include "sph/soil_solver.h"

#include <span>
#include <vector>

namespace berm::sph
{
/// Steps the soil through time over a frozen discretisation. docs/theory.md section 3.
/// Gather form: a point's sums are taken by one thread in the list's order, so every bit of the
/// result is the same for any number of threads.
class TotalLagrangian final : public SoilSolver
{
public:
  /// @param[in] discretisation  Must outlive the solver.
  /// @param[in] cones           One for each soil; empty: linear elastic.
  /// @param[in] damping         Cundall's local damping: fraction of the net force [-], [0, 1).
  TotalLagrangian(const Discretisation& discretisation, std::vector<Cone> cones, double damping,
                  const State& start);

  /// @brief Advance by `steps` time steps. Cost O(steps n), no allocation.
  void advance(long steps) override;

  [[nodiscard]] double time() const override { return static_cast<double>(steps_) * d_.dt; }
  [[nodiscard]] double time_step() const override { return d_.dt; }
  [[nodiscard]] long steps() const override { return steps_; }

  /// Root mean square of the velocity over the mass [m/s].
  [[nodiscard]] double v_rms() const override;
  /// Largest displacement [m].
  [[nodiscard]] double max_displacement() const override;
  /// @throws NumericalError naming field, particle and time if a value is not finite.
  void check_finite() const override;
  [[nodiscard]] State state() const override;

private:
  void update_stress(std::size_t i); ///< pass A: velocity gradient, stress, viscous acceleration
  void update_motion(std::size_t i); ///< pass B: acceleration, damping, velocity, displacement
  void store_velocity(std::size_t i, double vx, double vy);
  void store_stress(std::size_t i, const SymTensor& sig);

  const Discretisation& d_;
  std::vector<Cone> cones_;
  double damping_;
  long steps_ = 0;
  std::vector<Lanes> v_; ///< {vx, vx, vy, vy} of particles and ghosts [m/s]
  std::vector<Lanes> T_; ///< sigma B, {xx, xy, yx, yy}, of particles and ghosts [Pa]
  std::vector<SymTensor> sig_;
  std::vector<double> ux_, uy_, plastic_strain_;
  std::vector<Vec2> viscous_; ///< acceleration by artificial viscosity [m/s2]
};
} // namespace berm::sph
