// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/artificial_stress.h"
#include "sph/drucker_prager.h"
#include "sph/lanes.h"
#include "sph/moving_walls.h"
#include "sph/particles.h"
#include "sph/soil.h"
#include "sph/soil_solver.h"
#include "sph/stress_rate.h"
#include "sph/verlet_list.h"

#include <functional>
#include <span>
#include <vector>

namespace berm::sph
{
/// Which terms are on. The defaults suit soil that moves far.
struct UpdatedLagrangianSettings
{
  bool gradient_correction =
      false; ///< B_i of eq. (9.2) in strain and stress; exact on linear fields
  bool pressure_correction = true; ///< the same in the pore term (9.5)
  bool artificial_stress = false;  ///< eq. (9.7); not conservative: soil in tension gains energy
  bool viscosity_both_ways = true; ///< eq. (9.6) on recession as well as on approach
  bool geostatic_base = true;      ///< stress behind the base with its gradient, eq. (5.1)
  double local_damping = 0;        ///< zeta of eq. (3.8) [-], [0, 1)
  double alpha = 0.1, beta = 0.2;  ///< viscosity: linear, quadratic (on approach only) [-]
  double eps0 = 0.5;               ///< artificial stress over tension [-]
  double courant_number = 0.6;     ///< of eq. (9.9) [-]
  double gravity = berm::gravity;  ///< downwards [m/s2]
};

/// The literal form of Bui et al. 2009: no correction, stress behind the base copied, viscosity on
/// approach. Local damping is ours: their soil rings on for tens of seconds.
[[nodiscard]] UpdatedLagrangianSettings paper_settings();

/// Pore pressure [Pa], compression positive, at positions [m].
using PorePressureAt =
    std::function<std::vector<double>(std::span<const double> x, std::span<const double> y)>;

/// The body as it is filled: all that stays the same while the soil moves. Arrays have shape (n).
struct MovingBody
{
  Particles particles;
  std::vector<Elastic> elastic;      ///< of each soil
  std::vector<double> pore_pressure; ///< at the start [Pa]; empty: none
  PorePressureAt reread_pressure;    ///< at the current positions, when the list is made again
  MovingWalls walls;
  UpdatedLagrangianSettings settings;
  double T0 = 0, d_ref = 0; ///< scales of time [s] and displacement [m], as in Discretisation
};

[[nodiscard]] MovingBody moving_body(const Particles& particles, std::span<const Soil> soils,
                                     std::vector<double> p_w, const meshes::Section& section,
                                     const UpdatedLagrangianSettings& settings);

/// Where the energy is and where it went [J per m run]; docs/theory.md eq. (9.10).
struct Energies
{
  double kinetic = 0;
  double potential = 0; ///< of gravity, from y = 0
  double elastic = 0;
  double water = 0;   ///< work done on the soil by the pore pressure
  double shake = 0;   ///< work done on the soil by shaking its ground
  double plastic = 0; ///< dissipated, like the rest
  double viscous = 0;
  double damping = 0; ///< local damping and hard contact with walls

  /// Constant but for the error of the discretisation.
  [[nodiscard]] double total() const
  {
    return kinetic + potential + elastic - water - shake + plastic + viscous + damping;
  }
};

/// Steps soil that moves far: kernels between current positions. docs/theory.md section 9.
/// Gather form in the order of a Verlet list whose making does not depend on the number of threads:
/// every bit of the result is the same for any. Particles are kept sorted by cell; what goes in and
/// comes out is in the order of the particles as filled.
class UpdatedLagrangian final : public SoilSolver
{
public:
  /// @param[in] body   Must outlive the solver.
  /// @param[in] cones  One for each soil; empty: linear elastic.
  /// @param[in] start  Without positions: particles at their reference positions.
  /// @param[in] time_step  Of the step that led to the start [s]; 0: none did.
  UpdatedLagrangian(const MovingBody& body, std::vector<Cone> cones, const State& start,
                    double time_step = 0);

  /// Cost O(steps n); allocates only when the list is made again.
  void advance(long steps) override;
  /// Advance by at least `duration` [s], to within one step.
  void advance_for(double duration);

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] double time_step() const override { return dt_; }
  [[nodiscard]] long steps() const override { return steps_; }
  [[nodiscard]] double v_rms() const override;
  [[nodiscard]] double max_displacement() const override;
  void check_finite() const override;
  [[nodiscard]] State state() const override; ///< with positions and density
  [[nodiscard]] Energies energies() const;
  [[nodiscard]] Vec2 momentum() const; ///< [N s per m run]
  /// Smallest distance between two particles [m]. Cost O(n), for checks.
  [[nodiscard]] double closest_pair();
  [[nodiscard]] long rebuilds() const { return rebuilds_; }
  /// Processor time so far [s] of the search (ghosts, sort, list) and of the pore pressure's push.
  [[nodiscard]] double search_seconds() const { return search_seconds_; }
  [[nodiscard]] double push_seconds() const { return push_seconds_; }

  [[nodiscard]] std::vector<double> pore_pressure() const; ///< as last read [Pa], shape (n)

  /// From now on, accelerate all soil horizontally [m/s2], as seen from shaking ground.
  void set_shake(double acceleration);
  /// Prescribe velocities [m/s], shape (n).
  void set_velocity(std::span<const double> vx, std::span<const double> vy);

private:
  /// What neighbours read of a particle or ghost in the stress pass.
  struct alignas(64) Point
  {
    Lanes motion; ///< x, y, vx, vy
    Lanes matter; ///< mass, density, 1 / density, sound speed
  };
  /// The same in the force pass: sigma B / rho^2 and R / rho^2, {xx, xy, yx, yy}.
  struct alignas(64) Force
  {
    Lanes stress;
    Lanes repulsion;
  };
  /// What only the particle itself knows.
  struct Self
  {
    SymTensor sig;
    double plastic_strain = 0, density = 0; ///< density after the stress pass
    double x_start = 0, y_start = 0;        ///< displacement counts from here
    double x_list = 0, y_list = 0;          ///< where it was when the list was made
    double viscous_x = 0, viscous_y = 0;    ///< acceleration
    double push_x = 0, push_y = 0;          ///< acceleration by pore pressure
    double p_w = 0;
    double plastic = 0, viscous = 0, damping = 0, water = 0; ///< energies so far
    Index original = 0, soil = 0;
  };

  void step();
  void rebuild();
  [[nodiscard]] bool list_holds(); ///< whether it has all pairs within 2 h, for the next step
  [[nodiscard]] double longest_way() const; ///< that a particle may go on one list [m]
  void read_positions();                    ///< of particles and ghosts, to x_ and y_
  void sort_particles();
  void make_ghosts(double reach);
  [[nodiscard]] bool push_holds() const;     ///< whether soil is near where its push was taken
  void update_push();                        ///< acceleration by pore pressure
  [[nodiscard]] double first_moment() const; ///< sum of mass times x [kg per m run times m]
  template <bool corrected>
  double update_stress(Index i); ///< returns the particle's rate for eq. (9.9) [m/s]
  template <bool with_repulsion>
  double update_motion(Index i); ///< returns the squared way of the step [m2]
  void stop_at_walls(std::size_t i, double& x, double& y, double& vx, double& vy) const;
  void store_ghost_motion(std::size_t i);
  void store_force(std::size_t i, const SymTensor& B);

  const MovingBody& body_;
  const UpdatedLagrangianSettings& set_;
  std::vector<Cone> cones_;
  Index n_;
  double h_, skin_, dt_ = 0, dt_before_ = 0, time_ = 0;
  double way_ = 0; ///< at most this has anything gone since the list was made [m]
  double way_checked_ = 0, way_pushed_ = 0; ///< the same when the list was looked at, when pushed
  double slack_ = 0; ///< two points have to come nearer by this before the list misses one [m]
  double shake_ = 0, shake_work_ = 0, shaken_from_ = 0; ///< [m/s2], [J], first moment when set
  double stretch_ = 1; ///< a ghost moves at most this much faster than its source [-]
  long steps_ = 0, rebuilds_ = 0;
  double search_seconds_ = 0, push_seconds_ = 0;
  RepulsionTable table_;
  VerletList list_;
  std::vector<double> x_, y_; ///< scratch: positions
  std::vector<double> p_w_;   ///< scratch: pore pressure of particles and ghosts [Pa]
  std::vector<Self> self_;    ///< shape (n), sorted by cell
  std::vector<Point> point_;  ///< particles, then ghosts
  std::vector<Force> force_;  ///< likewise
  std::vector<char> repels_;  ///< likewise: repulsion is not zero
  std::vector<MovingGhost> ghost_;
  std::vector<Index> ghost_begin_;
};
} // namespace berm::sph
