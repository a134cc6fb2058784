// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/strategies.h"

#include "core/error.h"
#include "seepage/head_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double first_smoothing = 0.25; ///< eps at the start over the height of the water [-]

// What a finer mesh may cost in all before the answer is left to the coarser one: Newton steps
// times unknowns, about a minute's, but some steps in any case. A sound solve takes 4 to 30 steps;
// behind tight cores one of 10 000 unknowns may take 600, one of 100 000 would take half an hour.
constexpr double work_of_finer_mesh = 6e6;
constexpr int least_steps_of_finer_mesh = 60;

// Behind tight cores the discrete equations have more than one solution. One that no water can have
// was seen a fourth of the range of the heads outside it; sound ones are inside, but in turned soil
// of 1e4 : 1 by up to 0.06 outside [-].
constexpr double largest_excess = 0.1;

struct Strategy
{
  std::string name;
  std::function<Start()> start;
};

/// Hydrostatic with the highest head everywhere: the seepage face then shrinks to its extent.
Start full_of_water(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                    double height)
{
  Start start{.p = {}, .smoothing = first_smoothing * height};
  for (const Vec2& x : mesh.nodes)
    start.p.push_back(conditions.highest_head - x.y());
  return start;
}

/// The coarser field for the final smoothing.
Start rescaled(const meshes::TriangleMesh& mesh, std::span<const RelativeConductivity> laws,
               const CoarserField& coarser)
{
  std::vector<double> eps(coarser.p.size(), 0), k_min(coarser.p.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index node : mesh.triangles[t])
    {
      const auto i = static_cast<std::size_t>(node);
      eps[i] = std::max(eps[i], laws[t].eps);
      k_min[i] = std::max(k_min[i], laws[t].k_min);
    }
  Start start{.p = coarser.p, .smoothing = 0};
  for (std::size_t i = 0; i < start.p.size(); ++i)
    start.p[i] = rescaled_pressure(coarser.p[i], coarser.eps[i], eps[i], k_min[i]);
  return start;
}

int most_steps(std::size_t unknowns)
{
  return std::max(least_steps_of_finer_mesh,
                  static_cast<int>(work_of_finer_mesh / static_cast<double>(unknowns)));
}

std::string_view last_line(std::string_view text)
{
  while (text.ends_with('\n'))
    text.remove_suffix(1);
  text.remove_prefix(text.rfind('\n') + 1);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}
} // namespace

double rescaled_pressure(double p, double eps_before, double eps, double k_min)
{
  if (p >= 0)
    return p;
  const double lowest = 1 + std::log(k_min); // of p / eps
  return eps * std::max(p / eps_before, lowest) + std::min(p - eps_before * lowest, 0.0);
}

Field solve_by_strategies(FlowOperator& flow, const meshes::TriangleMesh& mesh,
                          const NodeConditions& conditions,
                          std::span<const RelativeConductivity> laws, const Scales& scales,
                          const std::optional<CoarserField>& coarser, bool last_resort,
                          Observer& observer)
{
  std::vector<Strategy> strategies;
  if (coarser)
  {
    strategies.push_back({"coarser mesh", [&] { return Start{.p = coarser->p, .smoothing = 0}; }});
    strategies.push_back({"coarser mesh rescaled", [&] { return rescaled(mesh, laws, *coarser); }});
    strategies.push_back({"coarser mesh in steps", [&]
                          { return Start{.p = coarser->p, .smoothing = coarser->largest_eps}; }});
  }
  if (!coarser || last_resort)
    strategies.push_back(
        {"full section", [&] { return full_of_water(mesh, conditions, scales.height); }});

  SolveHistory history;
  for (std::size_t k = 0;; ++k)
    try
    {
      Start start = strategies[k].start();
      if (coarser)
        start.most_steps = most_steps(mesh.nodes.size());
      Field field =
          solve_field(flow, mesh, conditions, laws, scales, std::move(start), history, observer);
      field.history.strategy = strategies[k].name;
      const double excess = head_excess(mesh, conditions, field.p);
      if (excess > largest_excess)
        throw NotConverged(fmt::format("seepage: the solution found is not one of water: its heads "
                                       "leave the range that the boundary allows by {:.2g} of it",
                                       excess));
      return field;
    }
    catch (const RoundingHidesFlow&)
    {
      throw;
    }
    catch (const NotConverged& failure)
    {
      const bool spent = coarser && history.newton_steps >= most_steps(mesh.nodes.size());
      if (observer.stop_requested() || spent || k + 1 == strategies.size())
        throw;
      observer.note(fmt::format("no convergence from the {} ({}); now from the {}",
                                strategies[k].name, last_line(failure.what()),
                                strategies[k + 1].name));
    }
}
} // namespace berm::seepage
