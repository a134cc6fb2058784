// SPDX-License-Identifier: GPL-3.0-or-later
// Any lines as texts of --set, on a sound case.
#include "app/case_file.h"
#include "core/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

namespace
{
constexpr const char* sound = R"(format = 1
[section]
ground_m = [[0, 5], [10, 5], [20, 10], [30, 10]]
base_m = 0.0
[[section.zone]]
soil = "core"
polygon_m = [[12, 0], [18, 0], [18, 4], [12, 4]]
[soil.fill]
unit_weight_kN_m3 = 18
cohesion_kPa = 10
friction_angle_deg = 30
dilation_angle_deg = 0
young_modulus_kPa = 1e5
poisson_ratio = 0.3
[soil.core]
unit_weight_kN_m3 = 18
cohesion_kPa = 10
friction_angle_deg = 30
dilation_angle_deg = 0
young_modulus_kPa = 1e5
poisson_ratio = 0.3
[water]
pore_pressure = "hydrostatic"
left_level_m = 7
[[output.line]]
points_m = [[1, 1], [2, 2]]
)";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  berm::app::ReadOptions options;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line);)
    options.overrides.push_back(line);
  berm::app::KeyPlaces places;
  try
  {
    static_cast<void>(berm::app::parse_case(sound, "/fuzz/case.toml", options, places));
  }
  catch (const berm::InputError& e)
  {
    if (berm::app::describe(e.mistakes(), places).find("mistake") == std::string::npos)
      std::abort();
  }
  catch (const berm::IoError&)
  {
  }
  return 0;
}
