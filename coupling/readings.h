// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/case.h"
#include "meshes/section.h"
#include "seepage/exit_gradient.h"
#include "seepage/heave.h"
#include "seepage/line_reading.h"
#include "seepage/solution.h"

#include <vector>

namespace berm::coupling
{
/// What an engineer reads of a seepage solution.
struct Readings
{
  std::vector<seepage::LineReading> lines; ///< one for each of Case::output.lines
  std::vector<seepage::Outlet> outlets;    ///< where water leaves
  std::vector<double> critical_gradient;   ///< gamma' / gamma_w of each soil [-]
  seepage::Heave heave;
};

/// @brief Read the solution with the case's soils and along its lines. Every soil of the case has
/// its conductivity, as the solve needed.
[[nodiscard]] Readings read_solution(const Case& input, const meshes::Section& section,
                                     const seepage::Solution& solution);
} // namespace berm::coupling
