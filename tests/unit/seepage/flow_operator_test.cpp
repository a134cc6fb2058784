// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/flow_operator.h"

#include "meshes/planar.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace berm::seepage
{
namespace
{
/// A small mesh whose triangles are in an arbitrary order, with a different tensor in each.
struct Problem
{
  meshes::TriangleMesh mesh = tests::rectangle_mesh(3, 2, 6, 5);
  std::vector<ConductivityTensor> k_sat;
  std::vector<double> weight;

  Problem() : weight(mesh.nodes.size(), 1)
  {
    std::ranges::reverse(mesh.triangles);
    std::swap(mesh.triangles[3], mesh.triangles[17]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const double s = static_cast<double>(t);
      k_sat.push_back({.xx = 1 + 0.1 * s, .xy = 0.3 * std::sin(s), .yy = 2 - 0.01 * s});
    }
  }
  [[nodiscard]] const Vec2& node(Index i) const { return mesh.nodes[static_cast<std::size_t>(i)]; }
};

void set(FlowOperator& flow, const Problem& problem, double eps, double k_min)
{
  const std::size_t m = problem.mesh.triangles.size();
  flow.set_relative_conductivity(std::vector(m, on_mesh(law_of({}), eps, k_min)));
}

TEST(FlowOperator, FluxOfALinearHeadIsDarcysInTheOrderOfTheInput)
{
  const Problem problem;
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight);
  set(flow, problem, 0.1, 1e-3);
  std::vector<double> p; // head 9 + x/2 - y/4: wet everywhere
  for (const Vec2& x : problem.mesh.nodes)
    p.push_back(9 + x.x() / 2 - x.y() / 4 - x.y());
  const std::vector<Vec2> flux = flow.flux(p);
  for (std::size_t t = 0; t < flux.size(); ++t)
  {
    const ConductivityTensor& k = problem.k_sat[t];
    EXPECT_NEAR(flux[t].x(), -(k.xx * 0.5 - k.xy * 0.25), 1e-13);
    EXPECT_NEAR(flux[t].y(), -(k.xy * 0.5 - k.yy * 0.25), 1e-13);
  }
}

TEST(FlowOperator, FluxFarAboveTheFreeSurfaceIsThatOfTheLeastConductivity)
{
  const Problem problem;
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight);
  set(flow, problem, 0.01, 1e-3);
  const std::vector<double> p(problem.mesh.nodes.size(), -5); // head gradient (0, 1)
  const std::vector<Vec2> flux = flow.flux(p);
  for (std::size_t t = 0; t < flux.size(); ++t)
    EXPECT_NEAR(flux[t].y(), -1e-3 * problem.k_sat[t].yy, 1e-16);
}

TEST(FlowOperator, ResidualOfAWetFieldIsThatOfLinearElements)
{
  const Problem problem;
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight);
  set(flow, problem, 0.1, 1e-3);
  std::vector<double> p, head;
  for (const Vec2& x : problem.mesh.nodes)
  {
    head.push_back(20 + std::sin(3 * x.x()) * x.y() + x.x() * x.y());
    p.push_back(head.back() - x.y());
  }
  // Brute force: grad of the shape function of corner k is the opposite edge turned by 90 deg / (2
  // area).
  std::vector<double> expected(p.size(), 0);
  for (std::size_t t = 0; t < problem.mesh.triangles.size(); ++t)
  {
    const auto& corners = problem.mesh.triangles[t];
    const double area = 0.5 * meshes::cross(problem.node(corners[1]) - problem.node(corners[0]),
                                            problem.node(corners[2]) - problem.node(corners[0]));
    std::array<Vec2, 3> gradient;
    Vec2 grad_h(0, 0);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec2 edge = problem.node(corners[(k + 2) % 3]) - problem.node(corners[(k + 1) % 3]);
      gradient[k] = Vec2(-edge.y(), edge.x()) / (2 * area);
      grad_h += head[static_cast<std::size_t>(corners[k])] * gradient[k];
    }
    const ConductivityTensor& c = problem.k_sat[t];
    const Vec2 k_grad_h(c.xx * grad_h.x() + c.xy * grad_h.y(),
                        c.xy * grad_h.x() + c.yy * grad_h.y());
    for (std::size_t k = 0; k < 3; ++k)
      expected[static_cast<std::size_t>(corners[k])] += area * k_grad_h.dot(gradient[k]);
  }
  std::vector<double> residual;
  flow.residual(p, residual);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(residual[i], expected[i], 1e-12);
  EXPECT_NEAR(std::accumulate(residual.begin(), residual.end(), 0.0), 0, 1e-12);
}

/// The sharp law, Gardner's and van Genuchten's, triangle by triangle.
std::vector<RelativeConductivity> mixed_laws(const Problem& problem)
{
  const std::array<Retention, 4> soils{Retention{},
                                       {RetentionModel::gardner, 2, 0, 0, 0},
                                       {RetentionModel::van_genuchten, 1.5, 1.3, 0.5, 0.02},
                                       {RetentionModel::van_genuchten, 1, 3, -0.5, 0}};
  std::vector<RelativeConductivity> laws;
  for (std::size_t t = 0; t < problem.mesh.triangles.size(); ++t)
    laws.push_back(on_mesh(law_of(soils[t % 4]), 0.4, 1e-3));
  return laws;
}

TEST(FlowOperator, FluxOfAUniformSuctionIsThatOfEachTrianglesLaw)
{
  const Problem problem;
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight, {.curves = true});
  const std::vector<RelativeConductivity> laws = mixed_laws(problem);
  flow.set_relative_conductivity(laws);
  for (const double p : {-40.0, -0.7, -0.01, 0.2, 1.0})
  {
    const std::vector<Vec2> flux =
        flow.flux(std::vector<double>(problem.mesh.nodes.size(), p)); // head gradient (0, 1)
    for (std::size_t t = 0; t < flux.size(); ++t)
    {
      const double k_r = relative_conductivity(laws[t], p, 1);
      EXPECT_NEAR(flux[t].y(), -k_r * problem.k_sat[t].yy, 1e-13) << t << " " << p;
    }
  }
}

/// Expect that `flow.correction` solves with a central difference of `flow.residual`.
void expect_derivative(FlowOperator& flow, const Problem& problem)
{
  std::vector<double> p, right_side;
  std::vector<std::uint8_t> fixed;
  for (const Vec2& x : problem.mesh.nodes) // dry, in between and wet
  {
    p.push_back(1.5 - x.y() - 0.3 * x.x());
    fixed.push_back(x.x() == 0);
    right_side.push_back(std::cos(x.x() + x.y()));
  }
  std::vector<double> d;
  flow.correction(p, fixed, right_side, d);

  constexpr double step = 1e-6; // central difference: error O(step^2) + rounding / step = 1e-9
  std::vector<double> p_plus = p, p_minus = p, f_plus, f_minus;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    p_plus[i] += step * d[i];
    p_minus[i] -= step * d[i];
  }
  flow.residual(p_plus, f_plus);
  flow.residual(p_minus, f_minus);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (fixed[i])
      EXPECT_EQ(d[i], 0);
    else
      EXPECT_NEAR((f_plus[i] - f_minus[i]) / (2 * step), right_side[i], 1e-6);
}

/// Weights between 0 and 1.
Problem weighted_problem()
{
  Problem problem;
  for (std::size_t i = 0; i < problem.weight.size(); ++i)
    problem.weight[i] = 0.5 + 0.5 * std::sin(static_cast<double>(i));
  return problem;
}

TEST(FlowOperator, CorrectionSolvesWithTheDerivativeOfTheResidual)
{
  const Problem problem = weighted_problem();
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight);
  set(flow, problem, 0.4, 1e-3);
  expect_derivative(flow, problem);
}

TEST(FlowOperator, CorrectionSolvesWithTheDerivativeOfSoilsWithCurves)
{
  const Problem problem = weighted_problem();
  FlowOperator flow(problem.mesh, problem.k_sat, problem.weight, {.curves = true});
  flow.set_relative_conductivity(mixed_laws(problem));
  expect_derivative(flow, problem);
}

TEST(FlowOperator, SolvesLargeSystemsIteratively)
{
  // 51 000 unknowns, beyond what LU is used for; wet, so that the system is Laplace's.
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(2, 1, 318, 159);
  FlowOperator flow(mesh, std::vector(mesh.triangles.size(), ConductivityTensor{1, 0, 1}),
                    std::vector(mesh.nodes.size(), 1.0));
  flow.set_relative_conductivity(
      std::vector(mesh.triangles.size(), on_mesh(law_of({}), 0.1, 1e-3)));
  std::vector<double> p, residual, d;
  std::vector<std::uint8_t> fixed;
  for (const Vec2& x : mesh.nodes)
  {
    p.push_back(x.x() == 0 ? 10 - x.y() : 8 - x.y());
    fixed.push_back(x.x() == 0 || x.x() == 2);
  }
  flow.residual(p, residual);
  flow.correction(p, fixed, residual, d);
  for (std::size_t i = 0; i < p.size(); ++i) // the solver's tolerance is 1e-6 of the residual
    EXPECT_NEAR(p[i] - d[i] + mesh.nodes[i].y(), 10 - mesh.nodes[i].x(), 1e-3);
}
} // namespace
} // namespace berm::seepage
