// SPDX-License-Identifier: GPL-3.0-or-later
// Rain, what of it enters and what runs off: docs/verification.md S-11.
#include "tests/support/measured.h"
#include "tests/unit/meshes/sections.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using seepage::Solution;

double total(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

Solution rained_on(const meshes::SectionInput& input, double rain, double k = 1,
                   const std::vector<Boundary>& marked = {})
{
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  return seepage::solve(section, {{k, k, 0}}, seepage::boundary_conditions(section, marked, rain),
                        {}, observer);
}

double inflow_of(const meshes::SectionInput& input, const Solution& s, std::string_view name)
{
  const meshes::Section section = meshes::build_section(input);
  const auto it = std::ranges::find(section.stretches, name, &meshes::Stretch::name);
  return s.stretch_inflow.at(static_cast<std::size_t>(it - section.stretches.begin()));
}

void expect_balanced(const Solution& s)
{
  EXPECT_LT(s.balance, 1e-7);
  EXPECT_NEAR(total(s.stretch_inflow), 0, 1e-7 * s.discharge);
}

//------------------------------------------------------------------------------------------------
// A strip of width L between two ditches, rain r on its level ground. With G(x) the integral of
// h - y over the height of the water, G' = -q(x) / k holds exactly (Charny), q(x) = r (x - x0), and
// G = h^2 / 2 at a ditch with its seepage face. So the divide is where Dupuit has it,
// x0 = L / 2 - k (h0^2 - hL^2) / (2 r L), and the ditches get r x0 and r (L - x0).
//------------------------------------------------------------------------------------------------

constexpr double length = 40, height = 10;

class Strip : public testing::TestWithParam<std::array<double, 3>>
{
};

TEST_P(Strip, GivesEachDitchItsExactShare)
{
  const auto [left, right, rain] = GetParam();
  meshes::SectionInput input = tests::rectangle_input(length, height);
  input.left_pool_level = left;
  input.right_pool_level = right;
  input.marked_lines = {{{0, 0}, {0, height}}, {{length, 0}, {length, height}}};
  const Solution s =
      rained_on(input, rain, 1, {{BoundaryKind::head, left}, {BoundaryKind::head, right}});
  expect_balanced(s);
  EXPECT_NEAR(s.rain, rain * length, 1e-12);
  const double divide = length / 2 - (left * left - right * right) / (2 * rain * length);
  // The free surface is smoothed over half an edge of a 240th of the height: 0.2 %.
  tests::expect_measured("S-11 strip: share of the left ditch [m2/s]",
                         inflow_of(input, s, "marked_1"), -rain * divide, 2e-3 * rain * length);
  tests::expect_measured("S-11 strip: share of the right ditch [m2/s]",
                         inflow_of(input, s, "marked_2"), -rain * (length - divide),
                         2e-3 * rain * length);
  EXPECT_NEAR(s.discharge, rain * length, 1e-7 * rain * length); // all of it enters
  EXPECT_LT(total(s.stretch_runoff), 1e-7 * rain * length);
}
INSTANTIATE_TEST_SUITE_P(Ditches, Strip,
                         testing::Values(std::array{4.0, 4.0, 0.02}, std::array{5.0, 3.0, 0.05},
                                         std::array{2.0, 2.0, 0.1}, std::array{4.0, 4.0, 1e-3}));

//------------------------------------------------------------------------------------------------
// A column that drains freely at its base
//------------------------------------------------------------------------------------------------

class Column : public testing::TestWithParam<double>
{
};

TEST_P(Column, TakesWhatItsConductivityAllowsAndNoMore)
{
  constexpr double k = 3e-5, width = 4;
  const double rain = GetParam() * k;
  meshes::SectionInput input = tests::rectangle_input(width, 10);
  input.marked_lines = {{{0, 0}, {width, 0}}};
  const Solution s = rained_on(input, rain, k, {{BoundaryKind::seepage_face, 0}});
  const double intake = std::min(rain, k) * width;
  tests::expect_measured("S-11 column: intake [m2/s]", s.discharge, intake, 1e-6 * intake);
  EXPECT_NEAR(total(s.stretch_runoff), rain * width - intake, 1e-6 * rain * width);
  // Unit gradient, no water table. The suction of percolating rain is a share of eps (2.33), which
  // changes from element to element: p overshoots between large and small ones, by a twentieth of
  // eps = 0.1 m at most.
  for (const double p : s.pore_pressure)
    EXPECT_LT(p, 0.005 * water_unit_weight);
}
INSTANTIATE_TEST_SUITE_P(Rates, Column, testing::Values(1e-3, 0.5, 0.9, 1.5, 100.0));

TEST(Column, UnderEvenRainSinksStraightDown)
{
  constexpr double k = 3e-5, rain = 0.3 * k;
  meshes::SectionInput input = tests::rectangle_input(4, 10);
  input.marked_lines = {{{0, 0}, {4, 0}}};
  const Solution s = rained_on(input, rain, k, {{BoundaryKind::seepage_face, 0}});
  // The water between two points of a level, half way down; elements smooth k_r each by its own
  // size, which moves a few percent of the water sideways within one of them.
  for (const double x : {1.0, 2.0, 3.0})
    EXPECT_NEAR(seepage::value_at(s, s.stream_function, {x, 5}, 0).value(), rain * x,
                0.02 * rain * 4);
}

//------------------------------------------------------------------------------------------------
// No head given anywhere: rain, and ground that lets it out
//------------------------------------------------------------------------------------------------

TEST(RainAlone, OnAnEmbankmentEntersAndComesOutBelow)
{
  for (const double rain : {0.03, 30.0}) // of k
  {
    const Solution s = rained_on(tests::two_sided_embankment(), rain);
    expect_balanced(s);
    EXPECT_NEAR(s.rain, rain * 191.4, 1e-9 * s.rain);
    EXPECT_NEAR(s.inflow + total(s.stretch_runoff), s.rain, 1e-6 * s.rain);
    EXPECT_GT(s.discharge, 0);
    for (std::size_t e = 0; e < s.mesh.boundary.size(); ++e) // nowhere stands water on the ground
      for (const Index i : s.mesh.boundary[e])
        if (s.mesh.nodes[static_cast<std::size_t>(i)].y() >= 7.3)
        {
          EXPECT_LE(s.pore_pressure[static_cast<std::size_t>(i)],
                    s.mesh.nodes[static_cast<std::size_t>(i)].y() > 7.3 ? 0 : 1e9);
        }
  }
}

TEST(RainAlone, GrowsTheWaterTableWithItsRate)
{
  double last = 0;
  for (const double rain : {1e-3, 1e-2, 1e-1})
  {
    const Solution s = rained_on(tests::two_sided_embankment(), rain);
    const double level = seepage::phreatic_level(s, 103).value();
    EXPECT_GT(level, last);
    last = level;
  }
}

TEST(RainAndPool, OnAMirroredEmbankmentAreMirrored)
{
  meshes::SectionInput input = tests::two_sided_embankment();
  input.left_pool_level = 15;
  const Solution a = rained_on(input, 0.02), b = rained_on(tests::mirrored(input), 0.02);
  // Meshes are not mirrored: what remains is their error.
  tests::expect_measured("S-11 rain and pool: discharge / k, mirrored [m]", a.discharge,
                         b.discharge, 5e-3 * a.discharge);
  EXPECT_NEAR(inflow_of(input, a, "left_pool"), inflow_of(tests::mirrored(input), b, "right_pool"),
              5e-3 * a.discharge);
}
} // namespace
} // namespace berm
