// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/observer.h"
#include "meshes/section.h"
#include "seepage/retention.h"
#include "seepage/solution.h"

#include <vector>

namespace berm::seepage
{
/// Hydraulic conductivity: principal values in wet soil, along axes turned by `angle` from x, and
/// how it falls with suction.
struct Conductivity
{
  double kx = 0, ky = 0; ///< [m/s], > 0
  double angle = 0;      ///< [rad], counter-clockwise
  Retention retention{};
};

enum class BoundaryKind
{
  impervious,
  head,         ///< value: head [m]
  seepage_face, ///< p = 0 where water comes out, no flow where it does not
  inflow,       ///< value: Darcy flux into the soil, on each side of an inner line [m/s]
  rain,    ///< value: rate on the horizontal [m/s], >= 0; what does not enter runs off at p = 0
  overflow ///< value: depth of the water over the crest [m]; docs/theory.md eq. (2.36)
};

struct Boundary
{
  BoundaryKind kind = BoundaryKind::impervious;
  double value = 0;
  double crest_x = 0; ///< of kind overflow: where the water comes from [m]
};

struct Settings
{
  /// Edge length of the first mesh [m]. 0: a 20th of the section's smaller extent or a 12th of the
  /// drop of the water, whichever is less, but not so small that it exceeds 10 000 triangles.
  double element_size = 0;
  bool adaptive = true;    ///< refine until the tolerances are met; else one mesh
  double tolerance = 3e-4; ///< of the discharge, relative [-]
  double phreatic_tolerance =
      0; ///< of the phreatic line [m]; 0: a thousandth of the water's height
  Index most_unknowns = 100'000; ///< a mesh with as many nodes is not refined
  /// Over all ranks of MPI, which all call alike and all get the solution; else each does all.
  bool distributed = false;
};

/// @brief Boundary conditions of the section's stretches: pools are heads, ground is a seepage
/// face, under rain if there is any, sides and base are impervious, marked lines are what the user
/// said.
/// @param[in] marked  One entry for each marked line; not rain for an inner one.
/// @param[in] rain    On open ground [m/s], >= 0.
[[nodiscard]] std::vector<Boundary> boundary_conditions(const meshes::Section& section,
                                                        const std::vector<Boundary>& marked,
                                                        double rain = 0);

/// @brief Solve steady unconfined Darcy flow on the section.
/// Saturated flow with a sharp free surface, or with a capillary fringe in soils that have a
/// retention curve; docs/theory.md section 2. When adaptive, the triangles that the error comes
/// from are cut, and the solve is repeated from the solution before, until the estimated errors are
/// within the tolerances; if they are not with the most unknowns allowed, or a finer mesh does not
/// converge, the observer is warned and the solution says so. A boundary of kind head acts as a
/// potential seepage face above its level. MPI and PETSc start with the first solve and end with
/// the process; the same input gives the same bits.
/// @param[in] conductivity  One entry for each soil index that the section uses.
/// @param[in] boundary      One entry for each stretch of the section.
/// @throws NotConverged if Newton, the active set or the water balance does not, or if the observer
///         asks to stop; with the history.
/// Where no head lies above its boundary and no inflow or rain is given, the soil is dry: the head
/// is that of the lowest point, nothing flows, and the observer is warned.
/// @throws InputError if a piece of the section has neither a head nor a seepage face, or has water
///         taken out and none put in; if a conductivity is missing or not positive.
/// @throws NumericalError naming the place if the pressure is not finite.
[[nodiscard]] Solution solve(const meshes::Section& section,
                             const std::vector<Conductivity>& conductivity,
                             const std::vector<Boundary>& boundary, const Settings& settings,
                             Observer& observer);

/// @brief The same on a given mesh, without refinement.
[[nodiscard]] Solution solve_on_mesh(const meshes::TriangleMesh& mesh,
                                     const std::vector<Conductivity>& conductivity,
                                     const std::vector<Boundary>& boundary, Observer& observer);
} // namespace berm::seepage
