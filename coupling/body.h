// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/team.h"
#include "coupling/case.h"
#include "coupling/pore_pressure.h"
#include "coupling/region.h"
#include "coupling/work_store.h"
#include "meshes/section.h"
#include "sph/discretisation.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "sph/updated_lagrangian.h"

#include <optional>
#include <vector>

/// The section on particles: what the searches and the run-out start from.
namespace berm::coupling
{
/// What all searches share.
struct Scene
{
  const Case& input;
  const meshes::Section& section;
  const std::vector<sph::Soil>& soils;
  const PorePressure& p_w;
  Team& team;
  WorkStore& work;
};

/// The soils, and again as held soil: what `strength_index` counts.
[[nodiscard]] std::vector<sph::Soil> with_held(const std::vector<sph::Soil>& soils);

/// Particles with the water in their pores.
struct Body
{
  sph::Particles particles;
  std::vector<double> pore_pressure; ///< [Pa]
  sph::Discretisation discretisation;
  std::optional<sph::MovingBody> moving; ///< in its place, in the paper's formulation
  sph::Settled settled;                  ///< where every trial starts

  /// A view, whichever way the motion is solved.
  [[nodiscard]] sph::SoilModel model() const
  {
    return moving ? sph::SoilModel(*moving) : sph::SoilModel(discretisation);
  }

  /// From now on, cones_in_region reduces the strength there.
  void reduce_in(const Region& region, std::size_t soils)
  {
    (moving ? moving->particles.soil : discretisation.soil) =
        strength_index(region, particles, soils);
  }

  [[nodiscard]] double particle_steps(double steps) const
  {
    return steps * static_cast<double>(particles.size());
  }
};

/// @brief Particles of a spacing [m], not yet settled.
/// @throws InputError if the packing would lie.
[[nodiscard]] Body make_body(const Scene& scene, double spacing);

/// @brief Settle the soil, or take it settled from the store.
/// @throws NotConverged as sph::settle.
void settle(Body& body, const Scene& scene, Observer& observer);

/// @brief The section on particles 2 and 4 times as far apart, settled, finest first.
/// They tell the search where to look, at an eighth and a 64th of the cost, and how much the factor
/// still changes with the spacing. Only as many as the section is fine enough for.
[[nodiscard]] std::vector<Body> coarser_bodies(const Scene& scene, Observer& observer);
} // namespace berm::coupling
