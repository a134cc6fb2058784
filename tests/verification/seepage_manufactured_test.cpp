// SPDX-License-Identifier: GPL-3.0-or-later
// Manufactured solutions of confined flow, div (K grad head) = -f: docs/verification.md S-9.
#include "meshes/planar.h"
#include "seepage/flow_operator.h"
#include "tests/support/measured.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace berm
{
namespace
{
using seepage::ConductivityTensor;

/// A head, its gradient and its source f at a point.
struct Manufactured
{
  ConductivityTensor k; ///< [m/s]
  std::function<double(const Vec2&)> head;
  std::function<Vec2(const Vec2&)> gradient;
  std::function<double(const Vec2&)> source;
};

/// n x n cells of the unit square; inner nodes moved by up to 0.28 of a cell, so that nothing
/// cancels by symmetry.
meshes::TriangleMesh uneven_square(Index n)
{
  meshes::TriangleMesh mesh = tests::rectangle_mesh(1, 1, n, n);
  double k = 0;
  for (Vec2& x : mesh.nodes)
    if (x.minCoeff() > 0 && x.maxCoeff() < 1)
    {
      x += 0.2 / n * Vec2(std::sin(7 * k), std::cos(11 * k));
      ++k;
    }
  return mesh;
}

struct Error
{
  double head = 0, flux = 0; ///< in L2: [m], [m/s]
};

Error error(const Manufactured& problem, Index n)
{
  const meshes::TriangleMesh mesh = uneven_square(n);
  const auto node = [&](Index i) -> const Vec2& { return mesh.nodes[static_cast<std::size_t>(i)]; };
  seepage::FlowOperator flow(mesh,
                             std::vector<ConductivityTensor>(mesh.triangles.size(), problem.k),
                             std::vector<double>(mesh.nodes.size(), 1)); // k_r = 1: confined

  // Sides' middles integrate quadratics exactly: enough for order 2.
  std::vector<double> load(mesh.nodes.size(), 0);
  for (const auto& t : mesh.triangles)
  {
    const double area = meshes::cross(node(t[1]) - node(t[0]), node(t[2]) - node(t[0])) / 2;
    for (std::size_t a = 0; a < 3; ++a)
      for (const Index i : {t[a], t[(a + 1) % 3]})
        load[static_cast<std::size_t>(i)] +=
            area / 3 * problem.source((node(t[a]) + node(t[(a + 1) % 3])) / 2) / 2;
  }

  std::vector<double> p, residual, correction;
  std::vector<std::uint8_t> fixed;
  for (const Vec2& x : mesh.nodes)
  {
    fixed.push_back(x.minCoeff() == 0 || x.maxCoeff() == 1);
    p.push_back((fixed.back() ? problem.head(x) : 0) - x.y());
  }
  flow.residual(p, residual);
  for (std::size_t i = 0; i < p.size(); ++i)
    load[i] -= residual[i];
  flow.correction(p, fixed, load, correction);
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] += correction[i];

  const std::vector<Vec2> q = flow.flux(p);
  Error sum;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
  {
    const auto& t = mesh.triangles[e];
    const double area = meshes::cross(node(t[1]) - node(t[0]), node(t[2]) - node(t[0])) / 2;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const Index i = t[a], j = t[(a + 1) % 3];
      const Vec2 middle = (node(i) + node(j)) / 2;
      const double head =
          (p[static_cast<std::size_t>(i)] + p[static_cast<std::size_t>(j)]) / 2 + middle.y();
      const Vec2 g = problem.gradient(middle);
      const Vec2 flux(-(problem.k.xx * g.x() + problem.k.xy * g.y()),
                      -(problem.k.xy * g.x() + problem.k.yy * g.y()));
      sum.head += area / 3 * std::pow(head - problem.head(middle), 2);
      sum.flux += area / 3 * (q[e] - flux).squaredNorm();
    }
  }
  return {.head = std::sqrt(sum.head), .flux = std::sqrt(sum.flux)};
}

/// Meshes of 16, 32 and 64 cells a side. The moves of the nodes differ from mesh to mesh, which
/// scatters the observed orders by some hundredths.
void expect_orders(const Manufactured& problem)
{
  const Error coarse = error(problem, 16), fine = error(problem, 32), finest = error(problem, 64);
  for (const auto& [a, b] : {std::pair{coarse, fine}, std::pair{fine, finest}})
  {
    tests::expect_measured("S-9 order of the head", std::log2(a.head / b.head), 2, 0.1);
    tests::expect_measured("S-9 order of the flux", std::log2(a.flux / b.flux), 1, 0.1);
  }
}

TEST(ManufacturedFlow, WithSourcesInTurnedAnisotropicSoilIsSecondOrderInTheHead)
{
  // head = 30 + sin(2x + y) exp(y), K turned: f = -(k_xx h_xx + 2 k_xy h_xy + k_yy h_yy).
  const ConductivityTensor k{.xx = 3, .xy = 1.2, .yy = 0.8};
  expect_orders(
      {.k = k,
       .head = [](const Vec2& x) { return 30 + std::sin(2 * x.x() + x.y()) * std::exp(x.y()); },
       .gradient =
           [](const Vec2& x)
       {
         const double s = std::sin(2 * x.x() + x.y()), c = std::cos(2 * x.x() + x.y());
         return Vec2(std::exp(x.y()) * Vec2(2 * c, s + c));
       },
       .source =
           [k](const Vec2& x)
       {
         const double s = std::sin(2 * x.x() + x.y()), c = std::cos(2 * x.x() + x.y());
         return -std::exp(x.y()) * (k.xx * (-4 * s) + 2 * k.xy * (2 * c - 2 * s) + k.yy * 2 * c);
       }});
}

TEST(ManufacturedFlow, WithoutSourcesInTurnedAnisotropicSoilIsSecondOrderInTheHead)
{
  // Harmonic in u = x / 2, v = y - x / 2, K = A A^T of x = A u: A = (2, 0; 1, 1), K = (4, 2; 2, 2).
  expect_orders({.k = {.xx = 4, .xy = 2, .yy = 2},
                 .head = [](const Vec2& x)
                 { return 30 + std::exp(3 * x.x() / 2) * std::sin(3 * (x.y() - x.x() / 2)); },
                 .gradient =
                     [](const Vec2& x)
                 {
                   const double e = 3 * std::exp(3 * x.x() / 2), v = 3 * (x.y() - x.x() / 2);
                   return Vec2(e / 2 * (std::sin(v) - std::cos(v)), e * std::cos(v));
                 },
                 .source = [](const Vec2&) { return 0.0; }});
}
} // namespace
} // namespace berm
