// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "meshes/section.h"
#include "sph/particles.h"

#include <string>

namespace berm::sph
{
/// @brief Fill the section with particles; soil index and geometry set, density left at zero.
/// "columns": columns of width dx, each with round(height / dx) particles of equal height, so that
///   area and surface are exact; column borders fall on vertical steps of the ground.
/// "lattice": a square lattice clipped by the outline, volumes those of the clipped cells.
/// "auto": columns where ground and base are functions of x, the lattice elsewhere.
/// @param[in] spacing  dx [m], > 0.
/// @throws InputError if the spacing is too coarse for the section or "columns" does not fit.
[[nodiscard]] Particles fill(const meshes::Section& section, double spacing,
                             const std::string& packing);

/// @brief A spacing that resolves the section: a fortieth of its height above the base [m].
[[nodiscard]] double default_spacing(const meshes::Section& section);
} // namespace berm::sph
