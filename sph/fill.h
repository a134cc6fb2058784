// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "sph/particles.h"

#include <span>
#include <string>
#include <vector>

namespace berm::sph
{
/// @brief Fill the section with particles; soil index and geometry set, density left at zero.
/// "columns": columns of width dx, each with round(height / dx) particles of equal height, so that
///   area and surface are exact; column borders fall on vertical steps of the ground.
/// "lattice", "hexagonal": a lattice relaxed until it fits the outline, volumes those of the
///   Voronoi cells, cut off at the outline: for any section whose base is a function of x.
/// "auto": columns where ground and base are functions of x, the lattice elsewhere.
/// @param[in] spacing  dx [m], > 0.
/// @throws InputError if the spacing is too coarse for the section, "columns" does not fit, or the
///         base is not a function of x.
[[nodiscard]] Particles fill(const meshes::Section& section, double spacing,
                             const std::string& packing);

/// @brief Fill the section from seeds in any disorder: relaxed, with the volumes of their cells.
/// @param[in] seeds    Inside the section, about one for every dx^2 [m]; see sph/seeds.h.
/// @param[in] packing  What to call the packing in results.
/// @throws InputError as fill().
[[nodiscard]] Particles fill_from_seeds(const meshes::Section& section, std::vector<Vec2> seeds,
                                        double spacing, const std::string& packing);

/// @brief Particles at the given points, as they are, with the volumes of their Voronoi cells.
/// For studies of disorder: strength reduction on points that are not relaxed lies.
[[nodiscard]] Particles fill_cells(const meshes::Section& section, std::span<const Vec2> points,
                                   double spacing, const std::string& packing);

/// @brief A spacing that resolves the section: a fortieth of its height above the base [m].
[[nodiscard]] double default_spacing(const meshes::Section& section);
} // namespace berm::sph
