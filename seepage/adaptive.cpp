// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "meshes/mesher.h"
#include "meshes/planar.h"
#include "seepage/first_mesh.h"
#include "seepage/head_bounds.h"
#include "seepage/one_mesh.h"
#include "seepage/refinement.h"
#include "seepage/seepage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace berm::seepage
{
namespace
{
/// Of the indicators' sum over the dissipated energy: what a solution is off by at least,
/// docs/theory.md eq. (2.19).
constexpr double least_error_share = 0.1;
constexpr double phreatic_tolerance_share = 1e-3; ///< of the height of the water, by default
constexpr double silent_excess = 1e-3;            ///< of heads over their range [-]
constexpr std::size_t most_distances = 500; ///< of a phreatic line from that of the mesh before

double distance_from(const std::vector<Polyline>& lines, const Vec2& point)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const Polyline& line : lines)
    nearest = std::min(nearest, meshes::distance(point, line));
  return nearest;
}

/// Root mean square along the lines of their distance from the other lines [m]; 0 if there are
/// none. Of a line of very many pieces, some in equal steps.
double distance_between(const std::vector<Polyline>& lines, const std::vector<Polyline>& others)
{
  double sum = 0, length = 0;
  if (!others.empty())
    for (const Polyline& line : lines)
      for (std::size_t k = 1; k < line.size(); k += 1 + line.size() / most_distances)
      {
        const double piece = (line[k] - line[k - 1]).norm();
        const double d = distance_from(others, (line[k] + line[k - 1]) / 2);
        sum += piece * d * d;
        length += piece;
      }
  return length > 0 ? std::sqrt(sum / length) : 0;
}

/// What the error indicators say of the discharge, relative to it.
double indicated_error(const MeshSolution& solution)
{
  double sum = 0, dissipated = 0; // [m3/s]: flux times the drop of the head
  for (std::size_t t = 0; t < solution.flux.size(); ++t)
  {
    const ConductivityTensor& k = solution.effective[t];
    const Vec2& q = solution.flux[t];
    const auto& [a, b, c] = solution.mesh.triangles[t];
    const auto node = [&](Index i) -> const Vec2&
    { return solution.mesh.nodes[static_cast<std::size_t>(i)]; };
    const double area = meshes::cross(node(b) - node(a), node(c) - node(a)) / 2;
    sum += solution.indicator[t];
    dissipated += area * (k.yy * q.x() * q.x() - 2 * k.xy * q.x() * q.y() + k.xx * q.y() * q.y()) /
                  (k.xx * k.yy - k.xy * k.xy);
  }
  return dissipated > 0 ? least_error_share * sum / dissipated : 0;
}

/// Of one mesh: if nothing flows the head is linear, hence exact on any; else it does not tell.
ErrorEstimate first_estimate(const MeshSolution& now)
{
  if (now.field.inflow > 0)
    return {};
  return {.discharge = 0,
          .phreatic_line = 0,
          .exit_point = {},
          .head = std::vector<double>(now.field.p.size(), 0)};
}

/// How far a solution is from that of the mesh before.
ErrorEstimate estimate(const MeshSolution& now, const MeshSolution& before,
                       const std::vector<double>& p_before)
{
  ErrorEstimate error;
  error.discharge = std::max(std::abs(now.field.inflow - before.field.inflow),
                             indicated_error(now) * now.field.inflow);
  error.phreatic_line = distance_between(now.phreatic_lines, before.phreatic_lines);
  if (now.exit_point && before.exit_point)
    error.exit_point = (*now.exit_point - *before.exit_point).norm();
  error.head.reserve(p_before.size());
  for (std::size_t i = 0; i < p_before.size(); ++i)
    error.head.push_back(now.field.p[i] >= 0 ? std::abs(now.field.p[i] - p_before[i]) : 0);
  return error;
}

double height_of_water(const MeshSolution& solution)
{
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2& x : solution.mesh.nodes)
    lowest = std::min(lowest, x.y());
  return std::max(solution.conditions.highest_head - lowest, 0.0);
}

void report(const SolveHistory& h, const ErrorEstimate& error, std::size_t number,
            Observer& observer)
{
  std::string off = " m2/s";
  if (error.discharge)
    off = fmt::format(" +- {:.1e} m2/s, phreatic line +- {:.2g} m", *error.discharge,
                      error.phreatic_line.value_or(0));
  observer.note(fmt::format("mesh {}: {} unknowns, {} Newton steps, q = {:.6g}{}; {:.2g} s + "
                            "{:.2g} s for the mesh",
                            number, h.unknowns, h.newton_steps, h.discharge, off, h.seconds,
                            h.mesh_seconds));
}
} // namespace

Solution solve_on_mesh(const meshes::TriangleMesh& mesh,
                       const std::vector<Conductivity>& conductivity,
                       const std::vector<Boundary>& boundary, Observer& observer)
{
  const Problem problem{conductivity, boundary};
  MeshSolution solution = solve_one_mesh(mesh, problem, std::nullopt, observer);
  report(solution.field.history, {}, 1, observer);
  return finished(std::move(solution), problem);
}

Solution solve(const meshes::Section& section, const std::vector<Conductivity>& conductivity,
               const std::vector<Boundary>& boundary, const Settings& settings, Observer& observer)
{
  const Stopwatch watch;
  const Problem problem{conductivity, boundary, settings.distributed};
  const Stretching stretching(section, conductivity);
  const meshes::Section with_levels = with_head_levels(section, boundary);
  const meshes::Section drawn = stretching.stretched(with_levels);

  // Step 1: a mesh that shows the section.
  Stopwatch mesh_watch;
  const double edge_length = settings.element_size > 0
                                 ? settings.element_size
                                 : default_element_size(with_levels, boundary, drawn);
  meshes::TriangleMesh mesh = stretching.unstretched(meshes::triangulate(drawn, edge_length));
  double mesh_seconds = mesh_watch.elapsed().wall;

  // Step 2: solve, and cut the triangles that the error comes from, until it is small enough.
  std::vector<SolveHistory> history;
  std::optional<MeshSolution> before;
  std::optional<CoarserField> coarser;
  ErrorEstimate error;
  const auto answer = [&](MeshSolution last)
  {
    const double excess = head_excess(last.mesh, last.conditions, last.field.p);
    if (excess > silent_excess)
      observer.warn(fmt::format("seepage: heads leave the range that the boundary allows by {:.2g} "
                                "of it; the mesh does not resolve so anisotropic a soil",
                                excess));
    Solution solution = finished(std::move(last), problem);
    solution.error = std::move(error);
    solution.history = std::move(history);
    solution.seconds = watch.elapsed();
    return solution;
  };
  for (;;)
  {
    MeshSolution now;
    try
    {
      now = solve_one_mesh(std::move(mesh), problem, coarser, observer);
    }
    catch (const NotConverged&)
    {
      if (!before || observer.stop_requested())
        throw;
      observer.warn(
          fmt::format("seepage: no convergence on a finer mesh; the results are those with "
                      "{} unknowns, outside the tolerance",
                      before->mesh.nodes.size()));
      return answer(std::move(*before));
    }
    now.field.history.mesh_seconds = mesh_seconds;
    history.push_back(now.field.history);
    error = before ? estimate(now, *before, coarser->p) : first_estimate(now);
    report(history.back(), error, history.size(), observer);

    const double phreatic_tolerance = settings.phreatic_tolerance > 0
                                          ? settings.phreatic_tolerance
                                          : phreatic_tolerance_share * height_of_water(now);
    error.within_tolerance = error.discharge &&
                             *error.discharge <= settings.tolerance * now.field.inflow &&
                             error.phreatic_line.value_or(0) <= phreatic_tolerance;
    const bool full = now.mesh.nodes.size() >= static_cast<std::size_t>(settings.most_unknowns);
    if (!settings.adaptive || error.within_tolerance || full)
    {
      if (settings.adaptive && !error.within_tolerance)
        observer.warn(fmt::format("seepage: the tolerance is not met with {} unknowns; the "
                                  "estimated errors stand beside the results",
                                  now.mesh.nodes.size()));
      return answer(std::move(now));
    }
    mesh_watch = {};
    NextMesh next = next_mesh(stretching.stretched(now.mesh), now.indicator,
                              {.p = now.field.p,
                               .eps = now.eps,
                               .largest_eps = now.surface_eps,
                               .smoothing_share = now.smoothing_share},
                              static_cast<std::size_t>(settings.most_unknowns));
    mesh = stretching.unstretched(std::move(next.mesh));
    mesh_seconds = mesh_watch.elapsed().wall;
    coarser = std::move(next.coarser);
    before = std::move(now);
  }
}
} // namespace berm::seepage
