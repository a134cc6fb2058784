// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sph/packing_check.h"
#include "sph/strength_reduction.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

namespace berm::tests
{
/// Factor of safety of the dry embankment on given particles, the middle of a bracket of 0.02;
/// throws if the packing is refused or the bracket stays open.
inline double dry_factor(sph::Particles particles, const meshes::Section& section)
{
  const std::vector<sph::Soil> soils = {embankment_soil()};
  set_density(particles, soils[0].density);
  const std::vector<double> dry(particles.size(), 0.0);
  const sph::Discretisation d = sph::discretise(particles, soils, dry, section);
  sph::require_sound_packing(sph::measure_packing(particles, d, section), particles);
  Observer silent;
  const sph::Settled settled = sph::settle(d, silent);
  sph::require_sound_settlement(settled.settlement, d, particles);
  const auto trial = [&](double factor, Observer& observer)
  {
    return sph::run_trial(d, settled.state, sph::reduced_cones(soils, factor, "fitted"), factor,
                          observer);
  };
  const sph::FactorOfSafety F =
      sph::reduce_strength(trial, {.lower = 2.2, .upper = 2.6, .tolerance = 0.02}, silent);
  return 0.5 * (F.stands.value() + F.fails.value());
}
} // namespace berm::tests
