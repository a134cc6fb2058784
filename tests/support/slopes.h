// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/case.h"
#include "tests/support/sections.h"

#include <utility>

/// Slopes as cases, built in code.
namespace berm::tests
{
/// psi = 0, E = 100 MPa, nu = 0.3.
/// @param[in] c  [kPa]  @param[in] phi  [degrees]  @param[in] gamma  [kN/m3]
inline sph::Soil soil(double c, double phi, double gamma)
{
  sph::Soil s = embankment_soil();
  s.density = s.saturated_density = gamma * 1e3 / gravity;
  s.cohesion = c * 1e3;
  s.friction_angle = phi * pi / 180;
  return s;
}

/// One soil on a level base; with a free surface, under hydrostatic pressure below it.
inline coupling::Case slope(Polyline ground, double base, const sph::Soil& s, double spacing,
                            Polyline free_surface = {})
{
  coupling::Case c;
  c.section.base = {{ground.front().x(), base}, {ground.back().x(), base}};
  c.section.ground = std::move(ground);
  c.soils = {{.name = "soil", .mechanical = s, .conductivity = {}}};
  c.sph.spacing = spacing;
  if (!free_surface.empty())
  {
    c.water.pore_pressure = coupling::PorePressureKind::hydrostatic;
    c.water.free_surface = std::move(free_surface);
  }
  return c;
}
} // namespace berm::tests
