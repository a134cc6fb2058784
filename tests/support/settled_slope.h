// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/pore_pressure.h"
#include "sph/discretisation.h"
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/total_lagrangian.h"
#include "sph/trial.h"
#include "tests/support/slopes.h"

#include <memory>
#include <vector>

namespace berm::tests
{
/// What the engine keeps to itself and a factor of safety must not depend on.
struct Numerics
{
  double damping = 0.8;        ///< Cundall's [-]
  double time_step_factor = 1; ///< [-]
};

/// A slope of one soil at rest under its own weight, with its parts open to whoever studies trials.
class SettledSlope
{
public:
  explicit SettledSlope(const coupling::Case& slope, const Numerics& numerics = {})
      : section(meshes::build_section(slope.section)),
        particles(sph::fill(section, slope.sph.spacing, slope.sph.packing)),
        soils{slope.soils.front().mechanical}, discretisation(discretise(slope)),
        model(discretisation)
  {
    discretisation.dt *= numerics.time_step_factor;
    model.solver = [this, numerics](const std::vector<sph::Cone>& cones, const sph::State& start) {
      return std::make_unique<sph::TotalLagrangian>(discretisation, cones, numerics.damping, start);
    };
    Observer silent;
    state = sph::settle(model, silent).state;
  }
  SettledSlope(const SettledSlope&) = delete;
  SettledSlope& operator=(const SettledSlope&) = delete;

  [[nodiscard]] std::vector<sph::Cone> cones(double factor) const
  {
    return sph::reduced_cones(soils, factor, "fitted");
  }

  [[nodiscard]] sph::Trial trial(double factor) const
  {
    Observer silent;
    return sph::run_trial(model, state, cones(factor), factor, silent);
  }

  [[nodiscard]] sph::FactorOfSafety factor_of_safety(const sph::SearchSettings& search) const
  {
    Observer silent;
    return sph::reduce_strength([this](double factor, Observer&) { return trial(factor); }, search,
                                silent);
  }

  meshes::Section section;
  sph::Particles particles;
  std::vector<sph::Soil> soils;
  sph::Discretisation discretisation;
  sph::SoilModel model;
  sph::State state; ///< where every trial starts

private:
  sph::Discretisation discretise(const coupling::Case& slope)
  {
    const coupling::PorePressure pore_pressure =
        slope.water.free_surface.empty()
            ? coupling::no_pore_pressure()
            : coupling::hydrostatic_pore_pressure(slope.water.free_surface);
    const std::vector<double> p_w = pore_pressure(particles.x, particles.y);
    for (std::size_t i = 0; i < particles.size(); ++i)
      particles.density[i] = p_w[i] > 0 ? soils[0].saturated_density : soils[0].density;
    return sph::discretise(particles, soils, p_w, section);
  }
};
} // namespace berm::tests
