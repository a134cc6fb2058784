// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/stream_function.h"

#include "meshes/boundary_walk.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace berm::seepage
{
namespace
{
/// psi where the flow is known.
struct GivenValues
{
  std::vector<std::uint8_t> given; ///< shape (n)
  std::vector<double> psi;         ///< 0 where not given [m2/s], shape (n)
};

/// docs/theory.md eq. (2.14), once round: psi falls by what enters.
GivenValues values_along(const meshes::TriangleMesh& mesh, const BoundaryFlow& flow)
{
  GivenValues values{.given = std::vector<std::uint8_t>(mesh.nodes.size(), 0),
                     .psi = std::vector<double>(mesh.nodes.size(), 0)};
  std::vector<std::size_t> edges = meshes::edges_along(mesh);
  const auto known = [&](std::size_t k) { return flow.head_known[edges[k]] != 0; };
  // From the end of a stretch of known head, so that no such stretch is split.
  std::size_t first = 0;
  while (first < edges.size() &&
         !(!known(first) && known((first + edges.size() - 1) % edges.size())))
    ++first;
  if (first < edges.size())
    std::ranges::rotate(edges, edges.begin() + static_cast<std::ptrdiff_t>(first));
  const auto give = [&](std::size_t node, double psi)
  {
    values.given[node] = 1;
    values.psi[node] = psi;
  };

  give(static_cast<std::size_t>(mesh.boundary[edges.front()][0]), 0);
  double psi = 0;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
  {
    const auto node = static_cast<std::size_t>(mesh.boundary[edges[k]][1]);
    const double enters = flow.reaction[node];
    psi -= flow.edge_inflow[edges[k]];
    if (!known(k)) // the water of a single node enters half before it, half after it
      give(node, known(k + 1) ? psi : psi - enters / 2);
    psi -= enters;
    if (known(k) && !known(k + 1))
      give(node, psi);
  }
  return values;
}
} // namespace

std::vector<double> stream_function(const meshes::TriangleMesh& mesh,
                                    std::span<const ConductivityTensor> conductivity,
                                    std::span<const double> head, const BoundaryFlow& flow,
                                    double discharge)
{
  const std::size_t n = mesh.nodes.size();
  // The operator adds y to its unknown; psi times the scale is of the same magnitude.
  const auto [low, high] = std::ranges::minmax(mesh.nodes, {}, [](const Vec2& x) { return x.y(); });
  const double scale = discharge / (high.y() - low.y());
  std::vector<ConductivityTensor> dual;
  dual.reserve(conductivity.size());
  for (const ConductivityTensor& k : conductivity) // eq. (2.13)
  {
    const double c = scale / (k.xx * k.yy - k.xy * k.xy);
    dual.push_back({.xx = c * k.xx, .xy = c * k.xy, .yy = c * k.yy});
  }
  FlowOperator solver(mesh, dual, std::vector<double>(n, 1));

  const GivenValues values = values_along(mesh, flow);
  std::vector<double> unknown, right_side, correction;
  for (std::size_t i = 0; i < n; ++i)
    unknown.push_back(values.psi[i] / scale - mesh.nodes[i].y());
  solver.residual(unknown, right_side);
  for (double& r : right_side)
    r *= -1;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (flow.head_known[e])
    {
      const auto i = static_cast<std::size_t>(mesh.boundary[e][0]),
                 j = static_cast<std::size_t>(mesh.boundary[e][1]);
      right_side[i] += (head[j] - head[i]) / 2;
      right_side[j] += (head[j] - head[i]) / 2;
    }
  solver.correction(unknown, values.given, right_side, correction);

  std::vector<double> psi(n);
  for (std::size_t i = 0; i < n; ++i)
    psi[i] = values.psi[i] + scale * correction[i];
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& edge : mesh.boundary)
    smallest = std::min(smallest, psi[static_cast<std::size_t>(edge[0])]);
  for (double& value : psi)
    value -= smallest;
  return psi;
}
} // namespace berm::seepage
