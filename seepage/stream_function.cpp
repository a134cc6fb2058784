// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/stream_function.h"

#include "meshes/boundary_walk.h"
#include "meshes/planar.h"

#include <Eigen/LU>

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

using Loop = std::vector<std::size_t>; ///< rows of mesh.boundary

/// docs/theory.md eq. (2.14), once round: psi falls by what enters.
void give_along(const meshes::TriangleMesh& mesh, const BoundaryFlow& flow, Loop edges,
                GivenValues& values)
{
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
}

/// Twice the area that the loop goes round, counter-clockwise [m2]; 0 on a slit but for rounding.
double twice_area(const meshes::TriangleMesh& mesh, const Loop& loop)
{
  const Vec2& origin = mesh.nodes[static_cast<std::size_t>(mesh.boundary[loop.front()][0])];
  double sum = 0;
  for (const std::size_t e : loop)
    sum += meshes::cross(mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])] - origin,
                         mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])] - origin);
  return sum;
}

bool water_passes(const meshes::TriangleMesh& mesh, const BoundaryFlow& flow, const Loop& loop)
{
  return std::ranges::any_of(
      loop,
      [&](std::size_t e)
      {
        return flow.head_known[e] || flow.edge_inflow[e] != 0 ||
               flow.reaction[static_cast<std::size_t>(mesh.boundary[e][0])] != 0;
      });
}

/// The line round each piece of the mesh, and the walls in the soil, which are loops inside it.
struct Loops
{
  std::vector<Loop> outer; ///< one for each piece
  std::vector<Loop> holes;
};

Loops sorted_loops(const meshes::TriangleMesh& mesh, const std::vector<std::size_t>& piece)
{
  Loops loops;
  loops.outer.resize(std::ranges::max(piece) + 1);
  for (Loop& loop : meshes::boundary_loops(mesh))
  {
    Loop& outer = loops.outer[piece[static_cast<std::size_t>(mesh.boundary[loop.front()][0])]];
    if (outer.empty() || twice_area(mesh, loop) > twice_area(mesh, outer))
      std::swap(outer, loop);
    if (!loop.empty())
      loops.holes.push_back(std::move(loop));
  }
  return loops;
}
} // namespace

std::vector<double> stream_function(const meshes::TriangleMesh& mesh,
                                    std::span<const ConductivityTensor> conductivity,
                                    std::span<const double> head, const BoundaryFlow& flow,
                                    double discharge, bool distributed)
{
  const std::vector<std::size_t> piece = meshes::pieces(mesh);
  const auto [outer, holes] = sorted_loops(mesh, piece);
  for (const Loop& hole : holes)
    if (water_passes(mesh, flow, hole))
      return {};

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
  FlowOperator solver(mesh, dual, std::vector<double>(n, 1),
                      {.curves = false, .distributed = distributed});

  GivenValues values{.given = std::vector<std::uint8_t>(n, 0), .psi = std::vector<double>(n, 0)};
  for (const Loop& loop : outer)
    give_along(mesh, flow, loop, values);
  const auto nodes_of = [&](const Loop& loop)
  {
    std::vector<std::size_t> nodes;
    for (const std::size_t e : loop)
      nodes.push_back(static_cast<std::size_t>(mesh.boundary[e][0]));
    return nodes;
  };
  for (const Loop& hole : holes)
    for (const std::size_t i : nodes_of(hole))
      values.given[i] = 1;

  std::vector<double> shifted(n), residual, correction;
  const auto evaluate = [&](const std::vector<double>& psi) // psi over the scale
  {
    for (std::size_t i = 0; i < n; ++i)
      shifted[i] = psi[i] - mesh.nodes[i].y();
    solver.residual(shifted, residual);
  };
  /// Completes values given on the boundary, over the scale, to the solution for this load.
  const auto complete = [&](std::vector<double> psi, const std::vector<double>& load)
  {
    evaluate(psi);
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = load[i] - residual[i];
    solver.correction(shifted, values.given, residual, correction);
    for (std::size_t i = 0; i < n; ++i)
      psi[i] += correction[i];
    return psi;
  };
  std::vector<double> load(n, 0);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (flow.head_known[e])
    {
      const auto i = static_cast<std::size_t>(mesh.boundary[e][0]),
                 j = static_cast<std::size_t>(mesh.boundary[e][1]);
      load[i] += (head[j] - head[i]) / 2;
      load[j] += (head[j] - head[i]) / 2;
    }
  std::vector<double> given(values.psi);
  for (double& value : given)
    value /= scale;
  std::vector<double> psi = complete(std::move(given), load);

  // Eq. (2.31): the values on walls in the soil, from the response to each.
  const auto m = static_cast<Eigen::Index>(holes.size());
  const auto circulations = [&](const std::vector<double>& field)
  {
    evaluate(field);
    Eigen::VectorXd about(m);
    for (Eigen::Index k = 0; k < m; ++k)
    {
      about[k] = 0;
      for (const std::size_t i : nodes_of(holes[static_cast<std::size_t>(k)]))
        about[k] += residual[i];
    }
    return about;
  };
  if (m > 0)
  {
    std::vector<std::vector<double>> response;
    Eigen::MatrixXd of_response(m, m);
    for (const Loop& hole : holes)
    {
      std::vector<double> one(n, 0);
      for (const std::size_t i : nodes_of(hole))
        one[i] = 1;
      response.push_back(complete(std::move(one), std::vector<double>(n, 0)));
      of_response.col(static_cast<Eigen::Index>(response.size()) - 1) =
          circulations(response.back());
    }
    const Eigen::VectorXd c = of_response.partialPivLu().solve(-circulations(psi));
    for (std::size_t k = 0; k < holes.size(); ++k)
      for (std::size_t i = 0; i < n; ++i)
        psi[i] += c[static_cast<Eigen::Index>(k)] * response[k][i];
  }

  std::vector<double> smallest(outer.size(), std::numeric_limits<double>::infinity());
  for (const auto& edge : mesh.boundary)
  {
    const auto i = static_cast<std::size_t>(edge[0]);
    smallest[piece[i]] = std::min(smallest[piece[i]], psi[i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    psi[i] = scale * (psi[i] - smallest[piece[i]]);
  return psi;
}
} // namespace berm::seepage
