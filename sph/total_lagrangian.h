// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/discretisation.h"
#include "sph/drucker_prager.h"
#include "sph/pair_sums.h"
#include "sph/particles.h"
#include "sph/soil_solver.h"
#include "sph/wavefront.h"
#include "sph/wide_soil.h"

#include <variant>
#include <vector>

namespace berm::sph
{
/// What acts on the soil besides its stress.
struct TotalLagrangianTerms
{
  double viscosity = 1;    ///< factor on the artificial viscosity [-]
  bool body_forces = true; ///< gravity and the pore pressure's push
};

/// Steps the soil through time over a frozen discretisation: over its panels where it has some,
/// else over its list of neighbours. docs/theory.md section 3.
/// Gather form: a point's sums are taken by one thread in a fixed order, so every bit of the result
/// is the same for any number of threads.
class TotalLagrangian final : public SoilSolver
{
public:
  /// @param[in] discretisation  Must outlive the solver.
  /// @param[in] cones           One for each soil; empty: linear elastic.
  /// @param[in] damping         Cundall's local damping: fraction of the net force [-], [0, 1).
  TotalLagrangian(const Discretisation& discretisation, const std::vector<Cone>& cones,
                  double damping, const State& start, const TotalLagrangianTerms& terms = {});

  /// @brief Begin again from another state, without a new allocation; time and steps go on.
  void restart(const State& start);

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
  /// `wide_lanes` particles: what is theirs alone. Free lanes hold zeros and stay zero.
  struct Block
  {
    WideStress sig;                    ///< effective stress [Pa]
    Wide plastic_strain = {};          ///< [-]
    Wide ux = {}, uy = {};             ///< displacement [m]
    Wide fx = {}, fy = {};             ///< acceleration by artificial viscosity [m/s2]
    Wide Bxx = {}, Byy = {}, Bxy = {}; ///< gradient correction [-]
    Wide specific_volume = {};         ///< 1 / density [m3/kg]
    Wide bx = {}, by = {};             ///< body forces [m/s2]
    std::size_t soil = 0;              ///< in soils_
    std::size_t images_begin = 0, images_end = 0;
  };
  /// The mirror image of one lane behind a wall.
  struct Image
  {
    std::size_t lane = 0;
    Index point = 0;
    double sign_vx = 1, sign_vy = 1, sign_sxy = 1, sign_Bxy = 1;
    double lift = 0; ///< added to sigma_yy: the geostatic gradient below the base [Pa]
    double k = 0, friction = 0; ///< k and 3 alpha of the source's cone; 0: elastic
  };

  void make_blocks(const std::vector<Cone>& cones);
  void make_images(const std::vector<Cone>& cones, bool body_forces);
  template <class Sums>
  void update_stress(Sums& sums, std::size_t b); ///< pass A
  template <class Sums>
  void update_motion(Sums& sums, std::size_t b); ///< pass B
  template <class Sums>
  void store_velocity(Sums& sums, std::size_t b, const BlockVector& v) const;
  template <class Sums>
  void store_stress(Sums& sums, std::size_t b) const;

  const Discretisation& d_;
  bool elastic_;
  double damping_, viscosity_;
  long steps_ = 0;
  std::variant<ListSums, PanelSums> sums_;
  std::vector<Index> lane_; ///< of each particle: block times `wide_lanes` plus lane, shape (n)
  std::vector<Block> blocks_;
  std::vector<WideSoil> soils_; ///< each mixture of soils that occurs in a block
  std::vector<Image> images_;   ///< ordered by block
  Wavefront wavefront_;
};
} // namespace berm::sph
