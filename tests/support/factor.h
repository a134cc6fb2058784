// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/packing_check.h"
#include "sph/strength_reduction.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <utility>

namespace berm::tests
{
/// Factor of safety of the embankment on given particles, the middle of a bracket of 0.02; throws
/// if the packing is refused or the bracket stays open.
/// @param[in] p_w  At the particles [Pa].
inline double factor(sph::Particles particles, const meshes::Section& section,
                     const std::vector<double>& p_w, double lower, double upper)
{
  const std::vector<sph::Soil> soils = {embankment_soil()};
  set_density(particles, soils[0].density);
  const sph::Discretisation d = sph::discretise(particles, soils, p_w, section);
  sph::require_sound_packing(sph::measure_packing(particles, d, section), particles);
  Observer silent;
  const sph::Settled settled = sph::settle(d, silent);
  sph::require_sound_settlement(settled.settlement, d, particles);
  const auto trial = [&](double F, Observer& observer)
  { return sph::run_trial(d, settled.state, sph::reduced_cones(soils, F, "fitted"), F, observer); };
  // Brackets of 0.0125 to 0.014, 0.6 % of F: fine enough to tell 2 % apart.
  const sph::FactorOfSafety F =
      sph::reduce_strength(trial, {.lower = lower, .upper = upper, .tolerance = 0.007}, silent);
  return 0.5 * (F.stands.value() + F.fails.value());
}

inline double dry_factor(const sph::Particles& particles, const meshes::Section& section)
{
  return factor(particles, section, std::vector<double>(particles.size(), 0.0), 2.2, 2.6);
}
} // namespace berm::tests
