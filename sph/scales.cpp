// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/scales.h"

#include "core/tensor.h"
#include "sph/drucker_prager.h"

#include <cmath>

namespace berm::sph
{
Scales body_scales(const Particles& particles, std::span<const Soil> soils, double height)
{
  double slowness = 0, compliance = 0, volume = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const Soil& soil = soils[static_cast<std::size_t>(particles.soil[i])];
    const Elastic e = elastic_moduli(soil.young_modulus, soil.poisson_ratio);
    slowness += particles.volume[i] * std::sqrt(particles.density[i] / e.G);
    compliance += particles.volume[i] * (particles.density[i] * gravity / soil.young_modulus);
    volume += particles.volume[i];
  }
  return {.T0 = height * (slowness / volume), .d_ref = height * height * (compliance / volume)};
}
} // namespace berm::sph
