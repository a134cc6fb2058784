// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/stream_function.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace berm::seepage
{
namespace
{
/// Rounding of a linear solve, relative to the discharge.
constexpr double rounding = 1e-12;

/// 3 m x 2 m, boundary rows counter-clockwise: 6 of the base, 5 right, 6 of the top, 5 left.
meshes::TriangleMesh rectangle()
{
  return tests::rectangle_mesh(3, 2, 6, 5);
}

Vec2 middle(const meshes::TriangleMesh& mesh, std::size_t edge)
{
  const auto& [i, j] = mesh.boundary[edge];
  return (mesh.nodes[static_cast<std::size_t>(i)] + mesh.nodes[static_cast<std::size_t>(j)]) / 2;
}

BoundaryFlow closed(const meshes::TriangleMesh& mesh)
{
  return {.head_known = std::vector<std::uint8_t>(mesh.boundary.size(), 0),
          .edge_inflow = std::vector<double>(mesh.boundary.size(), 0),
          .reaction = std::vector<double>(mesh.nodes.size(), 0)};
}

TEST(StreamFunction, OfUniformFlowInTurnedAnisotropicSoilIsExact)
{
  const meshes::TriangleMesh mesh = rectangle();
  const ConductivityTensor k{.xx = 3e-6, .xy = 1.5e-6, .yy = 2e-6};
  const Vec2 gradient(-0.5, 0.25);
  const Vec2 q(-(k.xx * gradient.x() + k.xy * gradient.y()),
               -(k.xy * gradient.x() + k.yy * gradient.y()));
  std::vector<double> head;
  for (const Vec2& x : mesh.nodes)
    head.push_back(40 + gradient.dot(x));
  BoundaryFlow flow = closed(mesh);
  std::ranges::fill(flow.head_known,
                    std::uint8_t{1}); // its derivative along the boundary loads psi
  const std::vector<double> psi = stream_function(
      mesh, std::vector<ConductivityTensor>(mesh.triangles.size(), k), head, flow, q.norm());
  const double smallest = std::min({0., 2 * q.x(), -3 * q.y(), 2 * q.x() - 3 * q.y()});
  for (std::size_t i = 0; i < psi.size(); ++i)
    EXPECT_NEAR(psi[i], q.x() * mesh.nodes[i].y() - q.y() * mesh.nodes[i].x() - smallest,
                rounding * q.norm());
}

TEST(StreamFunction, OfFlowAlongLayersHasTheirShares)
{
  // Head from 42 m on the left to 39 m on the right; k = 1 m/s below y = 0.8 m, 5 m/s above.
  const meshes::TriangleMesh mesh = rectangle();
  std::vector<ConductivityTensor> k;
  for (const auto& t : mesh.triangles)
  {
    double y = 0;
    for (const Index i : t)
      y += mesh.nodes[static_cast<std::size_t>(i)].y() / 3;
    k.push_back(y < 0.8 ? ConductivityTensor{1, 0, 1} : ConductivityTensor{5, 0, 5});
  }
  const auto exact = [](double y) { return y < 0.8 ? y : 0.8 + 5 * (y - 0.8); };
  std::vector<double> head;
  for (const Vec2& x : mesh.nodes)
    head.push_back(42 - x.x());
  BoundaryFlow flow = closed(mesh);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    if (const double x = middle(mesh, e).x(); x == 0 || x == 3)
    {
      flow.head_known[e] = 1;
      for (const Index i : mesh.boundary[e]) // the exact share of each half edge
        flow.reaction[static_cast<std::size_t>(i)] +=
            (x == 0 ? 1 : -1) * std::abs(exact(mesh.nodes[static_cast<std::size_t>(i)].y()) -
                                         exact(middle(mesh, e).y()));
    }
  const std::vector<double> psi = stream_function(mesh, k, head, flow, exact(2));
  for (std::size_t i = 0; i < psi.size(); ++i)
    EXPECT_NEAR(psi[i], exact(mesh.nodes[i].y()), rounding * exact(2));
}

TEST(StreamFunction, FollowsPrescribedInflow)
{
  // Rain of 0.25 m/s on the top sinks to a base at constant head.
  const meshes::TriangleMesh mesh = rectangle();
  const std::vector<double> head(mesh.nodes.size(), 40); // of the base; elsewhere not used
  BoundaryFlow flow = closed(mesh);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const double length = 0.5;
    if (middle(mesh, e).y() == 2)
      flow.edge_inflow[e] = 0.25 * length;
    if (middle(mesh, e).y() == 0)
    {
      flow.head_known[e] = 1;
      for (const Index i : mesh.boundary[e])
        flow.reaction[static_cast<std::size_t>(i)] -= 0.25 * length / 2;
    }
  }
  const std::vector<double> psi = stream_function(
      mesh, std::vector<ConductivityTensor>(mesh.triangles.size(), {1, 0, 1}), head, flow, 0.75);
  for (std::size_t i = 0; i < psi.size(); ++i)
    EXPECT_NEAR(psi[i], 0.25 * mesh.nodes[i].x(), rounding * 0.75); // q = (0, -0.25)
}

TEST(StreamFunction, StepsByTheWaterOfASingleNode)
{
  // Water enters at the middle of the base and leaves on the right: psi there lies halfway.
  const meshes::TriangleMesh mesh = rectangle();
  BoundaryFlow flow = closed(mesh);
  flow.reaction[3] = 1; // (1.5, 0)
  for (std::size_t e = 6; e < 11; ++e)
    flow.head_known[e] = 1;
  for (const Index i : {13, 20, 27, 34}) // of the right side but its lowest node
    flow.reaction[static_cast<std::size_t>(i)] = -0.25;
  const std::vector<double> psi =
      stream_function(mesh, std::vector<ConductivityTensor>(mesh.triangles.size(), {1, 0, 1}),
                      std::vector<double>(mesh.nodes.size(), 40), flow, 1);
  for (const Index i : {0, 1, 2, 7, 41, 40, 35})
    EXPECT_NEAR(psi[static_cast<std::size_t>(i)], 1, rounding);
  EXPECT_NEAR(psi[3], 0.5, rounding);
  EXPECT_NEAR(psi[4], 0, rounding);
  EXPECT_NEAR(psi[6], 0, rounding);
}
} // namespace
} // namespace berm::seepage
