// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "seepage/solution.h"

#include <vector>

namespace berm::seepage
{
/// A line along which a solution is read.
struct Line
{
  /// At least two, no two in a row the same; inside the mesh or on its boundary [m].
  Polyline points;
  int samples = 101; ///< equally spaced, >= 2
};

/// What the solution says at a point of a line.
struct LineSample
{
  double distance = 0;      ///< along the line from its first point [m]
  Vec2 at{0, 0};            ///< [m]
  double head = 0;          ///< [m]
  double pore_pressure = 0; ///< < 0 above the free surface [Pa]
  Vec2 flux{0, 0};          ///< Darcy flux [m/s]
  double gradient = 0;      ///< |grad head| [-]
};

/// The push of the water on one side of a line, as on the underside of a structure. What is under
/// suction is not pushed.
struct WaterForce
{
  /// Resultant, to the left of the line's direction: upwards on a line drawn from left to right
  /// [N/m].
  Vec2 force{0, 0};
  double moment = 0;   ///< about the line's first point, positive counter-clockwise [N m/m]
  double pressure = 0; ///< integral of the pressure along the line; on a straight one |force| [N/m]
  /// Centre of the pressure, along the line from its first point; where the resultant acts if the
  /// line is straight. 0 if there is no pressure [m].
  double distance = 0;
  Vec2 at{0, 0}; ///< that point [m]
};

struct LineReading
{
  double length = 0; ///< [m]
  std::vector<LineSample> samples;
  /// Water that passes to the left of the line's direction [m2/s].
  double discharge = 0;
  bool by_stream_function = true; ///< else by integrating the flux, which is less accurate
  WaterForce water;
};

/// @brief Read a solution along polylines.
/// Head and pressure are the linear field of the elements. Flux and gradient at a sample are means
/// over the triangles around each node that share the sample's soil and are wet (or not) like it,
/// interpolated: nearly an order better than those of a single triangle, and they still jump where
/// soils meet. The discharge is the difference of the stream function at the ends, docs/theory.md
/// eq. (2.20), or, where the solution has none, the integral of the flux. The force, eq. (2.21), is
/// exact for the linear field; neither depends on the number of samples. Cost O(m) for each
/// segment.
/// @return One entry for each line.
/// @throws NumericalError if a line leaves the mesh by more than 1e-4 of its extent: a line on a
///         marked line may lie so far off.
[[nodiscard]] std::vector<LineReading> read_lines(const Solution& solution,
                                                  const std::vector<Line>& lines);
} // namespace berm::seepage
