// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/planar.h"
#include "seepage/exit_gradient.h"
#include "seepage/solution.h"
#include "tests/support/meshes.h"

#include <cmath>
#include <functional>
#include <vector>

/// Flows that linear elements hold exactly, with the reactions that a solve would find.
namespace berm::seepage::test
{
/// A field, and what it is bounded by.
struct ExactFlow
{
  Solution solution;
  std::vector<Boundary> boundary;
  std::vector<Conductivity> conductivity;

  [[nodiscard]] std::vector<Outlet> find_outlets() const
  {
    return outlets(solution, boundary, conductivity);
  }
};

/// Principal axes turned, as a product with a vector.
inline Vec2 flux_of(const Conductivity& k, const Vec2& gradient)
{
  const Vec2 x(std::cos(k.angle), std::sin(k.angle)), y(-x.y(), x.x());
  return k.kx * gradient.dot(x) * x + k.ky * gradient.dot(y) * y;
}

/// @param[in] mesh     With its stretches.
/// @param[in] head     Linear in each triangle and its flux divergence-free [m].
/// @param[in] outflow  Flux out of the soil through boundaries of given flow, by the middle of the
///                     edge [m/s].
inline ExactFlow exact_flow(meshes::TriangleMesh mesh, std::vector<Boundary> boundary,
                            std::vector<Conductivity> conductivity,
                            const std::function<double(const Vec2&)>& head,
                            const std::function<double(const Vec2&)>& outflow)
{
  ExactFlow flow{.solution = {}, .boundary = std::move(boundary), .conductivity = conductivity};
  Solution& s = flow.solution;
  for (const Vec2& x : mesh.nodes)
  {
    s.head.push_back(head(x));
    const double p = s.head.back() - x.y();
    s.pore_pressure.push_back(std::abs(p) < 1e-12 ? 0 : water_unit_weight * p);
  }
  s.reaction.assign(mesh.nodes.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) // int K grad h . grad v_i
  {
    const auto node = [&](std::size_t k)
    { return static_cast<std::size_t>(mesh.triangles[t][k % 3]); };
    const auto opposite = [&](std::size_t k)
    {
      const Vec2 edge = mesh.nodes[node(k + 2)] - mesh.nodes[node(k + 1)];
      return Vec2(-edge.y(), edge.x());
    };
    const double twice_area = meshes::cross(mesh.nodes[node(1)] - mesh.nodes[node(0)],
                                            mesh.nodes[node(2)] - mesh.nodes[node(0)]);
    Vec2 gradient(0, 0);
    for (std::size_t k = 0; k < 3; ++k)
      gradient += s.head[node(k)] / twice_area * opposite(k);
    s.flux.push_back(
        -flux_of(conductivity[static_cast<std::size_t>(mesh.triangle_soil[t])], gradient));
    for (std::size_t k = 0; k < 3; ++k)
      s.reaction[node(k)] -= s.flux.back().dot(opposite(k)) / 2;
  }
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const BoundaryKind kind =
        flow.boundary[static_cast<std::size_t>(mesh.boundary_stretch[e])].kind;
    if (kind != BoundaryKind::impervious && kind != BoundaryKind::inflow)
      continue;
    const auto i = static_cast<std::size_t>(mesh.boundary[e][0]),
               j = static_cast<std::size_t>(mesh.boundary[e][1]);
    const double through =
        outflow((mesh.nodes[i] + mesh.nodes[j]) / 2) * (mesh.nodes[j] - mesh.nodes[i]).norm();
    s.reaction[i] += through / 2;
    s.reaction[j] += through / 2;
  }
  for (const double r : s.reaction)
    s.discharge += std::max(r, 0.0);
  s.mesh = std::move(mesh);
  return flow;
}

/// Middle of a boundary edge.
inline Vec2 middle(const meshes::TriangleMesh& mesh, std::size_t e)
{
  return (mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])] +
          mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])]) /
         2;
}

/// Water rises through a block of 4 m x 2 m, under a pool up to 5 m: the gradient is `below` under
/// y = 0.8 and `above` over it, the conductivities go with them. Stretches: 0 top, 1 base, 2 sides.
inline ExactFlow rising_water(double below, double above)
{
  meshes::TriangleMesh mesh = tests::rectangle_mesh(4, 2, 9, 5);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const double y = middle(mesh, e).y();
    mesh.boundary_stretch[e] = y == 2 ? 0 : y == 0 ? 1 : 2;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    double y = 0;
    for (const Index i : mesh.triangles[t])
      y += mesh.nodes[static_cast<std::size_t>(i)].y() / 3;
    mesh.triangle_soil[t] = y > 0.8 ? 1 : 0;
  }
  const auto head = [=](const Vec2& x)
  { return 5 + above * (2 - std::max(x.y(), 0.8)) + below * std::max(0.8 - x.y(), 0.0); };
  return exact_flow(std::move(mesh),
                    {{BoundaryKind::head, 5},
                     {BoundaryKind::head, 5 + 1.2 * above + 0.8 * below},
                     {BoundaryKind::impervious, 0}},
                    {{1 / below, 1 / below, 0}, {1 / above, 1 / above, 0}}, head,
                    [](const Vec2&) { return 0; });
}
} // namespace berm::seepage::test
