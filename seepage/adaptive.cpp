// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/error.h"
#include "meshes/mesher.h"
#include "seepage/boundary.h"
#include "seepage/flow_operator.h"
#include "seepage/newton.h"
#include "seepage/phreatic.h"
#include "seepage/seepage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double k_min = 1e-3;          ///< relative conductivity far above the free surface [-]
constexpr double smoothing_share = 0.5; ///< eps over the element size [-]

double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

ConductivityTensor tensor(const Conductivity& k)
{
  const double c = std::cos(k.angle), s = std::sin(k.angle);
  return {.xx = c * c * k.kx + s * s * k.ky,
          .xy = c * s * (k.kx - k.ky),
          .yy = s * s * k.kx + c * c * k.ky};
}

/// Edge of the equilateral triangle of the same area [m].
std::vector<double> element_sizes(const meshes::TriangleMesh& mesh)
{
  std::vector<double> size;
  size.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles)
  {
    const Vec2& a = mesh.nodes[static_cast<std::size_t>(i)];
    const double twice_area = cross(mesh.nodes[static_cast<std::size_t>(j)] - a,
                                    mesh.nodes[static_cast<std::size_t>(k)] - a);
    size.push_back(std::sqrt(2 * twice_area / std::sqrt(3.0)));
  }
  return size;
}

Solution solve_from(const meshes::TriangleMesh& mesh, std::size_t stretches,
                    const std::vector<Conductivity>& conductivity,
                    const std::vector<Boundary>& boundary, const Solution* coarse,
                    Observer& observer)
{
  (void)coarse;
  const Stopwatch watch;
  const NodeConditions conditions = node_conditions(mesh, boundary);

  std::vector<ConductivityTensor> k_sat;
  double k_max = 0;
  for (const Index soil : mesh.triangle_soil)
  {
    const Conductivity& k = conductivity.at(static_cast<std::size_t>(soil));
    k_sat.push_back(tensor(k));
    k_max = std::max({k_max, k.kx, k.ky});
  }
  double lowest = conditions.highest_head;
  for (const Vec2& x : mesh.nodes)
    lowest = std::min(lowest, x.y());
  const double height = conditions.highest_head - lowest;

  std::vector<double> eps = element_sizes(mesh);
  for (double& e : eps)
    e *= smoothing_share;

  FlowOperator flow(mesh, k_sat, face_weight(mesh, conditions.face_edges), k_min);
  Start start{.p = {}, .smoothing = height / 4};
  for (const Vec2& x : mesh.nodes)
    start.p.push_back(conditions.highest_head - x.y());
  Field field = solve_field(flow, conditions, eps, k_max * height, std::move(start), observer);

  Solution solution;
  solution.mesh = mesh;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
  {
    solution.head.push_back(field.p[i] + mesh.nodes[i].y());
    solution.pore_pressure.push_back(water_unit_weight * field.p[i]);
  }
  solution.flux = flow.flux(field.p);
  solution.phreatic_lines = zero_contours(mesh, field.p);
  solution.inflow = field.inflow;
  solution.outflow = field.outflow;
  solution.discharge = field.inflow;
  solution.balance = std::abs(field.inflow - field.outflow) / field.inflow;
  std::vector<double> reaction(mesh.nodes.size(), 0);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (conditions.kind[i] != NodeKind::interior)
      reaction[i] = field.entering[i] - conditions.load[i];
  solution.stretch_inflow = stretch_inflow(mesh, boundary, conditions, reaction);
  (void)stretches;
  solution.seconds = watch.elapsed();
  field.history.seconds = solution.seconds.wall;
  solution.history.push_back(field.history);
  return solution;
}
} // namespace

Solution solve_on_mesh(const meshes::TriangleMesh& mesh, std::size_t stretches,
                       const std::vector<Conductivity>& conductivity,
                       const std::vector<Boundary>& boundary, Observer& observer)
{
  return solve_from(mesh, stretches, conductivity, boundary, nullptr, observer);
}
} // namespace berm::seepage
