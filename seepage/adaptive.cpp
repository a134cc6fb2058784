// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "meshes/mesher.h"
#include "meshes/planar.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/newton.h"
#include "seepage/phreatic.h"
#include "seepage/seepage.h"
#include "seepage/stream_function.h"
#include "seepage/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace berm::seepage
{
namespace
{
//------------------------------------------------------------------------------------------------
// Numbers of the method: docs/theory.md section 2
//------------------------------------------------------------------------------------------------

constexpr double smoothing_share = 0.5;  ///< eps over the element size [-]
constexpr double first_smoothing = 0.25; ///< eps at the start over the height of the water [-]
// Far above the free surface a soil conducts at most this share of its own conductivity, and at
// most that share of the least conductive soil's: a dry drain must not pass what a wet core does.
constexpr double k_min_own = 1e-5, k_min_lowest = 0.1, k_min_floor = 1e-9;

// Default element size: the height over so many, the drop of the water over so many, but the area
// not in more squares than this.
constexpr double elements_over_height = 20, elements_over_drop = 12, largest_default_mesh = 4000;
constexpr double refinement = 12; ///< default element size over the refined one
// The band that is refined: up to the first distance the refined size, from the second on the
// coarse one; over the element size. The line that it follows may leave out bends of so much of it.
constexpr double inner_share = 0.5, outer_share = 4, simplification = 0.1;
constexpr int refined_meshes = 2;         ///< at most, if the free surface moves out of the band
constexpr double unresolved_share = 0.02; ///< of the free surface's length that may lie outside it
constexpr double singular_angle = 5 * pi / 180; ///< beyond which a corner counts as singular [rad]

//------------------------------------------------------------------------------------------------
// One mesh
//------------------------------------------------------------------------------------------------

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

/// Hydrostatic with the highest head everywhere: the seepage face then shrinks to its extent.
Start full_of_water(const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
                    double height)
{
  Start start{.p = {}, .smoothing = first_smoothing * height};
  for (const Vec2& x : mesh.nodes)
    start.p.push_back(conditions.highest_head - x.y());
  return start;
}

Start from_coarser(const meshes::TriangleMesh& mesh, const Solution& coarser)
{
  Start start{.p = transfer(coarser.mesh, coarser.head, mesh.nodes),
              .smoothing = smoothing_share * std::ranges::max(element_sizes(coarser.mesh))};
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    start.p[i] -= mesh.nodes[i].y();
  return start;
}

/// k_r K of each triangle with the mean of k_r over its sides' middles [m/s], shape (m).
std::vector<ConductivityTensor> effective(const meshes::TriangleMesh& mesh,
                                          const std::vector<double>& p,
                                          const std::vector<double>& weight,
                                          const Smoothing& smoothing,
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
      k_r += relative_conductivity((p[i] + p[j]) / 2, (weight[i] + weight[j]) / 2, smoothing.eps[t],
                                   smoothing.k_min[t]) /
             3;
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

/// @param[in] coarser  Where to start, or nothing.
Solution solve_from(const Solution* coarser, meshes::TriangleMesh mesh,
                    const std::vector<Conductivity>& conductivity,
                    const std::vector<Boundary>& boundary, Observer& observer)
{
  const Stopwatch watch;
  const NodeConditions conditions = node_conditions(mesh, boundary);
  if (!coarser)
    for (const std::string& text : conditions.warnings)
      observer.warn(text);
  double height = 0;
  for (const Vec2& x : mesh.nodes)
    height = std::max(height, conditions.highest_head - x.y());

  const std::vector<Conductivity> k_sat = conductivities(mesh, conductivity);
  std::vector<ConductivityTensor> tensors;
  Smoothing smoothing{.eps = element_sizes(mesh), .k_min = {}};
  for (double& eps : smoothing.eps)
    eps *= smoothing_share;
  std::vector<double> k_mean, k_vertical;
  for (const Conductivity& k : k_sat)
  {
    tensors.push_back(tensor(k));
    k_mean.push_back(mean(k));
    k_vertical.push_back(tensors.back().yy);
  }
  const double k_low = std::ranges::min(k_mean);
  for (const double k : k_mean) // docs/theory.md eq. (2.10)
    smoothing.k_min.push_back(std::clamp(k_min_lowest * k_low / k, k_min_floor, k_min_own));

  std::vector<double> weight = face_weight(mesh, conditions.face_edges);
  limit_weight(mesh, k_vertical, conditions.heaviest_rain, weight);
  FlowOperator flow(mesh, tensors, weight);
  const auto solve_with = [&](Start start)
  {
    return solve_field(flow, mesh, conditions, smoothing,
                       {.height = height, .conductivity = k_mean}, std::move(start), observer);
  };
  std::optional<Field> warm;
  if (coarser)
    try
    {
      warm = solve_with(from_coarser(mesh, *coarser));
    }
    catch (const NotConverged&)
    {
      if (observer.stop_requested())
        throw;
      observer.note("the coarser mesh's solution was no good start; starting anew");
    }
  const Field field = warm ? std::move(*warm) : solve_with(full_of_water(mesh, conditions, height));
  check_finite(mesh, field.p);

  Solution solution;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
  {
    solution.head.push_back(field.p[i] + mesh.nodes[i].y());
    solution.pore_pressure.push_back(water_unit_weight * field.p[i]);
  }
  solution.flux = flow.flux(field.p);
  solution.phreatic_lines = zero_contours(mesh, field.p);
  solution.exit_point = find_exit(mesh, conditions, field.entering, solution.phreatic_lines);
  solution.discharge = field.inflow;
  solution.inflow = field.inflow;
  solution.outflow = field.outflow;
  solution.balance = field.inflow > 0 ? std::abs(field.inflow - field.outflow) / field.inflow : 0;
  const BoundaryFlow at_boundary = boundary_flow(mesh, boundary, conditions, field);
  StretchWater water = stretch_water(mesh, boundary, conditions, at_boundary.reaction);
  solution.stretch_inflow = std::move(water.inflow);
  solution.stretch_runoff = std::move(water.runoff);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    solution.rain += conditions.rain[i];
  solution.stream_function.assign(mesh.nodes.size(), 0);
  if (field.inflow > 0)
    solution.stream_function =
        stream_function(mesh, effective(mesh, field.p, weight, smoothing, tensors), solution.head,
                        at_boundary, field.inflow);
  solution.reaction = at_boundary.reaction;
  solution.mesh = std::move(mesh);
  solution.seconds = watch.elapsed();
  solution.history = {field.history};
  solution.history.back().seconds = solution.seconds.wall;
  return solution;
}

//------------------------------------------------------------------------------------------------
// Where and how fine
//------------------------------------------------------------------------------------------------

/// The line with a point where it crosses a level.
Polyline with_level(const Polyline& line, double level, double tolerance)
{
  Polyline result{line.front()};
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const Vec2 &a = line[k - 1], &b = line[k];
    if (std::min(a.y(), b.y()) < level - tolerance && std::max(a.y(), b.y()) > level + tolerance)
      result.emplace_back(a.x() + (level - a.y()) / (b.y() - a.y()) * (b.x() - a.x()), level);
    result.push_back(b);
  }
  return result;
}

/// The outline and inner lines with a vertex wherever they cross the head level of their stretch.
meshes::Section with_head_levels(const meshes::Section& section,
                                 const std::vector<Boundary>& boundary)
{
  meshes::Section result = section;
  result.outline.clear();
  result.edge_stretch.clear();
  const double tolerance =
      1e-9 * std::max(section.x_max - section.x_min, section.y_max - section.y_min);
  for (std::size_t k = 0; k < section.outline.size(); ++k)
  {
    const Vec2 &a = section.outline[k],
               &b = section.outline[meshes::next(k, section.outline.size())];
    const Index stretch = section.edge_stretch[k];
    const Boundary& condition = boundary[static_cast<std::size_t>(stretch)];
    result.outline.push_back(a);
    result.edge_stretch.push_back(stretch);
    const double level = condition.value;
    if (condition.kind == BoundaryKind::head && std::min(a.y(), b.y()) < level - tolerance &&
        std::max(a.y(), b.y()) > level + tolerance)
    {
      result.outline.push_back(a + (level - a.y()) / (b.y() - a.y()) * (b - a));
      result.outline.back().y() = level;
      result.edge_stretch.push_back(stretch);
    }
  }
  for (meshes::InnerLine& line : result.inner_lines)
    if (const Boundary& condition = boundary[static_cast<std::size_t>(line.stretch)];
        condition.kind == BoundaryKind::head)
      line.points = with_level(line.points, condition.value, tolerance);
  return result;
}

/// Edge length such that the section's height and the drop of the water have enough elements.
double default_element_size(const meshes::Section& section, const std::vector<Boundary>& boundary)
{
  double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
  const auto see = [&](const Boundary& condition, const Vec2& a, const Vec2& b)
  {
    if (condition.kind == BoundaryKind::head)
    {
      highest = std::max(highest, condition.value);
      lowest = std::min(lowest, condition.value);
    }
    else if (may_hold_pressure(condition.kind))
      lowest = std::min({lowest, a.y(), b.y()});
  };
  for (std::size_t k = 0; k < section.outline.size(); ++k)
    see(boundary[static_cast<std::size_t>(section.edge_stretch[k])], section.outline[k],
        section.outline[meshes::next(k, section.outline.size())]);
  for (const meshes::InnerLine& line : section.inner_lines)
    for (std::size_t k = 1; k < line.points.size(); ++k)
      see(boundary[static_cast<std::size_t>(line.stretch)], line.points[k - 1], line.points[k]);
  const double by_height = (section.y_max - section.y_min) / elements_over_height;
  const double by_drop = highest > lowest ? (highest - lowest) / elements_over_drop : by_height;
  const double by_area = std::sqrt(meshes::polygon_area(section.outline) / largest_default_mesh);
  return std::max(std::min(by_height, by_drop), by_area);
}

/// Douglas-Peucker: leave out points that lie within the tolerance of the line through those kept.
void keep_bends(const Polyline& line, std::size_t first, std::size_t last, double tolerance,
                Polyline& kept)
{
  double farthest = 0;
  std::size_t split = first;
  for (std::size_t k = first + 1; k < last; ++k)
    if (const double d = meshes::distance(line[k], line[first], line[last]); d > farthest)
    {
      farthest = d;
      split = k;
    }
  if (farthest <= tolerance)
  {
    kept.push_back(line[last]);
    return;
  }
  keep_bends(line, first, split, tolerance, kept);
  keep_bends(line, split, last, tolerance, kept);
}

/// Corners of the outline under water where the exact gradient is singular: between conditions of
/// the same kind if the soil's angle exceeds 180 deg, between flow and no flow if it exceeds 90
/// deg.
std::vector<Polyline> singular_corners(const meshes::Section& section,
                                       const std::vector<Boundary>& boundary,
                                       const Solution& solution, double element_size)
{
  const auto conducts = [&](std::size_t edge)
  {
    const BoundaryKind kind = boundary[static_cast<std::size_t>(section.edge_stretch[edge])].kind;
    return kind == BoundaryKind::head || kind == BoundaryKind::seepage_face;
  };
  std::vector<Polyline> corners;
  const std::size_t n = section.outline.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::size_t before = k > 0 ? k - 1 : n - 1;
    const Vec2& corner = section.outline[k];
    const Vec2 in = corner - section.outline[before],
               out = section.outline[meshes::next(k, n)] - corner;
    const double angle = pi - std::atan2(meshes::cross(in, out), in.dot(out));
    if (angle < (conducts(before) == conducts(k) ? pi : pi / 2) + singular_angle)
      continue;
    const std::optional<double> head = value_at(solution, solution.head, corner, element_size);
    if (head && *head > corner.y() - element_size)
      corners.push_back({corner, corner});
  }
  return corners;
}

/// Share of the length of the free surface that lies in triangles larger than wanted.
double unresolved(const Solution& solution, double refined_size)
{
  // Twice the wanted size: a mesher's triangles scatter.
  const std::vector<double> size = element_sizes(solution.mesh);
  double all = 0, coarse = 0;
  for (std::size_t t = 0; t < size.size(); ++t)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index i : solution.mesh.triangles[t])
    {
      low = std::min(low, solution.pore_pressure[static_cast<std::size_t>(i)]);
      high = std::max(high, solution.pore_pressure[static_cast<std::size_t>(i)]);
    }
    if (low < 0 && high > 0)
    {
      all += size[t];
      coarse += size[t] > 2 * refined_size ? size[t] : 0;
    }
  }
  return all > 0 ? coarse / all : 0;
}

void report(const Solution& solution, std::size_t number, Observer& observer)
{
  const SolveHistory& h = solution.history.back();
  observer.note(
      fmt::format("mesh {}: {} unknowns, {} Newton steps, q = {:.6g} m2/s, {:.2g} s + {:.2g} s for "
                  "the mesh",
                  number, h.unknowns, h.newton_steps, h.discharge, h.seconds, h.mesh_seconds));
}
} // namespace

Solution solve_on_mesh(const meshes::TriangleMesh& mesh,
                       const std::vector<Conductivity>& conductivity,
                       const std::vector<Boundary>& boundary, Observer& observer)
{
  Solution solution = solve_from(nullptr, mesh, conductivity, boundary, observer);
  report(solution, 1, observer);
  return solution;
}

Solution solve(const meshes::Section& section, const std::vector<Conductivity>& conductivity,
               const std::vector<Boundary>& boundary, const Settings& settings, Observer& observer)
{
  const Stopwatch watch;
  const meshes::Section drawn = with_head_levels(section, boundary);
  const double element_size =
      settings.element_size > 0 ? settings.element_size : default_element_size(drawn, boundary);
  const double refined_size =
      settings.refined_size > 0 ? settings.refined_size : element_size / refinement;

  std::vector<SolveHistory> history;
  const auto solve_with = [&](const meshes::ElementSize& size, const Solution* coarser)
  {
    const Stopwatch mesh_watch;
    meshes::TriangleMesh mesh = meshes::triangulate(drawn, size);
    const double mesh_seconds = mesh_watch.elapsed().wall;
    Solution solution = solve_from(coarser, std::move(mesh), conductivity, boundary, observer);
    solution.history.back().mesh_seconds = mesh_seconds;
    report(solution, history.size() + 1, observer);
    history.push_back(solution.history.back());
    return solution;
  };

  meshes::ElementSize size{.coarse = element_size, .fine = 0, .inner = 0, .outer = 0, .near = {}};
  Solution solution = solve_with(size, nullptr);
  for (int pass = 0; settings.adaptive && refined_size < element_size && pass < refined_meshes;
       ++pass)
  {
    size.fine = refined_size;
    size.inner = inner_share * element_size;
    size.outer = outer_share * element_size;
    size.near = singular_corners(drawn, boundary, solution, element_size);
    for (const Polyline& line : solution.phreatic_lines)
    {
      Polyline bends{line.front()};
      keep_bends(line, 0, line.size() - 1, simplification * element_size, bends);
      size.near.push_back(std::move(bends));
    }
    if (size.near.empty())
      break;
    solution = solve_with(size, &solution);
    if (unresolved(solution, refined_size) <= unresolved_share)
      break;
  }
  solution.history = std::move(history);
  solution.seconds = watch.elapsed();
  return solution;
}
} // namespace berm::seepage
