// SPDX-License-Identifier: GPL-3.0-or-later
// The stream function against closed forms, and against the flux through cuts: docs/verification.md
// S-8. All with default settings.
#include "meshes/planar.h"
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace berm
{
namespace
{
using seepage::BoundaryKind;
using seepage::Solution;
using tests::box;
using tests::rectangular_dam;
using tests::solved;

double psi_at(const Solution& s, double x, double y)
{
  return seepage::value_at(s, s.stream_function, {x, y}, 1e-6).value();
}

double range(const Solution& s)
{
  const auto [low, high] = std::ranges::minmax(s.stream_function);
  return high - low;
}

/// Water that crosses the segment a-b from its left to its right [m2/s], from the Darcy flux of the
/// head alone: each triangle's over the part of the segment inside it.
double flux_through(const Solution& s, const Vec2& a, const Vec2& b)
{
  const Vec2 normal((b - a).y(), -(b - a).x()); // to the right, as long as the segment
  double sum = 0;
  for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t)
  {
    double from = 0, to = 1;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vec2& p = s.mesh.nodes[static_cast<std::size_t>(s.mesh.triangles[t][k])];
      const Vec2& r = s.mesh.nodes[static_cast<std::size_t>(s.mesh.triangles[t][(k + 1) % 3])];
      const double at_a = meshes::cross(r - p, a - p), at_b = meshes::cross(r - p, b - p);
      if (at_a < 0 && at_b < 0)
        to = from;
      else if (at_a < 0)
        from = std::max(from, at_a / (at_a - at_b));
      else if (at_b < 0)
        to = std::min(to, at_a / (at_a - at_b));
    }
    sum += std::max(to - from, 0.0) * normal.dot(s.flux[t]);
  }
  return sum;
}

/// Largest difference between psi and the flux through vertical cuts from the base to `heights`
/// shares of the free surface, over the discharge.
double largest_cut_error(const Solution& s, const std::vector<double>& x_of_cuts)
{
  double worst = 0;
  for (const double x : x_of_cuts)
    for (const double share : {0.3, 0.6, 1.0})
    {
      const double top = share * seepage::phreatic_level(s, x).value();
      const double difference = psi_at(s, x, top) - psi_at(s, x, 0);
      worst = std::max(worst, std::abs(difference - flux_through(s, {x, 0}, {x, top})));
    }
  return worst / s.discharge;
}

// The dam's dry ground and its base are lines without flow: between them passes all the water.
TEST(StreamFunction, OfADamRangesOverItsDischargeAndIsTheFluxThroughCuts)
{
  const Solution s = solved(rectangular_dam(16, 24, 4), {{1, 1, 0}});
  tests::expect_measured("S-8 range of psi", range(s), s.discharge, 1e-6 * s.discharge);
  // Fluxes of elements are first order, and cut elements at the free surface are half dry.
  tests::expect_error("S-8 flux through cuts, largest error over q",
                      largest_cut_error(s, {3.3, 8.1, 12.7}), 5e-3);
}

TEST(StreamFunction, OfAZonedAnisotropicDamRangesOverItsDischargeAndIsTheFluxThroughCuts)
{
  meshes::SectionInput input = rectangular_dam(10, 10, 2);
  input.zones = {box(1, 4, 0, 6, 11)};
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  // Finer than by default: the flux of the head is first order, psi better.
  const Solution s = seepage::solve(section, {{1e-5, 2.5e-6, 0.3}, {1e-6, 1e-6, 0}},
                                    seepage::boundary_conditions(section, {}),
                                    {.element_size = 0.2, .tolerance = 2e-4}, observer);
  tests::expect_measured("S-8 range of psi", range(s), s.discharge, 1e-6 * s.discharge);
  tests::expect_error("S-8 flux through cuts, largest error over q",
                      largest_cut_error(s, {2.3, 5.1, 8.7}), 5e-3);
}

TEST(StreamFunction, OfKozenysDamIsTheImaginaryPartOfItsPotential)
{
  // head + i psi / k = sqrt(2 (x + i y)), y0 = 1; the water runs to the left, psi grows downwards.
  const meshes::SectionInput input = tests::kozeny_dam();
  const Solution s = solved(input, {{1, 1, 0}}, {{BoundaryKind::head, 4}, {BoundaryKind::head, 0}});
  tests::expect_measured("S-8 range of psi", range(s), s.discharge, 1e-6 * s.discharge);
  double worst = 0;
  for (const auto& [x, y] : {std::pair{1.0, 0.5}, std::pair{2.0, 1.0}, std::pair{3.0, 0.2},
                             std::pair{5.0, 2.0}, std::pair{0.5, 1.0}, std::pair{-0.25, 0.0}})
    worst = std::max(worst, std::abs(psi_at(s, x, y) - (1 - std::sqrt(std::hypot(x, y) - x))));
  tests::expect_error("S-8 psi at six points, largest error over q", worst, 0.005);
  // The free surface is a stream line, that of no water above it. Its end on the drain is a few
  // edges off, as the exit point; from the drain's tip on.
  double along = 0;
  for (const Vec2& x : s.phreatic_lines.front())
    if (x.x() > 0)
      along = std::max(along, std::abs(psi_at(s, x.x(), x.y())));
  tests::expect_error("S-8 psi along the free surface, largest over q", along, 0.005);
}

//------------------------------------------------------------------------------------------------
// Downstream half of a sheet pile that reaches to the middle of a layer of 20 m, drop 10 m, k = 1:
// with zeta = cosh(pi z / T) the gradient is G / sqrt|zeta| with G = 0.29954 at the wall's ground.
//------------------------------------------------------------------------------------------------

constexpr double layer = 20, ground_gradient = 0.29954;

Solution half_sheet_pile()
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {3 * layer, 0}, {3 * layer, layer}, {0, layer}};
  input.marked_lines = {{{0, 0}, {0, layer / 2}}, {{0, layer}, {3 * layer, layer}}};
  return solved(input, {{1, 1, 0}}, {{BoundaryKind::head, layer + 5}, {BoundaryKind::head, layer}});
}

TEST(StreamFunction, BehindASheetPileIsTheIntegralOfItsExactFlux)
{
  const Solution s = half_sheet_pile();
  tests::expect_measured("S-8 range of psi", range(s), s.discharge, 1e-6 * s.discharge);
  const auto integral = [](double from, double to, auto f) // Simpson's rule
  {
    constexpr int steps = 200;
    const double h = (to - from) / steps;
    double sum = f(from) + f(to);
    for (int k = 1; k < steps; ++k)
      sum += (k % 2 ? 4 : 2) * f(from + k * h);
    return sum * h / 3;
  };
  const double at_wall = psi_at(s, 0, layer), at_base = psi_at(s, 0, 0);
  double worst = 0;
  for (const double x : {2.5, 5.0, 10.0, 20.0}) // along the ground, psi falls away from the wall
    worst = std::max(worst, std::abs(at_wall - psi_at(s, x, layer) -
                                     integral(0, x,
                                              [](double r) {
                                                return ground_gradient /
                                                       std::sqrt(std::cosh(pi * r / layer));
                                              })));
  for (const double y : {2.5, 5.0, 7.5}) // below the tip, across the equipotential
    worst = std::max(worst, std::abs(psi_at(s, 0, y) - at_base -
                                     integral(0, y,
                                              [](double r) {
                                                return ground_gradient /
                                                       std::sqrt(std::cos(pi * r / layer));
                                              })));
  tests::expect_error("S-8 psi at seven points, largest error [m2/s]", worst,
                      5e-3 * 5); // as the discharge, 5 m2/s: the tip is a square-root singularity
}
} // namespace
} // namespace berm
