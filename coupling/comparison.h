// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "core/team.h"
#include "coupling/analysis.h"
#include "coupling/case.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// One slope with different ideas of its water: what does the straight line cost?
namespace berm::coupling
{
/// Seepage pressure minus another water's [Pa], over points.
struct PressureDifference
{
  double mean = 0, rms = 0, smallest = 0, largest = 0;
};

/// @brief Over all points alike. Pre: as many of one as of the other, and at least one.
[[nodiscard]] PressureDifference pressure_difference(const std::vector<double>& seepage,
                                                     const std::vector<double>& other);

/// The slope with one kind of water.
struct ComparedWater
{
  std::string name;  ///< "seepage", "phreatic", "hydrostatic", "dry": its folder
  std::string title; ///< in words
  Case input;
  Analysis analysis;
  std::optional<PressureDifference> over_soil;       ///< at the particles
  std::optional<PressureDifference> along_slip_line; ///< of the slope with seepage
};

/// How far the phreatic line lies above the assumed one, over the x of the section where there is
/// free surface in the soil.
struct LineDifference
{
  double mean = 0, largest = 0; ///< [m], > 0 if the assumed line is too low
  double at_x = 0;              ///< of the largest [m]
};

struct Comparison
{
  std::vector<ComparedWater> waters;  ///< seepage first; those that were not reached are missing
  std::optional<LineDifference> line; ///< nothing without a hydrostatic run or a phreatic line
};

/// @brief The line below which hydrostatic pressure agrees with the seepage at the free surface:
/// the phreatic line; the head at the ground where the soil is wet up to it (under a pool, its
/// level); below the base where all soil is dry. In steps of a 400th of the section.
/// Pre: section.single_valued.
[[nodiscard]] Polyline phreatic_surface(const meshes::Section& section,
                                        const seepage::Solution& solution);

/// @brief All waters on the same particles: seepage; hydrostatic below the computed phreatic line
/// (if the ground is a function of x); hydrostatic below the case's line, by default the straight
/// one (if there is any); none.
/// @param[in] input  Pre: asks for seepage. Its run-out is left out.
/// @param[in] done   Called with each water once it is analysed, before the next begins.
[[nodiscard]] Comparison compare(const Case& input, Observer& observer, Team& team,
                                 const std::function<void(const ComparedWater&)>& done);
} // namespace berm::coupling
