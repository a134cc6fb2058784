// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/comparison.h"

#include "coupling/pore_pressure.h"
#include "meshes/triangle_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace berm::coupling
{
namespace
{
constexpr int surface_steps = 400;

/// Slip line of the slope with seepage, if it was found.
Polyline slip_line(const Analysis& analysis)
{
  if (!analysis.stability || analysis.stability->searches.empty())
    return {};
  const auto& mechanism = analysis.stability->governing().mechanism;
  return mechanism ? mechanism->slip_line : Polyline{};
}

std::vector<double> pressure_at(const ComparedWater& water, const seepage::Solution& solution,
                                const Polyline& points)
{
  std::vector<double> x, y;
  for (const Vec2& p : points)
  {
    x.push_back(p.x());
    y.push_back(p.y());
  }
  const Stability& stability = *water.analysis.stability;
  switch (water.input.water.pore_pressure)
  {
  case PorePressureKind::seepage:
    return seepage_pore_pressure(solution, stability.particles.spacing)(x, y);
  case PorePressureKind::hydrostatic:
    return hydrostatic_pore_pressure(stability.free_surface)(x, y);
  case PorePressureKind::none:
    break;
  }
  return no_pore_pressure()(x, y);
}

std::optional<LineDifference> line_difference(const meshes::Section& section,
                                              const seepage::Solution& solution,
                                              const Polyline& assumed)
{
  LineDifference result{.mean = 0, .largest = 0, .at_x = section.x_min};
  int count = 0;
  for (int k = 0; k <= surface_steps; ++k)
  {
    const double x = section.x_min + (section.x_max - section.x_min) * k / surface_steps;
    const std::optional<double> level = seepage::phreatic_level(solution, x);
    if (!level)
      continue;
    const double above = *level - level_at(assumed, x);
    result.mean += above;
    if (std::abs(above) > std::abs(result.largest))
    {
      result.largest = above;
      result.at_x = x;
    }
    ++count;
  }
  if (count == 0)
    return std::nullopt;
  result.mean /= count;
  return result;
}

/// The waters to compare but the first.
std::vector<ComparedWater> other_waters(const Case& seeping, const Analysis& with_seepage)
{
  std::vector<ComparedWater> others;
  const auto add = [&](const char* name, const char* title, PorePressureKind kind)
  {
    ComparedWater& water = others.emplace_back();
    water.name = name;
    water.title = title;
    water.input = seeping;
    water.input.water.pore_pressure = kind;
    water.input.overrides.push_back(std::string("water.pore_pressure=\"") + to_string(kind) + '"');
  };
  if (with_seepage.section.single_valued)
  {
    add("phreatic", "hydrostatic below the phreatic line", PorePressureKind::hydrostatic);
    others.back().input.water.free_surface =
        phreatic_surface(with_seepage.section, *with_seepage.seepage);
  }
  const bool given = !seeping.water.free_surface.empty();
  if (given || !straight_free_surface(with_seepage.section).empty())
    add("hydrostatic",
        given ? "hydrostatic below the given line" : "hydrostatic below the straight line",
        PorePressureKind::hydrostatic);
  add("dry", "no water", PorePressureKind::none);
  Case& dry = others.back().input; // pools are left out with the water
  dry.water.left_level = dry.water.right_level = std::nullopt;
  dry.section.left_pool_level = dry.section.right_pool_level = std::nullopt;
  return others;
}
} // namespace

PressureDifference pressure_difference(const std::vector<double>& seepage,
                                       const std::vector<double>& other)
{
  PressureDifference d{.mean = 0,
                       .rms = 0,
                       .smallest = std::numeric_limits<double>::infinity(),
                       .largest = -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < seepage.size(); ++i)
  {
    const double difference = seepage[i] - other[i];
    d.mean += difference;
    d.rms += difference * difference;
    d.smallest = std::min(d.smallest, difference);
    d.largest = std::max(d.largest, difference);
  }
  const auto n = static_cast<double>(seepage.size());
  d.mean /= n;
  d.rms = std::sqrt(d.rms / n);
  return d;
}

Polyline phreatic_surface(const meshes::Section& section, const seepage::Solution& solution)
{
  const meshes::TriangleLocator locator(solution.mesh);
  const double height = section.y_max - section.y_min, width = section.x_max - section.x_min;
  // Head at the ground, where the soil there is wet. A node of the seepage face has p = 0.
  const auto wet_ground = [&](double x) -> std::optional<double>
  {
    const Vec2 ground(x, meshes::ground_level(section, x));
    const auto at = locator.locate(ground, 1e-3 * height);
    if (at.triangle < 0)
      return std::nullopt;
    const double head = meshes::interpolated(solution.mesh, solution.head, at);
    if (head < ground.y() - 1e-6 * height)
      return std::nullopt;
    return head;
  };
  Polyline surface;
  for (int k = 0; k <= surface_steps; ++k)
  {
    const double x = section.x_min + width * k / surface_steps;
    std::optional<double> level = wet_ground(x);
    if (!level)
      level = seepage::phreatic_level(solution, x);
    surface.emplace_back(x, level.value_or(section.y_min - height));
  }
  return surface;
}

Comparison compare(const Case& input, Observer& observer, Team& team,
                   const std::function<void(const ComparedWater&)>& done)
{
  Comparison result;
  RunOutStore no_frames;
  WorkStore keeps_nothing;
  Case seeping = input;
  seeping.run_out.reset();

  // Step 1: the slope with its seepage.
  ComparedWater& first = result.waters.emplace_back();
  first.name = "seepage";
  first.title = "steady seepage";
  first.input = seeping;
  first.analysis = analyse(seeping, observer, no_frames, keeps_nothing, team);
  done(first);
  if (!first.analysis.stability || first.analysis.interrupted)
    return result;
  const seepage::Solution solution = *first.analysis.seepage;
  const Polyline slip = slip_line(first.analysis);
  const std::vector<double> p_soil = first.analysis.stability->pore_pressure,
                            p_slip = pressure_at(first, solution, slip);

  // Step 2: the same soil with other waters.
  for (ComparedWater& water : other_waters(seeping, first.analysis))
  {
    if (team.any(observer.stop_requested()))
      break;
    observer.note(water.title);
    water.analysis = analyse(water.input, observer, no_frames, keeps_nothing, team);
    if (water.analysis.stability)
    {
      water.over_soil = pressure_difference(p_soil, water.analysis.stability->pore_pressure);
      if (!slip.empty())
        water.along_slip_line = pressure_difference(p_slip, pressure_at(water, solution, slip));
      if (water.name == "hydrostatic")
        result.line = line_difference(water.analysis.section, solution,
                                      water.analysis.stability->free_surface);
    }
    done(water);
    result.waters.push_back(std::move(water));
  }
  return result;
}
} // namespace berm::coupling
