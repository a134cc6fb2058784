// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "meshes/section.h"
#include "sph/drucker_prager.h"
#include "sph/particles.h"
#include "sph/soil.h"

#include <limits>
#include <span>
#include <string>
#include <vector>

/// Where the strength is reduced: docs/theory.md section 6.
namespace berm::coupling
{
/// The part of the section whose slopes are asked about.
enum class Side
{
  any,
  left,
  right,
  both ///< left and right, each in a search of its own
};

/// Where the case wants the strength to be reduced.
struct SearchScope
{
  Side side = Side::any;
  std::vector<Polyline> inside;  ///< polygons [m]; empty: everywhere
  std::vector<Polyline> outside; ///< polygons in which soil keeps its strength [m]
  double min_depth = 0; ///< of a further search, for mechanisms that reach deeper than this [m]; 0:
                        ///< none
};

/// Where one search reduces the strength; soil elsewhere is held.
struct Region
{
  std::string name = "everywhere"; ///< "left side, below 2 m"
  Side side = Side::any;
  double x_left = -std::numeric_limits<double>::infinity();
  double x_right = std::numeric_limits<double>::infinity(); ///< from x_left to x_right [m]
  std::vector<Polyline> inside, outside;                    ///< as in SearchScope
  double min_depth = 0; ///< the strength of soil nearer than this to the ground is held [m]
  Polyline ground;      ///< of the section, where there is a depth [m]

  [[nodiscard]] bool contains(const Vec2& point) const;
};

/// @brief One region for each search that the case asks for, in the order in which they run: left
/// before right, and for each side first all depths, then those below min_depth.
/// The left side of a section lies left of the far end of its crest, the right side right of the
/// other end: both have all of the crest. The crest is the ground at most a twentieth of the
/// ground's relief below its highest point; a camber does not end it.
/// @throws InputError if a side is asked for on which the ground does not fall from the crest.
[[nodiscard]] std::vector<Region> regions(const SearchScope& scope, const meshes::Section& section);

/// @brief All that the case's side and polygons allow, at any depth; both sides are any.
[[nodiscard]] Region allowed_region(const SearchScope& scope, const meshes::Section& section);

/// @brief Whether any soil lies in a region, as far as a grid of 200 x 200 points over it shows.
[[nodiscard]] bool holds_soil(const Region& region, const meshes::Section& section);

/// @brief Which cone each particle has in `cones_in_region`: that of its soil, or, held, that
/// `soils` farther on. Shape (n).
[[nodiscard]] std::vector<Index> strength_index(const Region& region,
                                                const sph::Particles& particles, std::size_t soils);

/// @brief Whether any particle lies in the region.
[[nodiscard]] bool holds_particles(const Region& region, const sph::Particles& particles);

/// @throws InputError if no particle lies in the region: it is thinner than they show.
void require_particles(const Region& region, const sph::Particles& particles);

/// @brief Cones of all soils with the strength divided by `factor`, then those of held soil, whose
/// strength is divided by min(factor, 1): full strength, but never weaker than what is searched.
[[nodiscard]] std::vector<sph::Cone> cones_in_region(std::span<const sph::Soil> soils,
                                                     double factor, const std::string& cone);
} // namespace berm::coupling
