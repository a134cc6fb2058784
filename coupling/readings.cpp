// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/readings.h"

namespace berm::coupling
{
Readings read_solution(const Case& input, const meshes::Section& section,
                       const seepage::Solution& solution)
{
  std::vector<seepage::Line> lines;
  for (const OutputLine& line : input.output.lines)
    lines.push_back(line.line);
  std::vector<seepage::Conductivity> conductivity;
  std::vector<double> buoyant_weight;
  Readings readings;
  for (const Soil& soil : input.soils)
  {
    conductivity.push_back(soil.conductivity.value());
    buoyant_weight.push_back(soil.mechanical.saturated_density * gravity - water_unit_weight);
    readings.critical_gradient.push_back(buoyant_weight.back() / water_unit_weight);
  }
  readings.lines = seepage::read_lines(solution, lines);
  readings.outlets = seepage::outlets(
      solution, seepage::boundary_conditions(section, input.marked_boundaries), conductivity);
  readings.heave = seepage::heave(solution, readings.outlets, buoyant_weight);
  return readings;
}
} // namespace berm::coupling
