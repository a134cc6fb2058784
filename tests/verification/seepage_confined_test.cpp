// SPDX-License-Identifier: GPL-3.0-or-later
// Confined flow with closed forms, and the order of the error: docs/verification.md S-6.
#include "meshes/planar.h"
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <array>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using tests::solved;

constexpr double layer = 20; ///< thickness of the pervious layer [m]
constexpr double drop = 10;  ///< of the head [m]

/// Downstream half of a sheet pile of depth s in the layer: by symmetry the line below its tip is
/// the equipotential of half the drop. Heads are above all soil.
seepage::Solution sheet_pile(double depth)
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {3 * layer, 0}, {3 * layer, layer}, {0, layer}};
  input.marked_lines = {{{0, 0}, {0, layer - depth}}, {{0, layer}, {3 * layer, layer}}};
  return solved(input, {{1, 1, 0}},
                {{BoundaryKind::head, layer + drop / 2}, {BoundaryKind::head, layer}});
}

class SheetPile : public testing::TestWithParam<std::pair<double, double>>
{
};

// q / (k H) for s / T: closed form with elliptic integrals. The tip is a square-root singularity.
TEST_P(SheetPile, HasItsExactDischarge)
{
  const auto [depth, discharge] = GetParam();
  const seepage::Solution s = sheet_pile(depth * layer);
  tests::expect_measured("S-6 sheet pile: discharge / k [m]", s.discharge, drop * discharge,
                         3e-3 * drop * discharge);
  EXPECT_TRUE(s.phreatic_lines.empty());
  EXPECT_FALSE(s.exit_point);
}
INSTANTIATE_TEST_SUITE_P(Depths, SheetPile,
                         testing::Values(std::pair{0.25, 0.734609}, std::pair{0.5, 0.5},
                                         std::pair{0.75, 0.340317}));

TEST(SheetPile, HasItsExactExitGradient)
{
  const seepage::Solution s = sheet_pile(0.5 * layer);
  for (const auto& [x, gradient] : {std::pair{5.0, 0.26026}, std::pair{10.0, 0.18910}})
  {
    // Extrapolated to the ground from two depths: the gradient of an element is first order.
    const auto head = [&](double depth) {
      return seepage::value_at(s, s.head, {x, layer - depth}, 0).value();
    };
    const double slope = (4 * head(1) - head(2) - 3 * layer) / 2;
    tests::expect_measured(fmt::format("S-6 sheet pile: exit gradient at {} m", x), slope, gradient,
                           0.01 * gradient);
  }
}

TEST(FlatBottomedDam, HasItsExactDischargeAndUplift)
{
  constexpr double half_width = 10, far = 4 * layer;
  meshes::SectionInput input;
  input.outline = {{-far, 0}, {far, 0}, {far, layer}, {-far, layer}};
  input.marked_lines = {{{-far, layer}, {-half_width, layer}},
                        {{half_width, layer}, {far, layer}},
                        {{-half_width, layer}, {half_width, layer}}};
  const seepage::Solution s = solved(input, {{1, 1, 0}},
                                     {{BoundaryKind::head, layer + drop},
                                      {BoundaryKind::head, layer},
                                      {BoundaryKind::impervious, 0}});
  tests::expect_measured("S-6 flat-bottomed dam: discharge / k [m]", s.discharge, 5.33180,
                         3e-3 * 5.33180);
  tests::expect_error(
      "S-6 flat-bottomed dam: heads below it, largest error [m]",
      tests::largest_head_error(
          s, {{-5, layer, layer + 6.72924}, {0, layer, layer + 5}, {5, layer, layer + 3.27076}}),
      0.002 * drop);
}

//------------------------------------------------------------------------------------------------
// Order: quarter annulus 10 <= r <= 30, head 30 inside, 10 outside, on a mapped structured mesh.
// Exact: head = 30 - 20 ln(r/10) / ln 3, q = k (pi/2) 20 / ln 3 = 28.596009 k.
//------------------------------------------------------------------------------------------------

constexpr double datum = 100; ///< lifts the heads above all soil [m]

meshes::TriangleMesh quarter_annulus(Index n)
{
  // The unit square, x -> radius, y -> angle.
  meshes::TriangleMesh mesh = tests::rectangle_mesh(1, 1, n, n);
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const Vec2 middle = (mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])] +
                         mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])]) /
                        2;
    mesh.boundary_stretch[e] = middle.x() == 0 ? 0 : middle.x() == 1 ? 1 : 2;
  }
  for (Vec2& x : mesh.nodes)
    x = (10 + 20 * x.x()) * Vec2(std::cos(pi / 2 * x.y()), std::sin(pi / 2 * x.y()));
  return mesh;
}

struct AnnulusError
{
  double head = 0; ///< root mean square over the area [m]
  double discharge = 0;
};

AnnulusError annulus_error(Index n)
{
  Observer observer;
  const seepage::Solution s = seepage::solve_on_mesh(quarter_annulus(n), {{1, 1, 0}},
                                                     {{BoundaryKind::head, datum + 30},
                                                      {BoundaryKind::head, datum + 10},
                                                      {BoundaryKind::impervious, 0}},
                                                     observer);
  double sum = 0, area = 0;
  for (const auto& t : s.mesh.triangles)
  {
    std::array<Vec2, 3> x;
    double head = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      x[k] = s.mesh.nodes[static_cast<std::size_t>(t[k])];
      head += s.head[static_cast<std::size_t>(t[k])] / 3;
    }
    const double r = ((x[0] + x[1] + x[2]) / 3).norm();
    const double weight = 0.5 * meshes::cross(x[1] - x[0], x[2] - x[0]);
    sum += weight * std::pow(head - datum - 30 + 20 * std::log(r / 10) / std::log(3.0), 2);
    area += weight;
  }
  return {.head = std::sqrt(sum / area),
          .discharge = std::abs(s.discharge - 10 * pi / std::log(3.0))};
}

TEST(QuarterAnnulus, HeadAndDischargeAreSecondOrder)
{
  const AnnulusError coarse = annulus_error(16), fine = annulus_error(32),
                     finest = annulus_error(64);
  EXPECT_LT(finest.head, 0.005); // of 20 m
  EXPECT_LT(finest.discharge, 0.001 * 28.596);
  for (const auto& [a, b] : {std::pair{coarse, fine}, std::pair{fine, finest}})
  {
    tests::expect_measured("S-6 quarter annulus: order of the head", std::log2(a.head / b.head), 2,
                           0.1);
    tests::expect_measured("S-6 quarter annulus: order of the discharge",
                           std::log2(a.discharge / b.discharge), 2, 0.1);
  }
}

TEST(QuarterAnnulus, OnADefaultMeshHasItsExactDischarge)
{
  meshes::SectionInput input;
  Polyline outer, inner;
  for (int k = 0; k <= 80; ++k)
  {
    const Vec2 direction(std::cos(pi / 2 * k / 80), std::sin(pi / 2 * k / 80));
    outer.push_back(30 * direction);
    inner.push_back(10 * direction);
  }
  outer.back().x() = inner.back().x() = 0;
  input.outline = outer;
  input.outline.insert(input.outline.end(), inner.rbegin(), inner.rend());
  input.marked_lines = {inner, outer};
  const seepage::Solution s = solved(
      input, {{1, 1, 0}}, {{BoundaryKind::head, datum + 30}, {BoundaryKind::head, datum + 10}});
  tests::expect_measured("S-6 quarter annulus, default mesh: discharge / k [m]", s.discharge,
                         28.596009,
                         3e-3 * 28.596009); // unrefined: h = 1.5 m against a radius of 10 m
}
} // namespace
} // namespace berm
