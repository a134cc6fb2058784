// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/one_mesh.h"

#include "core/error.h"
#include "meshes/planar.h"
#include "seepage/indicator.h"
#include "seepage/phreatic.h"
#include "seepage/stream_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace berm::seepage
{
namespace
{
// Numbers of the method: docs/theory.md section 2.

// eps over the element size; where that does not converge, and from there on, the larger one [-].
constexpr double smoothing_share = 0.2, larger_smoothing_share = 0.5;
// Far above the free surface a soil conducts at most this share of its own conductivity, and at
// most that share of the least conductive soil's: a dry drain must not pass what a wet core does.
constexpr double k_min_own = 1e-5, k_min_lowest = 0.1, k_min_floor = 1e-11;

/// Geometric mean of the principal conductivities [m/s].
double mean(const Conductivity& k)
{
  return std::sqrt(k.kx * k.ky);
}

/// docs/theory.md eq. (2.3).
ConductivityTensor tensor(const Conductivity& k)
{
  const double c = std::cos(k.angle), s = std::sin(k.angle);
  return {.xx = c * c * k.kx + s * s * k.ky,
          .xy = c * s * (k.kx - k.ky),
          .yy = s * s * k.kx + c * c * k.ky};
}

/// Conductivity of each triangle. @throws InputError if one is missing or not positive.
std::vector<Conductivity> conductivities(const meshes::TriangleMesh& mesh,
                                         const std::vector<Conductivity>& of_soil)
{
  std::vector<Conductivity> result;
  result.reserve(mesh.triangles.size());
  for (const Index soil : mesh.triangle_soil)
  {
    const Conductivity k = static_cast<std::size_t>(soil) < of_soil.size()
                               ? of_soil[static_cast<std::size_t>(soil)]
                               : Conductivity{};
    if (!(k.kx > 0 && k.ky > 0 && std::isfinite(k.kx + k.ky + k.angle)))
      throw InputError(
          {{.key = fmt::format("conductivity_m_s of soil {}", soil + 1),
            .value = fmt::format("{:.6g}, {:.6g}", k.kx, k.ky),
            .problem = "the seepage solve needs the conductivity of every soil of the section",
            .allowed = "> 0",
            .hint = ""}});
    result.push_back(k);
  }
  return result;
}

/// Edge of the equilateral triangle of the same area [m].
std::vector<double> element_sizes(const meshes::TriangleMesh& mesh)
{
  std::vector<double> size;
  size.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles)
  {
    const Vec2& a = mesh.nodes[static_cast<std::size_t>(i)];
    const double twice_area = meshes::cross(mesh.nodes[static_cast<std::size_t>(j)] - a,
                                            mesh.nodes[static_cast<std::size_t>(k)] - a);
    size.push_back(std::sqrt(2 * twice_area / std::sqrt(3.0)));
  }
  return size;
}

void check_finite(const meshes::TriangleMesh& mesh, const std::vector<double>& p)
{
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isfinite(p[i]))
      throw NumericalError(fmt::format("seepage: the pressure head at ({:.6g}, {:.6g}) m is {}",
                                       mesh.nodes[i].x(), mesh.nodes[i].y(), p[i]));
}

/// k_r K of each triangle with the mean of k_r over its sides' middles [m/s], shape (m).
std::vector<ConductivityTensor> effective(const meshes::TriangleMesh& mesh,
                                          const std::vector<double>& p,
                                          const std::vector<double>& weight,
                                          const std::vector<RelativeConductivity>& laws,
                                          const std::vector<ConductivityTensor>& k_sat)
{
  std::vector<ConductivityTensor> result;
  result.reserve(k_sat.size());
  for (std::size_t t = 0; t < k_sat.size(); ++t)
  {
    double k_r = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto i = static_cast<std::size_t>(mesh.triangles[t][a]),
                 j = static_cast<std::size_t>(mesh.triangles[t][(a + 1) % 3]);
      k_r += relative_conductivity(laws[t], (p[i] + p[j]) / 2, (weight[i] + weight[j]) / 2) / 3;
    }
    result.push_back({k_r * k_sat[t].xx, k_r * k_sat[t].xy, k_r * k_sat[t].yy});
  }
  return result;
}

/// Head is known between nodes that have a given pressure, flow elsewhere.
BoundaryFlow boundary_flow(const meshes::TriangleMesh& mesh, const std::vector<Boundary>& boundary,
                           const NodeConditions& conditions, const Field& field)
{
  const std::size_t n = mesh.nodes.size(), edges = mesh.boundary.size();
  BoundaryFlow flow{.head_known = std::vector<std::uint8_t>(edges, 0),
                    .edge_inflow = std::vector<double>(edges, 0),
                    .reaction = std::vector<double>(n, 0)};
  const auto fixed = [&](std::size_t i)
  { return conditions.kind[i] == NodeKind::head || field.active[i]; };
  for (std::size_t i = 0; i < n; ++i)
    flow.reaction[i] = fixed(i) ? field.entering[i] : conditions.rain[i];
  for (std::size_t e = 0; e < edges; ++e)
  {
    const Boundary& condition = boundary[static_cast<std::size_t>(mesh.boundary_stretch[e])];
    const auto i = static_cast<std::size_t>(mesh.boundary[e][0]),
               j = static_cast<std::size_t>(mesh.boundary[e][1]);
    if (condition.kind == BoundaryKind::inflow)
      flow.edge_inflow[e] = condition.value * (mesh.nodes[j] - mesh.nodes[i]).norm();
    flow.head_known[e] = may_hold_pressure(condition.kind) && fixed(i) && fixed(j);
  }
  return flow;
}

/// What the indicator needs to know of the boundary: where the flow is given, and how much.
struct GivenFlow
{
  std::vector<std::uint8_t> given; ///< shape (b)
  std::vector<double> flux;        ///< into the soil [m/s], shape (b)
};

GivenFlow given_flow(const meshes::TriangleMesh& mesh, const std::vector<Boundary>& boundary,
                     const BoundaryFlow& flow)
{
  GivenFlow result;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const Boundary& condition = boundary[static_cast<std::size_t>(mesh.boundary_stretch[e])];
    result.given.push_back(!flow.head_known[e] && condition.kind != BoundaryKind::rain);
    result.flux.push_back(condition.kind == BoundaryKind::inflow ? condition.value : 0);
  }
  return result;
}

/// Largest eps of a triangle with wet and dry nodes [m]; 0 if there is none.
double surface_eps(const meshes::TriangleMesh& mesh, const std::vector<double>& p,
                   const std::vector<double>& eps)
{
  double largest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto at = [&](std::size_t a)
    { return p[static_cast<std::size_t>(mesh.triangles[t][a])]; };
    if (std::min({at(0), at(1), at(2)}) < 0 && std::max({at(0), at(1), at(2)}) > 0)
      largest = std::max(largest, eps[t]);
  }
  return largest;
}

/// Of each triangle -> the largest around each node, shape (n).
std::vector<double> largest_around(const meshes::TriangleMesh& mesh,
                                   const std::vector<double>& of_triangle)
{
  std::vector<double> at_node(mesh.nodes.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index node : mesh.triangles[t])
    {
      double& value = at_node[static_cast<std::size_t>(node)];
      value = std::max(value, of_triangle[t]);
    }
  return at_node;
}
} // namespace

MeshSolution solve_one_mesh(meshes::TriangleMesh mesh, const Problem& problem,
                            const std::optional<CoarserField>& coarser, Observer& observer)
{
  const Stopwatch watch;
  MeshSolution result;
  result.conditions = node_conditions(mesh, problem.boundary);
  const NodeConditions& conditions = result.conditions;
  if (!coarser)
    for (const std::string& text : conditions.warnings)
      observer.warn(text);
  double height = 0;
  for (const Vec2& x : mesh.nodes)
    height = std::max(height, conditions.highest_head - x.y());

  // Step 1: the conductivities and their smoothing.
  const std::vector<Conductivity> k_sat = conductivities(mesh, problem.conductivity);
  std::vector<ConductivityTensor> tensors;
  std::vector<double> k_mean, k_vertical;
  for (const Conductivity& k : k_sat)
  {
    tensors.push_back(tensor(k));
    k_mean.push_back(mean(k));
    k_vertical.push_back(tensors.back().yy);
  }
  const double k_low = std::ranges::min(k_mean);
  const std::vector<double> size = element_sizes(mesh);
  std::vector<RelativeConductivity> law_of_soil, laws;
  for (const Conductivity& k : problem.conductivity)
    law_of_soil.push_back(law_of(k.retention));
  const auto smooth_over = [&](double share)
  {
    laws.clear();
    for (std::size_t t = 0; t < k_sat.size(); ++t)
    {
      const double k_min = // docs/theory.md eq. (2.10)
          std::clamp(k_min_lowest * k_low / k_mean[t], k_min_floor, k_min_own);
      laws.push_back(on_mesh(law_of_soil[static_cast<std::size_t>(mesh.triangle_soil[t])],
                             share * size[t], k_min));
    }
  };
  result.smoothing_share = coarser ? coarser->smoothing_share : smoothing_share;
  smooth_over(result.smoothing_share);
  const bool curves = std::ranges::any_of(laws, [](const RelativeConductivity& law)
                                          { return law.curve.scale > 0; });

  // Step 2: the pressure.
  std::vector<double> weight = face_weight(mesh, conditions.face_edges);
  limit_weight(mesh, k_vertical, conditions.heaviest_rain, weight);
  FlowOperator flow(mesh, tensors, weight, {.curves = curves, .distributed = problem.distributed});
  const auto solve_here = [&]
  {
    return solve_by_strategies(flow, mesh, conditions, laws,
                               {.height = height, .conductivity = k_mean}, coarser,
                               result.smoothing_share == larger_smoothing_share, observer);
  };
  try
  {
    result.field = solve_here();
  }
  catch (const RoundingHidesFlow&)
  {
    throw;
  }
  catch (const NotConverged&)
  {
    if (observer.stop_requested() || result.smoothing_share == larger_smoothing_share)
      throw;
    observer.note("no convergence; now with the free surface smoothed over half an element");
    result.smoothing_share = larger_smoothing_share;
    smooth_over(result.smoothing_share);
    result.field = solve_here();
  }
  const std::vector<double>& p = result.field.p;
  check_finite(mesh, p);

  // Step 3: what is read off it.
  result.flux = flow.flux(p);
  result.effective = effective(mesh, p, weight, laws, tensors);
  result.phreatic_lines = zero_contours(mesh, p);
  result.exit_point = find_exit(mesh, conditions, result.field.entering, result.phreatic_lines);
  std::vector<double> eps;
  for (const RelativeConductivity& law : laws)
    eps.push_back(law.eps);
  result.eps = largest_around(mesh, eps);
  result.surface_eps = surface_eps(mesh, p, eps);
  const GivenFlow given = given_flow(
      mesh, problem.boundary, boundary_flow(mesh, problem.boundary, conditions, result.field));
  result.indicator = error_indicator(mesh, result.flux, k_mean, given.given, given.flux);
  result.mesh = std::move(mesh);
  result.field.history.seconds = watch.elapsed().wall;
  return result;
}

Solution finished(MeshSolution last, const Problem& problem)
{
  const Field& field = last.field;
  const std::size_t n = last.mesh.nodes.size();
  Solution solution;
  for (std::size_t i = 0; i < n; ++i)
  {
    solution.head.push_back(field.p[i] + last.mesh.nodes[i].y());
    solution.pore_pressure.push_back(water_unit_weight * field.p[i]);
  }
  solution.discharge = field.inflow;
  solution.inflow = field.inflow;
  solution.outflow = field.outflow;
  solution.balance = field.inflow > 0 ? std::abs(field.inflow - field.outflow) / field.inflow : 0;
  BoundaryFlow at_boundary = boundary_flow(last.mesh, problem.boundary, last.conditions, field);
  StretchWater water =
      stretch_water(last.mesh, problem.boundary, last.conditions, at_boundary.reaction);
  solution.stretch_inflow = std::move(water.inflow);
  solution.stretch_runoff = std::move(water.runoff);
  for (const double rain : last.conditions.rain)
    solution.rain += rain;
  solution.stream_function = field.inflow > 0
                                 ? stream_function(last.mesh, last.effective, solution.head,
                                                   at_boundary, field.inflow, problem.distributed)
                                 : std::vector<double>(n, 0);
  solution.reaction = std::move(at_boundary.reaction);
  solution.flux = std::move(last.flux);
  solution.phreatic_lines = std::move(last.phreatic_lines);
  solution.exit_point = last.exit_point;
  solution.mesh = std::move(last.mesh);
  solution.history = {field.history};
  return solution;
}
} // namespace berm::seepage
