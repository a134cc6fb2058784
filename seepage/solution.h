// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/stopwatch.h"
#include "core/tensor.h"
#include "meshes/triangle_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace berm::seepage
{
/// One nonlinear solve on one mesh.
struct SolveHistory
{
  Index unknowns = 0;
  std::string strategy; ///< from where it was solved: seepage/strategies.h
  int newton_steps = 0;
  int active_set_changes = 0;
  double residual = 0;     ///< |F_free| / q_in at the end [-]
  double discharge = 0;    ///< [m2/s]
  double seconds = 0;      ///< wall, mesh generation left out [s]
  double mesh_seconds = 0; ///< wall, mesh generation [s]
};

/// How far off the numbers are thought to be: by how much they changed from the last mesh but one
/// to the last, docs/theory.md eq. (2.18). Nothing where there was one mesh only.
struct ErrorEstimate
{
  std::optional<double> discharge;     ///< [m2/s]
  std::optional<double> phreatic_line; ///< root mean square of its distance [m]
  std::optional<double> exit_point;    ///< [m]
  std::vector<double> head;            ///< at the nodes, 0 in dry soil [m], shape (n) or empty
  bool within_tolerance = false;       ///< of discharge and phreatic line
};

/// Steady unconfined flow. Plain arrays; nothing of dolfinx or PETSc.
struct Solution
{
  meshes::TriangleMesh mesh;
  /// p / gamma_w + y at the nodes [m], shape (n); docs/theory.md eq. (2.1).
  std::vector<double> head;
  /// p at the nodes [Pa], compression positive, < 0 above the free surface, shape (n).
  std::vector<double> pore_pressure;
  /// Darcy flux k_r K (-grad head) in each triangle [m/s], shape (m).
  std::vector<Vec2> flux;
  /// Stream function at the nodes [m2/s], shape (n): q = (d psi / dy, -d psi / dx), from its own
  /// solve; docs/theory.md eq. (2.13). 0 if only rounding flows. On the two sides of a wall right
  /// through, each is counted from its own smallest value. Empty if water enters or leaves through
  /// a line inside the section that does not begin on its outline: then psi has many values.
  std::vector<double> stream_function;
  /// Water that enters at each node, prescribed inflow left out, rain that enters included [m2/s],
  /// shape (n).
  std::vector<double> reaction;
  /// p = 0 inside the soil [m], from left to right, longest first.
  std::vector<Polyline> phreatic_lines;
  /// Where the seepage face ends: its highest wet point, inside its edge [m]; docs/theory.md eq.
  /// (2.11).
  std::optional<Vec2> exit_point;
  double discharge = 0;           ///< what enters [m2/s], from reactions; 0 if only rounding flows
  double inflow = 0, outflow = 0; ///< both >= 0 [m2/s]
  double balance = 0;             ///< |inflow - outflow| / inflow [-]
  /// Water that enters through each of the section's stretches [m2/s], > 0 into the soil.
  std::vector<double> stretch_inflow;
  double rain = 0;                    ///< that falls on the section [m2/s]
  std::vector<double> stretch_runoff; ///< of it, what does not enter each stretch, >= 0 [m2/s]
  ErrorEstimate error;
  std::vector<SolveHistory> history; ///< one entry a mesh, coarse to fine
  Seconds seconds;
};

/// @brief Head or pore pressure at a point by linear interpolation; nothing if outside by more than
/// `max_shift` [m]. A point that lies outside by less takes the value of the nearest point of the
/// mesh. Cost O(m): for a few points only.
[[nodiscard]] std::optional<double> value_at(const Solution& solution,
                                             const std::vector<double>& nodal, const Vec2& point,
                                             double max_shift);

/// @brief Height of the (highest) phreatic line at x [m]; nothing where there is none.
[[nodiscard]] std::optional<double> phreatic_level(const Solution& solution, double x);
} // namespace berm::seepage
