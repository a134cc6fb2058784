// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "sph/particles.h"
#include "sph/soil.h"

#include <numeric>

/// Sections and soils that several tests share.
namespace berm::tests
{
/// A block between rollers: ground at `height`, base at 0.
inline meshes::Section block(double length, double height)
{
  meshes::SectionInput input;
  input.ground = {{0, height}, {length, height}};
  input.base = {{0, 0}, {length, 0}};
  return meshes::build_section(input);
}

/// The two-sided embankment of Griffiths & Lane 1999, Ex. 6, and of Bui et al. 2009.
inline meshes::SectionInput embankment()
{
  meshes::SectionInput input;
  input.ground = {{0, 7.3}, {33.5, 7.3}, {99.83, 28.6}, {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};
  input.base = {{0, 0}, {191.4, 0}};
  return input;
}

/// The soil of that embankment.
inline sph::Soil embankment_soil()
{
  sph::Soil soil;
  soil.density = soil.saturated_density = 18.2e3 / gravity;
  soil.cohesion = 13.8e3;
  soil.friction_angle = 37 * pi / 180;
  soil.dilation_angle = 0;
  soil.young_modulus = 1e8;
  soil.poisson_ratio = 0.3;
  return soil;
}

inline void set_density(sph::Particles& particles, double density)
{
  particles.density.assign(particles.size(), density);
}

inline double total(const std::vector<double>& v)
{
  return std::accumulate(v.begin(), v.end(), 0.0);
}
} // namespace berm::tests
